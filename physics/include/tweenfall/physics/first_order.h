#pragma once

/// Integrates a general system of first order, x' = f(x, t), by any of the integrators that a world has.
///
/// Motion is such a system: its state is positions and velocities, and its rates are velocities and accelerations. So
/// is anything else whose rates follow from its state: populations, temperatures, orbits in a strange field.

#include <tweenfall/physics/world.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tweenfall {

/// x' = f(x, t).
/// @param rates  the output; as long as the state
using FirstOrder = std::function<void(double time, std::span<const double> state, std::span<double> rates)>;

/// Advances a system by steps. For integrators that treat positions and velocities differently (`exact_quadratic`,
/// which is `verlet` here, `verlet`, `semi_implicit_euler`) the state is first all positions, then all velocities.
class FirstOrderStepper {
 public:
  /// @param state  at the start
  /// @throws std::invalid_argument without rates, for a state that is empty or not finite, for a time that is not
  /// finite, for an unknown integrator, and for a state of odd length where half of it must be positions
  FirstOrderStepper(FirstOrder rates, std::vector<double> state, Integrator integrator, double time = 0);

  /// One step of `dt` seconds, or back in time if dt is negative. Values that grow beyond all numbers stay infinite or
  /// not a number from there on. Throws what the rates throw; nothing has changed then.
  /// @throws std::invalid_argument when dt is not finite
  void step(double dt);

  [[nodiscard]] std::span<const double> state() const noexcept { return state_; }
  [[nodiscard]] double time() const noexcept { return time_; }

 private:
  FirstOrder rates_;
  std::vector<double> state_;
  Integrator integrator_;
  double time_ = 0;
  std::vector<std::uint8_t> places_;
  std::vector<double> there_, sizes_, means_;
  std::vector<std::vector<double>> room_;
};

/// The path of a system: `count` states after the first, a step apart.
struct FirstOrderPath {
  std::vector<double> times;                ///< s
  std::vector<std::vector<double>> states;  ///< one per time
};

/// @throws as FirstOrderStepper does, and for more than ten million numbers in all
[[nodiscard]] FirstOrderPath first_order_path(const FirstOrder& rates, const std::vector<double>& start,
                                              Integrator integrator, double dt, std::size_t count, double time = 0);

}  // namespace tweenfall
