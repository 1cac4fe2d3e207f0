#pragma once

#include <span>
#include <utility>
#include <vector>

#include "forces/forces.h"
#include "forces/integrators/integrators.h"
#include "forces/spring_pull.h"

namespace tweenfall::forces {

/// What acts in a step besides contacts.
struct Acting {
  const std::vector<state::Body>& bodies;
  const std::vector<NumberedForce>& forces;
  const WorldSettings& settings;
  double time;  ///< at the start of the step, s
  double dt;
};

/// How a body changes, without contacts: per second, or altogether. A state has twelve numbers per body.
struct Change {
  Vec3 center{0, 0, 0};    ///< of its center of mass
  Vec3 linear{0, 0, 0};    ///< of its velocity
  Vec3 turn{0, 0, 0};      ///< rotation vector, world axes, since the start of the step
  Vec3 momentum{0, 0, 0};  ///< of its angular momentum, world axes
};

/// Moves bodies through a step by an integrator that evaluates forces at states of its own choosing.
class Flight {
 public:
  /// Finds how they would move if nothing touched them.
  /// @param loads  holds the springiness; written: the mean acceleration and torque, for bodies that something touches
  void gather(const Acting& acting, std::span<const std::uint32_t> watched, Integrate* integrate,
              std::vector<Load>& loads);
  /// Moves a body that nothing touched.
  void land(std::uint32_t index, state::Body& body, double dt) const;

 private:
  static constexpr std::uint32_t nobody = 0xffffffffu;

  struct Start {
    std::uint32_t index = 0;
    Vec3 momentum;  ///< angular, world axes
  };

  /// Rates of all bodies at these states, from gravity, all forces and what the caller applied.
  void find_rates(const Acting& acting, std::span<const std::uint32_t> watched, const std::vector<Load>& loads,
                  double after, std::span<const double> since, std::span<double> rates);
  class Amid;
  void add_spring(const Acting& acting, const Spring& spring, const Moment& moment);
  /// Finds which bodies act on each other.
  void tie(const Acting& acting, std::span<const std::uint32_t> watched, const std::vector<Load>& loads);

  std::vector<std::uint32_t> slots_;  ///< by body
  std::vector<Start> starts_;
  std::vector<Glimpse> glimpses_;
  std::vector<Change> rates_;
  std::vector<std::pair<double, double>> resisted_;  ///< by what drags, kg/s, and what slows turns, kg m^2/s
  std::vector<double> means_, sizes_;
  std::vector<std::uint32_t> ties_, turns_;  ///< by start
  Room room_;
};

}  // namespace tweenfall::forces
