#include <tweenfall/curves/functions.h>

#include <stdexcept>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {}  // namespace

TEST_CASE("an orbit keeps its energy and its angular momentum, and falls to its center by the square of the distance") {
  Random random(11);
  for (const double e : {0.0, 1e-9, 0.3, 0.9, 0.999999, 1.0 - 1e-14, 1.0, 1.0 + 1e-13, 1.001, 2.0, 30.0}) {
    CAPTURE(e);
    const Orbit o{.center = {1, -2, 3},
                  .periapsis = 0.7,
                  .eccentricity = e,
                  .gravitational_parameter = 2.5,
                  .passage = 0.4,
                  .rotation = random.rotation()};
    const Curve<Vec3> c = orbit(o);
    const double energy = 2.5 * (e - 1) / (2 * 0.7), momentum = std::sqrt(2.5 * 0.7 * (1 + e));
    const Mat3 axes = o.rotation.toRotationMatrix();
    CHECK(near(c.value(0.4), Vec3(o.center + 0.7 * axes.col(0)), 1e-14));
    for (const double t : {-300.0, -5.0, 0.1, 0.399999, 0.41, 0.7, 2.0, 40.0, 5000.0}) {
      CAPTURE(t);
      const Sample<Vec3> s = c.sample(t);
      const Vec3 out = s.value - o.center;
      CHECK(std::abs(s.rate.squaredNorm() / 2 - 2.5 / out.norm() - energy) < 1e-12 * (1 + std::abs(energy)));
      CHECK((out.cross(s.rate) - momentum * axes.col(2)).norm() < 1e-11 * (1 + momentum));
      CHECK((s.acceleration + 2.5 / std::pow(out.norm(), 3) * out).norm() < 1e-12);
      const double h = 1e-5 * (1 + std::abs(t - 0.4));
      if (t == 0.7 || t == 2 || t == -5)
        CHECK((s.rate - (c.value(t + h) - c.value(t - h)) / (2 * h)).norm() < 1e-7 * (1 + s.rate.norm()));
    }
  }
}

// Source: Meeus, "Astronomical Algorithms", 1998, chapter 30: e = 0.1, M = 5 degrees gives E = 5.554589 degrees,
// e = 0.99, M = 0.2 gives E = 1.066997 radians, and e = 0.999, M = 7 degrees E = 52.2702615 degrees; and example 34.a,
// a parabola: q = 1.487469, 112.5642 days after the passage: true anomaly 66.78862 degrees, distance 2.133911.
TEST_CASE("positions are those that tables give") {
  const auto eccentric = [](double e, double mean) {
    // A semi-major axis of 1 and a period of 2 pi: time is the mean anomaly.
    const Vec3 p = orbit({.periapsis = 1 - e, .eccentricity = e}).value(mean);
    return std::atan2(p[1] / std::sqrt(1 - e * e), p[0] + e);
  };
  CHECK(std::abs(eccentric(0.1, 5 * pi / 180) * 180 / pi - 5.554589) < 1e-6);
  CHECK(std::abs(eccentric(0.99, 0.2) - 1.066997) < 1e-6);
  CHECK(std::abs(eccentric(0.999, 7 * pi / 180) * 180 / pi - 52.2702615) < 1e-7);
  const double gauss = 0.01720209895;
  const Vec3 comet =
      orbit({.periapsis = 1.487469, .eccentricity = 1, .gravitational_parameter = gauss * gauss}).value(112.5642);
  CHECK(std::abs(std::atan2(comet[1], comet[0]) * 180 / pi - 66.78862) < 2e-5);
  CHECK(std::abs(comet.norm() - 2.133911) < 2e-6);
}

TEST_CASE("an ellipse is run through in its period, at every eccentricity below 1") {
  for (const double e : {0.0, 0.5, 0.9, 0.999999999}) {
    const Curve<Vec3> c = orbit(Orbit{.eccentricity = e}.with_period(4));
    CHECK(near(c.value(4), c.value(0), 1e-6));
    CHECK(c.value(2)[0] == doctest::Approx(-(1 + e) / (1 - e)).epsilon(1e-9));
    // Equal areas in equal times: the whole is pi a b.
    const double a = 1 / (1 - e), b = a * std::sqrt((1 - e) * (1 + e));
    CHECK(c.value(1.1).cross(c.rate(1.1)).norm() / 2 == doctest::Approx(pi * a * b / 4).epsilon(1e-12));
  }
  CHECK_THROWS_WITH_AS((void)Orbit{.eccentricity = 1}.with_period(4), doctest::Contains("eccentricity"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)orbit({.eccentricity = -0.5}), doctest::Contains("-0.5"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)orbit({.periapsis = 0}), doctest::Contains("periapsis"), std::invalid_argument);
  CHECK_THROWS_AS((void)orbit({.rotation = Quat(0, 0, 0, 0)}), std::invalid_argument);
}
