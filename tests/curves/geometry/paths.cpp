#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include <stdexcept>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::vector<Vec3> ring(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back({std::cos(2 * pi * i / count), std::sin(2 * pi * i / count), 0});
  return points;
}

}  // namespace

TEST_CASE("a path is run through at one speed, and its rates are the derivatives of its value") {
  Random random(3);
  for (const bool closed : {false, true}) {
    std::vector<Vec3> points;
    for (int i = 0; i < 7; ++i) points.push_back(random.vector(3));
    const Curve<Vec3> c = even_path({.points = points, .closed = closed, .duration = 5});
    CHECK(c.end() == 5);
    CHECK(near(c.value(0), points.front(), 1e-14));
    CHECK(near(c.value(5), closed ? points.front() : points.back(), 1e-13));
    const double speed = c.rate(0).norm();
    for (double t = 0.05; t < 5; t += 0.31) {
      const Sample<Vec3> s = c.sample(t);
      CHECK(std::abs(s.rate.norm() - speed) < 1e-14 * speed);
      CHECK(std::abs(s.rate.dot(s.acceleration)) < 1e-12 * (1 + s.acceleration.norm()));
      const double h = 1e-4;
      CHECK((s.rate - (c.value(t + h) - c.value(t - h)) / (2 * h)).norm() < 2e-6 * (1 + s.acceleration.norm()));
      CHECK((s.acceleration - (c.rate(t + h) - c.rate(t - h)) / (2 * h)).norm() < 1e-3 * (1 + s.acceleration.norm()));
    }
    if (closed) CHECK(near(c.rate(5, Side::in), c.rate(0), 1e-10));
  }
}

TEST_CASE("a path's length is the circle's, as the points on it grow many") {
  double before = 1;
  for (const int count : {8, 16, 32}) {
    const Curve<Vec3> c = even_path({.points = ring(count), .closed = true, .duration = 1});
    const double fault = std::abs(c.rate(0.3).norm() - 2 * pi);
    CHECK(fault < before / 8);
    before = fault;
    // Half the time is half the way around.
    CHECK(near(c.value(0.5), Vec3(-1, 0, 0), 1e-12));
  }
  CHECK(before < 1e-4);
}

TEST_CASE("lengths are those of the closed forms, and half of the time is half of the length") {
  // The parabola (t, t^2) from 0 to 1 is exactly a cubic, and sqrt(5)/2 + asinh(2)/4 long.
  const Tangent<Vec3> begin{Tangent<Vec3>::Kind::given, {1, 0, 0}}, end{Tangent<Vec3>::Kind::given, {1, 2, 0}};
  const Curve<Vec3> parabola =
      keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .out = begin}, {.time = 1, .value = {1, 1, 0}, .in = end}});
  const auto length = [](double x) { return 0.5 * x * std::sqrt(1 + 4 * x * x) + 0.25 * std::asinh(2 * x); };
  const Curve<Vec3> at_even_speed = even_path(parabola, 2);
  CHECK(at_even_speed.rate(0.7).norm() == doctest::Approx(length(1) / 2).epsilon(1e-14));
  for (const double t : {0.1, 0.7, 1.0, 1.93})
    CHECK(length(at_even_speed.value(t)[0]) == doctest::Approx(length(1) * t / 2).epsilon(1e-14));

  const Curve<Vec3> circle = arc({.center = {1, 2, 3}, .from = {4, 2, 3}, .angle = -5});
  CHECK(even_path(circle, 3).rate(1).norm() == doctest::Approx(5).epsilon(1e-14));
  const Curve<double> x = oscillator({}), y = oscillator({.phase = -pi / 2});
  const Curve<Vec3> helix = parametric(x, y, keyed_curve<double>({{0, 0, Ease::linear()}, {2, 1}}));
  CHECK_THROWS_WITH_AS((void)even_path(helix, 1), doctest::Contains("end"), std::invalid_argument);
  // A helix at an increasing pace: its length is sqrt((2 pi)^2 + 0.5^2).
  const Curve<Vec3> growing(
      [helix](double t, Side side) {
        Sample<Vec3> s = helix.sample(t * t, side);
        s.acceleration = 4 * t * t * s.acceleration + 2 * s.rate;
        s.rate *= 2 * t;
        return s;
      },
      0, 1);
  const Curve<Vec3> steady = even_path(growing, 1);
  CHECK(steady.rate(0.3).norm() == doctest::Approx(std::sqrt(4 * pi * pi + 0.25)).epsilon(1e-13));
  CHECK(near(steady.value(0.3), helix.value(0.3), 1e-13));
  CHECK(near(steady.sample(0.3).acceleration, helix.sample(0.3).acceleration, 1e-11));
  CHECK_THROWS_AS((void)even_path(Curve<Vec3>({1, 2, 3}), 1), std::invalid_argument);
}

