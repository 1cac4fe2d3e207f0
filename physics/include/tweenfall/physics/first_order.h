#pragma once

/// A general system of first order, x' = f(x, t), through time by any of the integrators that a world has.
///
/// Motion is such a system: its state is places and speeds, and its rates are speeds and accelerations. So is anything
/// else whose rates follow from its state: populations, temperatures, orbits in a strange field.

#include <tweenfall/physics/world.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tweenfall {

/// x' = f(x, t).
/// @param rates  written; as long as the state
using FirstOrder = std::function<void(double time, std::span<const double> state, std::span<double> rates)>;

/// Steps a system on. Of the integrators that treat places and speeds unlike (`exact_quadratic`, which is `verlet`
/// here, `verlet` and `semi_implicit_euler`) the first half of the state is places, the second half their speeds.
class FirstOrderStepper {
 public:
  /// @param state  at the start
  /// @throws std::invalid_argument without rates, for a state that is empty or not finite, for a time that is not
  /// finite, for an integrator that is none, and for an odd number of numbers where half of them are places
  FirstOrderStepper(FirstOrder rates, std::vector<double> state, Integrator integrator, double time = 0);

  /// One step of `dt` seconds, which may be negative: then it goes back. What grows beyond all numbers is infinite or
  /// none from there on. Throws what the rates throw; nothing has moved then.
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

/// A system's way: `count` states after the first, a step apart.
struct FirstOrderPath {
  std::vector<double> times;                ///< s
  std::vector<std::vector<double>> states;  ///< one for each time
};

/// @throws as FirstOrderStepper does, and when there would be more than ten million numbers
[[nodiscard]] FirstOrderPath first_order_path(const FirstOrder& rates, const std::vector<double>& start,
                                              Integrator integrator, double dt, std::size_t count, double time = 0);

}  // namespace tweenfall
