#include <tweenfall/physics/first_order.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "physics/step/methods.h"

using namespace tweenfall;

namespace {

/// A pushed pendulum: q' = p, p' = -sin q + 0.3 cos 2 t.
void pushed_pendulum(double time, std::span<const double> state, std::span<double> rates) {
  rates[0] = state[1];
  rates[1] = -std::sin(state[0]) + 0.3 * std::cos(2 * time);
}

double apart(const FirstOrderPath& a, const FirstOrderPath& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.states.back().size(); ++i)
    most = std::max(most, std::abs(a.states.back()[i] - b.states.back()[i]));
  return most;
}

}  // namespace

TEST_CASE("each integrator comes nearer to a pushed pendulum's way by its order") {
  const FirstOrderPath limit = first_order_path(pushed_pendulum, {1, 0.5}, Integrator::rk4, 3.0 / 20000, 20000);
  for (const test::Method& each : test::methods) {
    CAPTURE(each.name);
    const std::size_t steps = each.order > 3 ? 50 : each.order > 1 ? 200 : 3200;
    const double dt = 3.0 / static_cast<double>(steps);
    const double coarse = apart(first_order_path(pushed_pendulum, {1, 0.5}, each.integrator, dt, steps), limit);
    const double fine = apart(first_order_path(pushed_pendulum, {1, 0.5}, each.integrator, dt / 2, 2 * steps), limit);
    CAPTURE(coarse);
    CHECK(std::log2(coarse / fine) == doctest::Approx(each.order).epsilon(0.06));
  }
}

TEST_CASE("Robertson's reaction, which is stiff, comes out as published by backward Euler and the implicit trapezoid") {
  // Hairer and Wanner, Solving Ordinary Differential Equations II, IV.1: at t = 40 s the state is this.
  const FirstOrder reaction = [](double, std::span<const double> y, std::span<double> rates) {
    rates[0] = -0.04 * y[0] + 1e4 * y[1] * y[2];
    rates[2] = 3e7 * y[1] * y[1];
    rates[1] = -rates[0] - rates[2];
  };
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::implicit_trapezoid}) {
    const FirstOrderPath path = first_order_path(reaction, {1, 0, 0}, integrator, 0.005, 8000);
    const double off = integrator == Integrator::backward_euler ? 2e-5 : 1e-6;
    CHECK(std::abs(path.states.back()[0] - 0.7158270688) < off);
    CHECK(std::abs(path.states.back()[1] - 9.185534765e-6) < 1e-4 * off);
    CHECK(std::abs(path.states.back()[2] - 0.2841637457) < off);
  }
  // Explicit methods cannot do this: it is why there are others.
  CHECK_FALSE(std::isfinite(first_order_path(reaction, {1, 0, 0}, Integrator::rk4, 0.005, 8000).states.back()[0]));
}

TEST_CASE("decay by backward Euler is its closed form at any rate and step, forward and back") {
  for (const double rate : {1e-6, 1.0, 1e3, 1e9})
    for (const double dt : {0.25, 1e-3, -1e-3}) {
      if (1 + dt * rate <= 0) continue;  // back in time it grows without end
      FirstOrderStepper stepper(
          [rate](double, std::span<const double> x, std::span<double> rates) { rates[0] = -rate * x[0]; }, {5},
          Integrator::backward_euler);
      stepper.step(dt);
      CHECK(stepper.state()[0] == doctest::Approx(5 / (1 + dt * rate)).epsilon(1e-13));
      CHECK(stepper.time() == dt);
    }
}

TEST_CASE("Kepler's areas are kept by Verlet to rounding") {
  const FirstOrder orbit = [](double, std::span<const double> x, std::span<double> rates) {
    const double square = x[0] * x[0] + x[1] * x[1], cube = square * std::sqrt(square);
    rates[0] = x[2];
    rates[1] = x[3];
    rates[2] = -x[0] / cube;
    rates[3] = -x[1] / cube;
  };
  const FirstOrderPath path = first_order_path(orbit, {1, 0, 0, 1.2}, Integrator::verlet, 0.05, 2000);
  for (const std::vector<double>& x : path.states) REQUIRE(std::abs(x[0] * x[3] - x[1] * x[2] - 1.2) < 1e-12);
}

TEST_CASE("a system that cannot be stepped is refused") {
  const auto made = [](const FirstOrder& rates, std::vector<double> state, Integrator integrator) {
    return FirstOrderStepper(rates, std::move(state), integrator);
  };
  CHECK_THROWS_AS(made({}, {1}, Integrator::rk4), std::invalid_argument);
  CHECK_THROWS_AS(made(pushed_pendulum, {}, Integrator::rk4), std::invalid_argument);
  CHECK_THROWS_AS(made(pushed_pendulum, {1, std::numeric_limits<double>::quiet_NaN()}, Integrator::rk4),
                  std::invalid_argument);
  CHECK_THROWS_AS(made(pushed_pendulum, {1, 2, 3}, Integrator::verlet), std::invalid_argument);
  CHECK_THROWS_AS(made(pushed_pendulum, {1, 2}, static_cast<Integrator>(77)), std::invalid_argument);
  CHECK_THROWS_AS((void)first_order_path(pushed_pendulum, {1, 2}, Integrator::rk4, 0.1, std::size_t{1} << 62),
                  std::invalid_argument);
  FirstOrderStepper stepper = made(pushed_pendulum, {1, 2}, Integrator::rk4);
  CHECK_THROWS_AS(stepper.step(std::numeric_limits<double>::infinity()), std::invalid_argument);
  stepper.step(0);
  CHECK(stepper.state()[0] == 1);
}