TEST_CASE("a shape far from time zero, with a cusp or at rest, still becomes a path") {
  const auto key = [](double time, const Vec3& value, const Vec3& rate) {
    const Tangent<Vec3> tangent{Tangent<Vec3>::Kind::given, rate};
    return Key<Vec3>{.time = time, .value = value, .in = tangent, .out = tangent};
  };
  const Curve<Vec3> near_zero = keyed_curve<Vec3>({key(0, {0, 0, 0}, {1, 3, 0}), key(1, {2, 0, 1}, {0, -1, 5})});
  const Curve<Vec3> far = keyed_curve<Vec3>({key(1e9, {0, 0, 0}, {1, 3, 0}), key(1e9 + 1, {2, 0, 1}, {0, -1, 5})});
  CHECK(even_path(far, 1).rate(0.5).norm() == doctest::Approx(even_path(near_zero, 1).rate(0.5).norm()).epsilon(1e-9));
  // (t^2, t^3) from -1 to 1: the cusp's length is 2 (13^1.5 - 8) / 27.
  const Curve<Vec3> cusp = keyed_curve<Vec3>({key(-1, {1, -1, 0}, {-2, 3, 0}), key(1, {1, 1, 0}, {2, 3, 0})});
  CHECK(even_path(cusp, 1).rate(0.3).norm() == doctest::Approx(2 * (std::pow(13, 1.5) - 8) / 27).epsilon(1e-11));
  CHECK(near(even_path(cusp, 1).value(0.5), Vec3(0, 0, 0), 1e-6));
  const Curve<Vec3> held = keyed_curve<Vec3>(
      {{0, {0, 0, 0}, Ease::linear()}, {1, {1, 0, 0}, Ease::hold()}, {2, {1, 0, 0}, Ease::linear()}, {3, {1, 1, 0}}});
  CHECK(near(even_path(held, 2).value(1.5), Vec3(1, 0.5, 0), 1e-14));
}

TEST_CASE("a path agrees with the arc lengths of the vectors") {
  for (const nlohmann::json& family : vector_family("arc_length"))
    for (const nlohmann::json& each : family["cases"]) {
      CAPTURE(each["name"]);
      const nlohmann::json& input = each["input"];
      const auto point = [](const nlohmann::json& row) {
        Vec3 result(0, 0, 0);
        for (std::size_t i = 0; i < row.size(); ++i) result[static_cast<Eigen::Index>(i)] = row[i];
        return result;
      };
      std::vector<Key<Vec3>> keys;
      for (std::size_t i = 0; i < input["x"].size(); ++i) {
        const Tangent<Vec3> tangent{Tangent<Vec3>::Kind::given, point(input["tangents"][i])};
        keys.push_back({.time = input["x"][i], .value = point(input["points"][i]), .in = tangent, .out = tangent});
      }
      const Curve<Vec3> at_even_speed = even_path(keyed_curve<Vec3>(keys), 1);
      const double total = each["total"];
      CHECK(std::abs(at_even_speed.rate(0.4).norm() - total) < 1e-8 * total);
      for (std::size_t i = 0; i < each["fraction"].size(); ++i)
        CHECK((at_even_speed.value(each["fraction"][i]) - point(each["value"][i])).norm() <
              1e-6 * std::max(1.0, total));
    }
}

