#pragma once

#include <cstdint>
#include <vector>

#include "forces/free_flight.h"
#include "islands/island_contents.h"
#include "islands/sprung/sprung_body.h"

namespace tweenfall::sprung {

/// Moves islands in which only springs hold, and nothing touches: two bodies on a spring, a weight on several, a
/// chain of them. Springs push in sub-steps short enough to follow their swing, and bodies fly freely in between, which
/// keeps momentum to rounding and the energy to a swaying part of a hundredth, whatever their levers, masses and spins.
/// A spring too stiff even for the most sub-steps pulls as hard only as they can follow, by a law that depends on its
/// length alone: it never adds energy.
/// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006, chapters I.1.4 and VII.5 (Verlet's method,
/// and the splitting of a turning body into turns about its axes).
class SprungFlight {
 public:
  /// Whether it can, and whether that is worth its time.
  [[nodiscard]] bool takes(const islands::IslandContents& island, const std::vector<state::Body>& bodies,
                           Integrator integrator, double dt);
  /// Moves the bodies of the island that it took last; fills in the impulses of its joints.
  /// @param moved  by index: set for the bodies that were moved
  void solve(std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, double dt,
             std::vector<char>& moved);

 private:
  struct Pull {
    std::uint32_t a = 0, b = 0;  ///< in bodies_
    Vec3 local_a{0, 0, 0}, local_b{0, 0, 0};
    double length = 0, stiffness = 0, damping = 0;  ///< as the caller wants it
    state::Joint* joint = nullptr;
    double straight = 0;        ///< bound of the speed that an impulse gives its ends, 1/kg
    double swinging = 0;        ///< the same per meter of stretch, as its pull turns levers and its own line, 1/(kg m)
    double stretch = 0;         ///< about the most in this step, m
    double most_per_meter = 0;  ///< with `swinging`: the stiffness that sub-steps can follow, N/m
    double fading = 0;          ///< rate at which the speed of a swing dies away that steps are too long to show, 1/s
    Vec3 side{1, 0, 0};
    Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};
    double force = 0;       ///< along `side`, N
    Vec3 impulse{0, 0, 0};  ///< on b, N s

    /// N; of a stretch in m.
    [[nodiscard]] double force_of(double stretched) const;
  };

  void gather(const islands::IslandContents& island, const std::vector<state::Body>& bodies, double dt);
  std::uint32_t place_of(std::uint32_t index, const std::vector<state::Body>& bodies, double dt);
  void choose_pace(double dt);
  [[nodiscard]] double energy() const;
  void aim(Pull& pull) const;
  void push(Pull& pull, double impulse);
  void pull_all(double h);
  void resist(double h, bool backward);
  void lead(int sub_step, double dt);

  std::vector<SprungBody> bodies_;  ///< the first stands for the world
  std::vector<Pull> pulls_;
  int sub_steps_ = 1;
  bool followed_ = true;  ///< by as many sub-steps as there may be
  bool resists_ = false;  ///< some spring is damped
};

}  // namespace tweenfall::sprung
