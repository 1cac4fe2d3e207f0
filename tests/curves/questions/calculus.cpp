#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/keys.h>

#include "curves/stated.h"

using namespace tweenfall;
using namespace tweenfall::test;

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

// Every time in the one list is in the other.
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
        // Theirs are zeros of the rate; where it only touches zero, or the curve ends, ours may omit some.
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

TEST_CASE("integrals of splines through slopes given by scipy agree with scipy's") {
  for (const char* family : {"pchip", "akima", "cubic_spline"}) {
    std::size_t compared = 0;
    for (const auto& file : test::vector_family(family)) {
      const double tolerance = test::tolerance(file);
      for (const auto& c : file["cases"]) {
        // Vector splines come without slopes and integral.
        if (!c.contains("integral") || !c.contains("slopes")) continue;
        ++compared;
        CAPTURE(c["name"].get<std::string>());
        nlohmann::json input = c["input"];
        input["slopes"] = c["slopes"];
        const Curve<double> curve = hermite_curve(input);
        const double scale = test::largest(c["value"]) * curve.duration();
        const double a = c["integral"]["a"], b = c["integral"]["b"];
        CHECK(std::abs(integral(curve, a, b) - c["integral"]["value"].get<double>()) <= tolerance * scale);
        const Curve<double> area = antiderivative(curve);
        CHECK(std::abs(area.value(b) - area.value(a) - c["integral"]["value"].get<double>()) <= tolerance * scale);
      }
    }
    CAPTURE(std::string(family));
    CHECK(compared > 0);
  }
}