TEST_CASE("points that do not make a path are refused by their number") {
  CHECK_THROWS_WITH_AS((void)even_path({.points = {{0, 0, 0}}}), doctest::Contains("two points"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)even_path({.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}}), doctest::Contains("point 2"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)even_path({.points = {{0, 0, 0}, {std::nan(""), 0, 0}}}), doctest::Contains("point 1"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)even_path({.points = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, .closed = true}),
                       doctest::Contains("closed"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)even_path({.points = ring(3), .duration = 0}), doctest::Contains("duration"),
                       std::invalid_argument);
}

TEST_CASE("a line leads from its first point to its second at a steady rate") {
  const Curve<Vec3> c = line({.from = {1, 2, 3}, .to = {3, 2, -1}, .duration = 2});
  CHECK(c.value(0) == Vec3(1, 2, 3));
  CHECK(c.value(2) == Vec3(3, 2, -1));
  // At the start only the first point counts: weights 1 - u and u.
  CHECK(c.value(0.5) == Vec3(1.5, 2, 2));
  CHECK(c.rate(0) == Vec3(1, 0, -2));
  CHECK(c.rate(2, Side::in) == Vec3(1, 0, -2));
  CHECK_THROWS_AS((void)line({.duration = 0}), std::invalid_argument);
}

TEST_CASE("an arc turns about its axis at a steady rate, along its circle's tangent at both ends") {
  const Curve<Vec3> c =
      arc({.center = {1, 1, 1}, .from = {3, 1, 6}, .axis = {0, 0, 2}, .angle = pi / 2, .duration = 4});
  CHECK(near(c.value(0), Vec3(3, 1, 6), 1e-15));
  CHECK(near(c.value(4), Vec3(1, 3, 6), 1e-15));
  CHECK(near(c.rate(0), Vec3(0, 2 * pi / 8, 0), 1e-15));
  CHECK(near(c.rate(4, Side::in), Vec3(-2 * pi / 8, 0, 0), 1e-15));
  CHECK(near(c.sample(1).acceleration, Vec3(-std::pow(pi / 8, 2) * (c.value(1) - Vec3(1, 1, 6))), 1e-14));
  CHECK(near(c.value(9), c.value(4), 1e-15));
  CHECK_THROWS_WITH_AS((void)arc({.axis = {0, 0, 0}}), doctest::Contains("axis"), std::invalid_argument);
}

TEST_CASE("a parametric curve has its coordinates' values and rates") {
  const Curve<double> x = oscillator({.hz = 0.5}), y = oscillator({.hz = 0.5, .phase = -pi / 2});
  const Curve<Vec3> helix = parametric(
      x, y, keyed_curve<double>({{0, 0, Ease::linear()}, {1, 0.3}}).with_outside(Outside::linear, Outside::linear));
  const Sample<Vec3> s = helix.sample(3.25);
  CHECK(near(s.value, Vec3(std::cos(3.25 * pi), std::sin(3.25 * pi), 0.975), 1e-14));
  CHECK(s.rate.norm() == doctest::Approx(std::sqrt(pi * pi + 0.09)).epsilon(1e-14));
  CHECK(parametric(Curve<double>(2), keyed_curve<double>({{1, 0}, {3, 5}})).start() == 1);
}

TEST_CASE("basis functions with coefficients give the line, with one basis for all coordinates") {
  const std::vector<Curve<double>> basis = {keyed_curve<double>({{0, 1, Ease::linear()}, {1, 0}}),
                                            keyed_curve<double>({{0, 0, Ease::linear()}, {1, 1}})};
  const std::vector<Vec3> ends = {{1, 2, 3}, {5, 2, 1}};
  const Curve<Vec3> c = combined<Vec3>(basis, ends);
  CHECK(c.value(0) == ends[0]);
  CHECK(c.value(1) == ends[1]);
  CHECK(c.value(0.25) == Vec3(2, 2, 2.5));
  CHECK(c.rate(0.25) == Vec3(4, 0, -2));
  CHECK(c.end() == 1);
  CHECK_THROWS_AS((void)combined<double>(basis, std::vector<double>{1}), std::invalid_argument);
}
