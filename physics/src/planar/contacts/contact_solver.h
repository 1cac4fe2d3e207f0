#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "islands/blocks/coloring.h"
#include "planar/body.h"
#include "planar/contacts/contact_block.h"

namespace tweenfall::planar::inner {

/// The share of its velocities that a body's damping leaves in a sub-step.
struct Damped {
  double linear = 1, angular = 1;
};

/// Impulses of a step at one meeting, N s.
struct Given {
  double normal[2] = {0, 0}, sideways[2] = {0, 0};
  double approach = 0;  ///< greatest closing speed of a point at the start of the step, m/s
};

/// The input of a step.
struct Scene {
  std::vector<Body>& bodies;
  std::vector<Makeup>& makeups;
  std::vector<Meeting>& meetings;
  std::vector<Joint>& joints;
  std::span<const std::uint32_t> moving;  ///< bodies under way
  std::span<const std::uint32_t> active;  ///< meetings with points
  double push_out_speed = 0;
  double dt = 0;
  int sub_steps = 1;
  bool relaxes_each = true;  ///< each sub-step ends with hard passes; otherwise only the last one
  double warmth = 1;         ///< share of the impulses of the step before with which this one starts
  double parts = 1;          ///< how often the step fits into the whole step
  double kept = 1;           ///< factor between its impulses and those the next one starts with; 0 for the earlier ones
};

/// Moves bodies through a step: in each sub-step velocities, blows of rebounding contacts, soft contacts while
/// bodies are moved, and, in each or at the end, hard passes.
class ContactSolver {
 public:
  void solve(Scene scene);

  std::vector<BodyRow> gains;  ///< of velocity without contacts, m/s^2 and rad/s^2, by body
  std::vector<Damped> damped;  ///< by body; only of those that are damped
  std::vector<Given> given;    ///< by active meeting

 private:
  struct Bouncy {
    std::uint32_t place = 0;  ///< block times lanes plus lane
    std::uint32_t active = 0;
    double restitution = 0;
    int count = 0;
  };
  /// A contact that resists rolling.
  struct Rolling {
    std::uint32_t place = 0;  ///< block times lanes plus lane
    std::uint32_t active = 0;
    double friction = 0;  ///< length, m
    double mass = 0;      ///< moment that the torque turns, kg m^2
    double impulse = 0;   ///< on b, of the sub-step, N m s
  };
  /// Where the bodies of a bouncy contact meet.
  struct Arrival {
    double when = 0;   ///< s from the start of the sub-step
    double speed = 0;  ///< m/s; 0 if they do not meet
  };

  void build(const Scene& scene);
  void color(const Scene& scene);
  void fill(const Scene& scene, std::uint32_t k);
  [[nodiscard]] BodyRows rows();
  void begin_sub_step(const Scene& scene, double h, int left, bool again);
  void begin_between_blows(const Scene& scene, double h, int left, bool again);
  void begin(const Scene& scene, std::uint32_t index, double h, int left);
  void pull(const Body& body, Makeup& makeup, std::uint32_t index, double h, double ahead);
  void strike(double h);
  bool strike(const Bouncy& bouncy, double h);
  [[nodiscard]] Arrival arrival(const ContactBlock& block, int lane, int point, double h) const;
  void knock(const ContactBlock& block, int lane, double along, double across, int point, double when);
  void warm_start_rolling();
  void resist_rolling();
  void move(const Scene& scene, double h);
  void move(const Scene& scene, std::uint32_t index, double h);
  void move_on(const Scene& scene, double h, int left);
  void store(const Scene& scene);
  void finish(const Scene& scene);

  double parts_ = 1;  ///< how often the present step fits into the whole one
  std::vector<BodyRow> velocities_, starts_, unpushed_, displacements_;
  std::vector<BodyRow> poses_, masses_;  ///< at the start of the step
  std::vector<BodyRow> gifts_;           ///< by contacts, in the last sub-step; only kept while blows come between
  std::vector<std::uint32_t> plain_, special_;  ///< bodies under way: of the special ones, forces act also by velocity
  std::vector<double> struck_at_;
  std::vector<ContactBlock> blocks_;
  std::vector<std::uint32_t> colors_, places_;
  std::vector<std::uint32_t> color_counts_, next_places_;  ///< by color
  std::vector<Bouncy> bouncy_;
  std::vector<Rolling> rolling_;
  blocks::Coloring coloring_;
};

}  // namespace tweenfall::planar::inner
