#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/keys.h>

#include "stated.h"

using namespace tweenfall;

namespace {

Curve<double> hermite_curve(const nlohmann::json& input) {
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < input["x"].size(); ++i) {
    const Tangent<double> slope{Tangent<double>::Kind::given, input["slopes"][i]};
    keys.push_back({input["x"][i], input["y"][i], Ease::smooth_clamped(), slope, slope});
  }
  return keyed_curve<double>(keys);
}

bool any_near(const std::vector<double>& times, double time, double tolerance) {
  return std::ranges::any_of(times, [&](double t) { return std::abs(t - time) <= tolerance; });
}

// Every time of the one list is in the other.
void check_same_times(const std::vector<double>& ours, const std::vector<double>& theirs, double tolerance) {
  for (const double time : theirs) CHECK_MESSAGE(any_near(ours, time, tolerance), "no time of ours near " << time);
  for (const double time : ours) CHECK_MESSAGE(any_near(theirs, time, tolerance), "ours alone has " << time);
  CHECK(ours.size() == theirs.size());
}

}  // namespace

TEST_CASE("Hermite curves agree with scipy in value, both rates and integral") {
  for (const auto& file : test::vector_family("hermite_cubic")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const std::vector<double> t = c["t"];
      const Curve<double> curve = hermite_curve(c["input"]);
      const double first = curve.start(), whole = curve.end() - first;
      const double size = test::largest(c["value"]), speed = test::largest(c["derivative"]),
                   bend = test::largest(c["second"]);
      for (std::size_t k = 0; k < t.size(); ++k) {
        CAPTURE(t[k]);
        const Sample<double> s = curve.sample(t[k], k + 1 == t.size() ? Side::in : Side::out);
        CHECK(std::abs(s.value - c["value"][k].get<double>()) <= tolerance * size);
        CHECK(std::abs(s.rate - c["derivative"][k].get<double>()) <= tolerance * speed);
        CHECK(std::abs(s.acceleration - c["second"][k].get<double>()) <= tolerance * bend);
        CHECK(std::abs(integral(curve, first, t[k]) - c["antiderivative_from_first"][k].get<double>()) <=
              tolerance * size * whole);
      }
      const auto& part = c["integral"];
      CHECK(std::abs(integral(curve, part["a"], part["b"]) - part["value"].get<double>()) <= tolerance * size * whole);
    }
  }
}

TEST_CASE("Hermite curves agree with scipy in range, extremes and the times of a level, none missing and none more") {
  for (const auto& file : test::vector_family("hermite_cubic")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const Curve<double> curve = hermite_curve(c["input"]);
      const double whole = curve.end() - curve.start(), close = test::stated(file, "tolerance", "root times") * whole;
      const Range r = range(curve, curve.start(), curve.end());
      CHECK(std::abs(r.low - c["min"].get<double>()) <= tolerance * test::largest(c["value"]));
      CHECK(std::abs(r.high - c["max"].get<double>()) <= tolerance * test::largest(c["value"]));
      const std::vector<double> ours = extrema(curve);
      // Of a constant curve any time is stationary, and on its own level any time is a solution.
      if (r.low == r.high) {
        CHECK(ours.empty());
        continue;
      }
      check_same_times(solve(curve, c["solve"]["level"], curve.start(), curve.end()), c["solve"]["t"], close);
      const std::vector<double> theirs = c["extrema_t"];
      for (const double time : ours) CHECK_MESSAGE(any_near(theirs, time, close), "ours alone has " << time);
      for (const double time : theirs) {
        // Theirs are zeros of the rate; where it only touches zero, or the curve ends, ours need not tell any.
        const bool inside = time - curve.start() > 2 * close && curve.end() - time > 2 * close;
        const bool passes = inside && curve.rate(time - 2 * close) * curve.rate(time + 2 * close) < 0;
        if (passes) CHECK_MESSAGE(any_near(ours, time, close), "no extreme of ours near " << time);
      }
    }
  }
}

TEST_CASE("integrals and levels go on outside the knots as the curve does") {
  const Curve<double> line = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}});
  CHECK(integral(line, -1, 3) == doctest::Approx(1 + 4));
  CHECK(integral(line, 3, -1) == doctest::Approx(-5));
  const Curve<double> straight = line.with_outside(Outside::linear, Outside::linear);
  CHECK(integral(straight, -1, 3) == doctest::Approx(9 - 1));
  CHECK(solve(straight, 5, -1, 3) == std::vector<double>{2.5});
  const Curve<double> again = line.with_outside(Outside::repeat, Outside::repeat);
  CHECK(integral(again, 0, 10.5) == doctest::Approx(10.25));
  CHECK(solve(again, 1, 0, 3).size() == 3);
  const Curve<double> back = line.with_outside(Outside::pingpong, Outside::pingpong);
  CHECK(integral(back, 0, 1.5) == doctest::Approx(1.75));
}

TEST_CASE("a curve that rests on the level gives the two ends of the rest") {
  const Curve<double> c = keyed_curve<double>(
      {{0, 0, Ease::linear()}, {1, 2, Ease::linear()}, {2, 2, Ease::linear()}, {3, 2, Ease::linear()}, {4, 0}});
  CHECK(solve(c, 2, 0, 4) == std::vector<double>{1, 3});
  CHECK(range(c, 0.5, 4).low == 0);
  CHECK(range(c, 0.5, 3).low == 1);
}

TEST_CASE("integral, range and solve know counted plays and given slopes outside") {
  const Curve<double> line = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}});
  const Curve<double> c =
      line.with_outside(OutsideRule<double>{Outside::linear, -1}, OutsideRule<double>{Outside::repeat_offset, {}, 2});
  // Triangle, three climbs that go on from each other, then rest at 6.
  CHECK(integral(c, -2, 0) == doctest::Approx(2));
  CHECK(integral(c, 0, 3) == doctest::Approx(9));
  CHECK(integral(c, 0, 5) == doctest::Approx(21));
  CHECK(integral(c, 4, 5) == doctest::Approx(6));
  CHECK(range(c, -2, 9).high == doctest::Approx(6));
  CHECK(solve(c, 5, 0, 9).front() == doctest::Approx(2.5));
  const Curve<double> before = line.with_outside(OutsideRule<double>{Outside::repeat, {}, 1.5}, {});
  CHECK(integral(before, -3, 0) == doctest::Approx(1 + 0.75 + 1.5));
}
