#include <tweenfall/curves/functions.h>

#include <limits>
#include <stdexcept>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Pendulum from_rest(double degrees) {
  return {.angle = degrees * pi / 180, .length = 2, .gravity = 9.81};
}

double small_period() {
  return 2 * pi * std::sqrt(2 / 9.81);
}

}  // namespace

// Source of the ratios: 2 K(sin^2(angle/2)) / pi, K from Abramowitz and Stegun, table 17.1 (m = 1/2: 1.85407 46773
// 01372) and, for 1 and 179 degrees, the series 1 + a^2/16 + 11 a^4/3072 and K from its logarithmic expansion.
TEST_CASE("a pendulum's period grows with its amplitude as K(k) does") {
  CHECK(pendulum_period(from_rest(90)) / small_period() == doctest::Approx(2 * 1.854074677301372 / pi).epsilon(1e-14));
  CHECK(pendulum_period(from_rest(90)) / small_period() == doctest::Approx(1.18034).epsilon(1e-5));
  const double a = pi / 180;
  CHECK(pendulum_period(from_rest(1)) / small_period() ==
        doctest::Approx(1 + a * a / 16 + 11 * a * a * a * a / 3072).epsilon(1e-13));
  // K = L + (L - 1) c^2 / 4 + ..., L = log(4 / c), with c = cos(angle / 2).
  const double c = std::cos(89.5 * pi / 180), l = std::log(4 / c);
  CHECK(pendulum_period(from_rest(179)) / small_period() ==
        doctest::Approx(2 / pi * (l + (l - 1) * c * c / 4)).epsilon(1e-8));
  CHECK(pendulum_period(from_rest(179)) / small_period() == doctest::Approx(3.90106).epsilon(1e-5));
}

TEST_CASE("a pendulum keeps its energy and solves its equation, swinging, creeping or turning") {
  const double w2 = 9.81 / 2, top = 2 * std::sqrt(w2);
  for (const Pendulum& p : {from_rest(5), from_rest(-120), from_rest(179.9), Pendulum{0, 0.999 * top, 2, 9.81},
                            Pendulum{0, -top, 2, 9.81}, Pendulum{1, 1.5 * top, 2, 9.81}, Pendulum{9, -7, 2, 9.81},
                            Pendulum{-2, 1.2, 2, 9.81}, Pendulum{0.2, 1.0001 * top, 2, 9.81}}) {
    CAPTURE(p.angle);
    CAPTURE(p.rate);
    const Curve<double> c = pendulum(p);
    CHECK(std::abs(c.value(0) - p.angle) < 1e-14 * (1 + std::abs(p.angle)));
    CHECK(std::abs(c.rate(0) - p.rate) < 2e-14 * (1 + std::abs(p.rate)));
    const double energy = 0.5 * p.rate * p.rate - w2 * std::cos(p.angle);
    for (double t = -7; t < 9; t += 0.37) {
      const Sample<double> s = c.sample(t);
      CHECK(std::abs(s.acceleration + w2 * std::sin(s.value)) < 1e-12);
      CHECK(std::abs(0.5 * s.rate * s.rate - w2 * std::cos(s.value) - energy) < 1e-12 * (1 + std::abs(energy)));
      const double h = 1e-4;
      CHECK(std::abs(s.rate - (c.value(t + h) - c.value(t - h)) / (2 * h)) < 1e-6);
    }
  }
}

TEST_CASE("a pendulum is back after its period, and a turn further where it goes over the top") {
  for (const Pendulum& p : {from_rest(170), Pendulum{0.3, 2, 2, 9.81}}) {
    const Curve<double> c = pendulum(p);
    const double period = pendulum_period(p);
    for (const double t : {0.1, 1.3}) CHECK(std::abs(c.value(t + 5 * period) - c.value(t)) < 1e-11);
    CHECK(std::abs(pendulum(from_rest(170)).value(pendulum_period(from_rest(170)) / 4)) < 1e-13);
  }
  const Pendulum fast{.angle = 0.3, .rate = -9};
  CHECK(std::abs(pendulum(fast).value(3 * pendulum_period(fast)) - (0.3 - 6 * pi)) < 1e-12);
}

TEST_CASE("a small swing is the oscillator's") {
  const Curve<double> exact = pendulum(from_rest(0.001));
  const Curve<double> wave = oscillator({.amplitude = 0.001 * pi / 180, .hz = 1 / small_period()});
  for (const double t : {0.2, 1.0, 2.9}) CHECK(std::abs(exact.value(t) - wave.value(t)) < 1e-15);
}

TEST_CASE("a pendulum at rest stays, and a faulty one is refused with its number") {
  CHECK(pendulum({.angle = 0}).value(5) == 0);
  CHECK(pendulum_period({.angle = 0, .rate = 2 * std::sqrt(9.81)}) > 30);
  CHECK_THROWS_WITH_AS((void)pendulum({.length = -2}), doctest::Contains("-2"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)pendulum({.gravity = 0}), doctest::Contains("gravity"), std::invalid_argument);
  CHECK_THROWS_AS((void)pendulum({.angle = std::numeric_limits<double>::infinity()}), std::invalid_argument);
}
