#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>

#include <stdexcept>

#include "curves/stated.h"

using namespace tweenfall;

TEST_CASE("a projectile is where the textbook says, at any time") {
  const Curve<Vec3> c = projectile({.from = {0, 2, 0}, .velocity = {3, 10, 0}, .gravity = {0, -10, 0}});
  CHECK(c.value(1) == Vec3(3, 7, 0));
  CHECK(c.value(2) == Vec3(6, 2, 0));
  CHECK(c.rate(2) == Vec3(3, -10, 0));
  CHECK(c.sample(-4).acceleration == Vec3(0, -10, 0));
  CHECK_THROWS_AS(static_cast<void>(projectile({.from = {0, std::nan(""), 0}})), std::invalid_argument);
}

// The first lecture on physics-based animation: u = (3, 4), a = (0, -1), at t = 0, 1, 2, 3.
TEST_CASE("a projectile, and the same motion as expressions, give the lecture's table exactly") {
  const Curve<Vec3> thrown = projectile({.velocity = {3, 4, 0}, .gravity = {0, -1, 0}});
  const Curve<Vec2> written =
      parametric(expression_curve(Expression("3*t")), expression_curve(Expression("4*t - 1/2*t^2")));
  const Vec2 table[] = {{0, 0}, {3, 3.5}, {6, 6}, {9, 7.5}};
  for (int t = 0; t <= 3; ++t) {
    CHECK(thrown.value(t) == Vec3(table[t][0], table[t][1], 0));
    CHECK(written.value(t) == table[t]);
    CHECK(thrown.rate(t) == Vec3(3, 4 - t, 0));
    CHECK(written.rate(t) == Vec2(3, 4 - t));
    CHECK(written.sample(t).acceleration == Vec2(0, -1));
  }
}

TEST_CASE("an oscillator solves the damped wave's equation") {
  const Oscillator o{.amplitude = 2, .hz = 0.5, .phase = 0.3, .damping = 0.4, .center = 1};
  const Curve<double> c = oscillator(o);
  const double w = 2 * std::acos(-1.0) * 0.5;
  for (const double t : {0.0, 0.7, 3.1}) {
    const Sample<double> s = c.sample(t);
    CHECK(s.value == doctest::Approx(1 + 2 * std::cos(w * t + 0.3) * std::exp(-0.4 * t)));
    CHECK(std::abs(s.acceleration + 2 * 0.4 * s.rate + (w * w + 0.16) * (s.value - 1)) < 1e-12);
    const double h = 1e-4;
    CHECK(s.rate == doctest::Approx((c.value(t + h) - c.value(t - h)) / (2 * h)).epsilon(1e-6));
  }
  CHECK_THROWS_WITH_AS(static_cast<void>(oscillator({.damping = -1})), doctest::Contains("-1"), std::invalid_argument);
}

TEST_CASE("a damped spring agrees with scipy's matrix exponential") {
  for (const auto& file : test::vector_family("spring"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const auto& in = c["input"];
      const double w = in["angular_frequency"], z = in["damping_ratio"], turn = 2 * std::acos(-1.0);
      const double goal = in["goal"], goal_velocity = in["goal_velocity"];
      const DampedSpring settings{.hz = w / turn,
                                  .damping_ratio = z,
                                  .position = in["position"],
                                  .velocity = in["velocity"],
                                  .goal = goal,
                                  .goal_velocity = goal_velocity};
      const Curve<double> spring = damped_spring(settings);
      const double size =
          test::tolerance(file) * std::max(std::abs(settings.position - goal), std::abs(settings.velocity) / w);
      for (std::size_t i = 0; i < c["t"].size(); ++i) {
        const double t = c["t"][i];
        CAPTURE(t);
        const Sample<double> s = spring.sample(t);
        CHECK(std::abs(s.value - c["value"][i].get<double>()) <= size);
        CHECK(std::abs(s.rate - c["velocity"][i].get<double>()) <= size * w);
        CHECK(std::abs(s.acceleration + 2 * z * w * s.rate + w * w * (s.value - goal - goal_velocity * t)) <=
              size * w * w);
      }
    }
}

TEST_CASE("a spring near critical damping moves as the critical one") {
  const auto at = [](double damping_ratio, double t) {
    return damped_spring({.hz = 2, .damping_ratio = damping_ratio, .position = 1, .velocity = -3}).value(t);
  };
  for (const double off : {1e-15, 1e-12, 1e-9, 1e-7, 1e-5})
    for (const double t : {-0.2, 0.01, 0.1, 0.5, 2.0}) {
      CAPTURE(off);
      CAPTURE(t);
      CHECK(std::abs(at(1 + off, t) - at(1, t)) < 100 * off + 1e-12);
      CHECK(std::abs(at(1 - off, t) - at(1, t)) < 100 * off + 1e-12);
    }
  CHECK_THROWS_WITH_AS(static_cast<void>(damped_spring({.hz = 0})), doctest::Contains("hz"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(damped_spring({.damping_ratio = -1})), doctest::Contains("-1"),
                       std::invalid_argument);
}
