#include <tweenfall/curves/basis.h>
#include <tweenfall/curves/splines.h>

#include <stdexcept>

#include "curves/span_derivative.h"
#include "support.h"

using namespace tweenfall;

namespace {

// A full knot vector for `control` points, clamped or not, with a double knot here and there.
std::vector<double> random_knots(test::Random& random, int degree, std::size_t control, bool clamped) {
  const std::size_t p = static_cast<std::size_t>(degree), count = control + p + 1;
  std::vector<double> knots(count);
  double t = random.between(-2, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const bool inside = i > p + 1 && i < control;
    const bool repeated = (clamped && ((i > 0 && i <= p) || i > control)) || (inside && i % 5 == 4 && degree > 1);
    if (!repeated) t += random.between(0.1, 1);
    knots[i] = t;
  }
  return knots;
}

}  // namespace

TEST_CASE("Bernstein polynomials are a partition of unity with the slopes of their formula") {
  for (int degree = 0; degree <= 5; ++degree)
    for (const double u : {0.0, 0.1, 0.5, 0.93, 1.0}) {
      Sample<double> sum{0, 0, 0};
      double line = 0;
      for (int i = 0; i <= degree; ++i) {
        const Sample<double> s = bernstein(degree, i, u);
        CHECK(s.value >= 0);
        sum.value += s.value;
        sum.rate += s.rate;
        sum.acceleration += s.acceleration;
        if (degree > 0) line += s.rate * i / degree;
      }
      CHECK(test::near(sum.value, 1, 1e-15));
      CHECK(std::abs(sum.rate) < 1e-14);
      CHECK(std::abs(sum.acceleration) < 1e-13);
      if (degree > 0) CHECK(test::near(line, 1, 1e-14));  // evenly spaced weights give a straight line
    }
  CHECK(bernstein(3, 1, 0.25).value == 3 * 0.25 * 0.75 * 0.75);
  CHECK(bernstein(2, 1, 0.25).rate == 2 - 4 * 0.25);
  CHECK(bernstein(2, 1, 0.25).acceleration == -4);
  CHECK_THROWS_WITH_AS(static_cast<void>(bernstein(6, 0, 0)), doctest::Contains("0 to 5"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(bernstein(2, 3, 0)), doctest::Contains("no number 3"), std::invalid_argument);
}

TEST_CASE("B-spline basis functions are a partition of unity, and weigh a spline's control points") {
  test::Random random(21);
  for (int n = 0; n < 40; ++n) {
    const int degree = 1 + n % 5;
    const std::size_t count = static_cast<std::size_t>(degree) + 1 + static_cast<std::size_t>(n % 4);
    const std::vector<double> knots = random_knots(random, degree, count, n % 2 == 0);
    std::vector<Vec2> control;
    for (std::size_t i = 0; i < count; ++i) control.push_back(Vec2(random.between(-3, 3), random.between(-3, 3)));
    const Curve<Vec2> curve = b_spline<Vec2>(degree, knots, control);
    CHECK(curve.start() == knots[static_cast<std::size_t>(degree)]);
    CHECK(curve.end() == knots[count]);
    for (int k = 0; k <= 40; ++k) {
      const double t = k == 40 ? curve.end() : curve.start() + k / 40.0 * curve.duration();
      const Side side = k == 40 ? Side::in : Side::out;
      double unity = 0;
      Sample<Vec2> sum{Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)};
      for (std::size_t i = 0; i < count; ++i) {
        const Sample<double> weight = b_spline_basis(knots, degree, i, t, side);
        CHECK(weight.value >= 0);
        unity += weight.value;
        sum.value += weight.value * control[i];
        sum.rate += weight.rate * control[i];
        sum.acceleration += weight.acceleration * control[i];
      }
      const Sample<Vec2> s = curve.sample(t, side);
      CHECK(test::near(unity, 1, 1e-14));
      CHECK(test::near(s.value, sum.value, 1e-13));
      CHECK(test::near(s.rate, sum.rate, 1e-11));
      CHECK(test::near(s.acceleration, sum.acceleration, 1e-9));
    }
  }
  const std::vector<double> few = {0, 1, 2};
  CHECK_THROWS_WITH_AS(static_cast<void>(b_spline_basis(few, 2, 0, 0.5)), doctest::Contains("needs 4 knots"),
                       std::invalid_argument);
}

TEST_CASE("a B-spline of degree p has p - 1 continuous derivatives at a simple knot") {
  test::Random random(22);
  for (int degree = 2; degree <= 5; ++degree) {
    std::vector<double> knots, control;
    for (int i = 0; i < 2 * degree + 6; ++i) knots.push_back(i + random.between(0, 0.9));
    for (int i = 0; i < degree + 5; ++i) control.push_back(random.between(-2, 2));
    const Curve<double> curve = b_spline<double>(degree, knots, control);
    for (std::size_t k = 1; k + 1 < curve.knots().size(); ++k) {
      const auto from = [&curve, k](int order, Side side) {
        return test::derivative_of_spans(curve, order, curve.knots()[k], side);
      };
      for (int order = 1; order < degree; ++order)
        CHECK(std::abs(from(order, Side::in) - from(order, Side::out)) <= 1e-8 * (1 + std::abs(from(order, Side::in))));
      CHECK(from(degree, Side::in) != from(degree, Side::out));
    }
  }
}