TEST_CASE("quintic spans agree with scipy in integral and in the third derivative") {
  for (const auto& file : test::vector_family("quintic_hermite"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const auto& in = c["input"];
      std::vector<Span<double>> spans;
      for (std::size_t i = 0; i + 1 < in["x"].size(); ++i) {
        const double start = in["x"][i], h = in["x"][i + 1].get<double>() - start;
        const double y0 = in["y"][i], y1 = in["y"][i + 1];
        const double v0 = in["velocity"][i].get<double>() * h, v1 = in["velocity"][i + 1].get<double>() * h;
        const double a0 = in["acceleration"][i].get<double>() * h * h;
        const double a1 = in["acceleration"][i + 1].get<double>() * h * h;
        // The six conditions solved by hand, in the position 0 to 1.
        Span<double> span{};
        span.start = start;
        span.duration = h;
        span.degree = 5;
        span.end = y1;
        span.coefficients = {y0,
                             v0,
                             a0 / 2,
                             10 * (y1 - y0) - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1,
                             15 * (y0 - y1) + 8 * v0 + 7 * v1 + 1.5 * a0 - a1,
                             6 * (y1 - y0) - 3 * (v0 + v1) - 0.5 * (a0 - a1)};
        spans.push_back(span);
      }
      const Curve<double> curve{std::span<const Span<double>>(spans)};
      const double tolerance = test::tolerance(file), scale = test::largest(c["value"]) * curve.duration();
      const double a = c["integral"]["a"], b = c["integral"]["b"], expected = c["integral"]["value"];
      CHECK(std::abs(integral(curve, a, b) - expected) <= tolerance * scale);
      const Curve<double> area = antiderivative(curve, 2.0);
      CHECK(area.value(curve.start()) == 2);
      CHECK(std::abs(area.value(b) - area.value(a) - expected) <= tolerance * scale);
      CHECK(area.rate(b) == curve.value(b));
      const Curve<double> speed = derivative(curve);
      const std::vector<double> t = c["t"], third = c["third"], second = c["second"];
      for (std::size_t k = 0; k < t.size(); ++k) {
        const Side side = k + 1 == t.size() ? Side::in : Side::out;
        CHECK(std::abs(derivative_at(curve, 3, t[k], side) - third[k]) <= tolerance * test::largest(c["third"]));
        CHECK(std::abs(speed.sample(t[k], side).acceleration - third[k]) <= tolerance * test::largest(c["third"]));
        CHECK(std::abs(speed.rate(t[k], side) - second[k]) <= tolerance * test::largest(c["second"]));
      }
    }
}

TEST_CASE("monotone curves are inverted as the splines module does") {
  for (const auto& file : test::vector_family("monotone_cubic"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      nlohmann::json input = c["input"];
      input["slopes"] = c["slopes"];
      const Curve<double> curve = hermite_curve(input);
      const double tolerance = test::tolerance(file);
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const Sample<double> s = curve.sample(c["t"][k], k + 1 == c["t"].size() ? Side::in : Side::out);
        CHECK(test::near(s.value, c["value"][k], tolerance * test::largest(c["value"])));
        CHECK(test::near(s.rate, c["derivative"][k], tolerance * std::max(1.0, test::largest(c["derivative"]))));
      }
      // Where the data turn, there is no inverse, and the file has none.
      if (!c.contains("inverse")) continue;
      const Curve<double> time_of = inverse(curve);
      for (std::size_t k = 0; k < c["inverse"]["t"].size(); ++k) {
        const double value = c["inverse"]["value"][k], time = c["inverse"]["t"][k];
        // Their times have ten digits, so no more can be asked.
        CHECK(test::near(time_of.value(value), time, 1e-9));
        CHECK(std::abs(curve.value(time_of.value(value)) - value) <= tolerance * test::largest(c["value"]));
        const Sample<double> s = time_of.sample(value);
        CHECK(s.rate * curve.rate(s.value) == doctest::Approx(1));
      }
    }
}

TEST_CASE("integrals of eases and of weighted handles have their closed forms") {
  const auto eased = [](const char* word) { return keyed_curve<double>({{1, 2, *Ease::named(word)}, {3, 5}}); };
  // From 2 by 3 over 2 s: 2 * 2 + 3 * 2 * mean of the ease.
  CHECK(integral(eased("sine-in"), 1, 3) == doctest::Approx(4 + 6 * (1 - 2 / pi)).epsilon(1e-13));
  CHECK(integral(eased("circ-out"), 1, 3) == doctest::Approx(4 + 6 * pi / 4).epsilon(1e-9));
  CHECK(integral(eased("sine-in-out"), 1, 3) == doctest::Approx(7).epsilon(1e-13));
  // Handles at (0.9, 0) and (0.4, 1): the area below (x(s), y(s)), by the midpoint rule in s.
  const double x[4] = {0, 0.9, 0.4, 1}, y[4] = {0, 0, 1, 1};
  double area = 0;
  const int steps = 2000000;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) / steps, r = 1 - s;
    const double dx = 3 * (r * r * (x[1] - x[0]) + 2 * r * s * (x[2] - x[1]) + s * s * (x[3] - x[2]));
    area += dx * (3 * r * s * s * y[2] + 3 * r * r * s * y[1] + s * s * s) / steps;
  }
  const Curve<double> handles = keyed_curve<double>({{0, 0, Ease::bezier(0.9, 0, 0.4, 1)}, {1, 1}});
  CHECK(integral(handles, 0, 1) == doctest::Approx(area).epsilon(1e-11));
  const Curve<double> up_to = antiderivative(handles);
  CHECK(up_to.value(1) == doctest::Approx(area).epsilon(1e-11));
  CHECK(up_to.value(0.3) + integral(handles, 0.3, 1) == doctest::Approx(area).epsilon(1e-11));
}

TEST_CASE("roots are the times of zero, and derivatives follow loops outside the knots") {
  const Curve<double> wave = keyed_curve<double>({{0, -1, Ease::linear()}, {1, 1, Ease::linear()}, {3, -3}});
  CHECK(roots(wave) == std::vector<double>{0.5, 1.5});
  const Curve<double> cubic =
      keyed_curve<double>({{0, 0, Ease::smooth_clamped(), {}, Tangent<double>{Tangent<double>::Kind::given, 1.0}},
                           {1, 2, Ease::smooth_clamped(), Tangent<double>{Tangent<double>::Kind::given, -3.0}}});
  // Hermite: value''' = 6 (d0 + d1 - 2 change).
  CHECK(derivative_at(cubic, 3, 0.3) == doctest::Approx(6 * (1 - 3 - 4)));
  CHECK(derivative_at(cubic, 4, 0.3) == 0);
  CHECK(derivative_at(cubic, 3, 1.3) == 0);
  const Curve<double> back = cubic.with_outside(Outside::repeat, Outside::pingpong);
  CHECK(derivative_at(back, 3, 1.3) == doctest::Approx(36));
  CHECK(derivative_at(back, 3, -0.3) == doctest::Approx(-36));
  CHECK_THROWS_AS((void)derivative_at(cubic, -1, 0), std::invalid_argument);
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
