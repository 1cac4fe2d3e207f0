#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/splines.h>

#include <stdexcept>

#include "curves/span_derivative.h"
#include "curves/stated.h"

using namespace tweenfall;

namespace {

using Json = nlohmann::json;
using test::largest;

template <class T>
T read(const Json& j) {
  if constexpr (std::is_same_v<T, double>) {
    return (j.is_array() ? j[0] : j).template get<double>();
  } else {
    T result = zero<T>();
    for (std::size_t i = 0; i < j.size(); ++i) result[static_cast<Eigen::Index>(i)] = j[i];
    return result;
  }
}

template <class T>
std::vector<T> list(const Json& j) {
  std::vector<T> result;
  for (const Json& part : j) result.push_back(read<T>(part));
  return result;
}

template <class T>
double distance(const T& a, const T& b) {
  if constexpr (std::is_same_v<T, double>)
    return std::abs(a - b);
  else
    return (a - b).cwiseAbs().maxCoeff();
}

// Everything that a case lists, each within `tolerance` of its largest number; values that are only the rounding of
// something larger, relative to that.
template <class T>
void check_case(const Curve<T>& curve, const Json& c, double tolerance) {
  const double size = largest(c["value"]);
  double shortest = curve.duration();
  for (std::size_t i = 1; i < curve.knots().size(); ++i)
    shortest = std::min(shortest, curve.knots()[i] - curve.knots()[i - 1]);
  double speed = std::max(largest(c["derivative"]), size / curve.duration());
  if (c.contains("slopes")) speed = std::max(speed, largest(c["slopes"]));
  const double bend = std::max(c.contains("second") ? largest(c["second"]) : 0, speed / shortest);
  for (std::size_t k = 0; k < c["t"].size(); ++k) {
    const double t = c["t"][k];
    CAPTURE(t);
    const Side side = k + 1 == c["t"].size() ? Side::in : Side::out;
    const Sample<T> s = curve.sample(t, side);
    CHECK(distance(s.value, read<T>(c["value"][k])) <= tolerance * size);
    CHECK(distance(s.rate, read<T>(c["derivative"][k])) <= tolerance * speed);
    if (c.contains("second")) CHECK(distance(s.acceleration, read<T>(c["second"][k])) <= tolerance * bend);
    if constexpr (std::is_same_v<T, double>)
      if (c.contains("third"))
        CHECK(std::abs(test::derivative_of_spans(curve, 3, t, side) - c["third"][k].get<double>()) <=
              tolerance * std::max(largest(c["third"]), bend / shortest));
  }
  if constexpr (std::is_same_v<T, double>) {
    if (c.contains("slopes"))
      for (std::size_t i = 0; i < curve.knots().size(); ++i) {
        const Side side = i + 1 == curve.knots().size() ? Side::in : Side::out;
        CHECK(std::abs(curve.rate(curve.knots()[i], side) - c["slopes"][i].get<double>()) <= tolerance * speed);
      }
    if (c.contains("integral")) {
      const Json& part = c["integral"];
      CHECK(std::abs(integral(curve, part["a"], part["b"]) - part["value"].get<double>()) <=
            tolerance * size * curve.duration());
    }
  }
}

// Every case of a family with its file's tolerance.
template <class Check>
void each_case(const char* family, const Check& check) {
  for (const auto& file : test::vector_family(family)) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      check(c, tolerance);
    }
  }
}

Curve<double> keyed(const Json& input, const Ease& ease) {
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < input["x"].size(); ++i) keys.push_back({input["x"][i], input["y"][i], ease});
  return keyed_curve<double>(keys);
}

template <class T>
Curve<T> scipy_c2(const Json& input) {
  const auto x = list<double>(input["x"]);
  auto y = list<T>(input["y"]);
  const Json& bc = input["bc"];
  SplineEnds<T> ends;
  if (bc == "not-a-knot") ends.start = ends.end = SplineEnd<T>::not_a_knot();
  if (bc == "periodic") {
    ends.closed = true;
    y.pop_back();
  }
  if (bc.is_object()) {
    const auto end = [&bc](const Json& given) {
      return bc["order"] == 1 ? SplineEnd<T>::rate(read<T>(given)) : SplineEnd<T>::acceleration(read<T>(given));
    };
    ends = {end(bc["start"]), end(bc["end"])};
  }
  return c2_spline<T>(x, y, ends);
}

// A path of the `splines` module, over its own grid.
template <class T>
Curve<T> path(const Json& input, std::vector<double>& own_times) {
  const auto points = list<T>(input["points"]);
  const auto grid = list<double>(input["grid"]);
  const std::string parametrization = input["parametrization"];
  const bool closed = input["end"] == "closed";
  own_times = grid;
  if (parametrization != "grid")
    own_times = spline_times<T>(points,
                                parametrization == "uniform"       ? Parametrization::uniform
                                : parametrization == "centripetal" ? Parametrization::centripetal
                                                                   : Parametrization::chordal,
                                closed);
  SplineEnds<T> ends;
  ends.closed = closed;
  if (input["end"].is_object())
    ends = {SplineEnd<T>::rate(read<T>(input["end"]["start"])), SplineEnd<T>::rate(read<T>(input["end"]["end"]))};
  if (input["kind"] == "natural") return c2_spline<T>(grid, points, ends);
  if (input["kind"] == "catmull_rom") return cubic_spline<T>(grid, points, Ease::catmull_rom(), ends);
  std::vector<Ease> rules(points.size(), Ease::tcb(0, 0, 0));
  if (input.contains("tcb"))
    for (std::size_t i = 0; i < input["tcb"].size(); ++i) {
      const Json& tcb = input["tcb"][i];
      rules[closed ? i : i + 1] = Ease::tcb(tcb[0], tcb[1], tcb[2]);
    }
  return cubic_spline<T>(grid, points, rules, ends);
}

template <class T>
void check_path(const Json& c, double tolerance) {
  std::vector<double> own_times;
  const Curve<T> curve = path<T>(c["input"], own_times);
  const auto grid = list<double>(c["input"]["grid"]);
  REQUIRE(own_times.size() == grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i)
    CHECK(test::near(own_times[i] - own_times[0], grid[i] - grid[0], 1e-12));
  for (std::size_t k = 0; k < c["t"].size(); ++k) {
    const Sample<T> s = curve.sample(c["t"][k], k + 1 == c["t"].size() ? Side::in : Side::out);
    CHECK(test::near(s.value, read<T>(c["value"][k]), tolerance));
    CHECK(test::near(s.rate, read<T>(c["derivative"][k]), tolerance));
  }
}

}  // namespace

TEST_CASE("Akima's slopes agree with scipy") {
  each_case("akima",
            [](const Json& c, double tolerance) { check_case(keyed(c["input"], Ease::akima()), c, tolerance); });
}

TEST_CASE("modified Akima and pchip agree with Boost, with and without given end slopes") {
  each_case("makima", [](const Json& c, double tolerance) {
    const Json& input = c["input"];
    const Ease rule = input["kind"] == "makima" ? Ease::makima() : Ease::monotone();
    SplineEnds<double> ends;
    if (input.contains("start_slope")) ends.start = SplineEnd<double>::rate(input["start_slope"]);
    if (input.contains("end_slope")) ends.end = SplineEnd<double>::rate(input["end_slope"]);
    const auto x = list<double>(input["x"]), y = list<double>(input["y"]);
    check_case(cubic_spline<double>(x, y, rule, ends), c, tolerance);
    if (!input.contains("start_slope")) check_case(keyed(input, rule), c, tolerance);
  });
}

TEST_CASE("limited Catmull-Rom slopes agree with the splines module, and so does the way back from value to time") {
  each_case("monotone_cubic", [](const Json& c, double tolerance) {
    const auto x = list<double>(c["input"]["x"]), y = list<double>(c["input"]["y"]), slopes = list<double>(c["slopes"]);
    const Curve<double> given = hermite_spline<double>(x, y, slopes);
    check_case(given, c, tolerance);
    // The ends' slopes are the module's own; between them the rule is the same.
    const Curve<double> own = keyed(c["input"], Ease::catmull_rom_monotone());
    for (std::size_t i = 1; i + 1 < x.size(); ++i) CHECK(test::near(own.rate(x[i]), slopes[i], tolerance));
    if (!c.contains("inverse") || c["inverse"].is_null()) return;
    for (std::size_t i = 0; i < c["inverse"]["value"].size(); ++i) {
      const std::vector<double> times = solve(given, c["inverse"]["value"][i], given.start(), given.end());
      REQUIRE(times.size() == 1);
      // The file rounds these times to nine decimals.
      CHECK(std::abs(times[0] - c["inverse"]["t"][i].get<double>()) <= 1e-9);
    }
  });
}

TEST_CASE("cubic splines with every kind of end agree with scipy") {
  each_case("cubic_spline", [](const Json& c, double tolerance) {
    const Json& input = c["input"];
    if (input["y"][0].is_array()) return check_case(scipy_c2<Vec3>(input), c, tolerance);
    check_case(scipy_c2<double>(input), c, tolerance);
    // As words of keys, too.
    const Json& bc = input["bc"];
    const Ease ease = bc == "natural"      ? Ease::natural()
                      : bc == "periodic"   ? Ease::periodic()
                      : bc == "not-a-knot" ? Ease::not_a_knot()
                      : bc["order"] == 1   ? Ease::clamped(bc["start"], bc["end"])
                                           : Ease::natural(bc["start"], bc["end"]);
    check_case(keyed(input, ease), c, tolerance);
  });
}

TEST_CASE("quintic splines agree with scipy down to their third derivative") {
  each_case("quintic_hermite", [](const Json& c, double tolerance) {
    const Json& input = c["input"];
    const auto x = list<double>(input["x"]), y = list<double>(input["y"]);
    const auto v = list<double>(input["velocity"]), a = list<double>(input["acceleration"]);
    const Curve<double> curve = quintic_spline<double>(x, y, v, a);
    check_case(curve, c, tolerance);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (const Side side : {Side::in, Side::out}) {
        if (i == 0 && side == Side::in) continue;
        const Sample<double> s = curve.sample(x[i], i + 1 == x.size() ? Side::in : side);
        CHECK(s.value == y[i]);
        CHECK(test::near(s.rate, v[i], 1e-11));
        CHECK(test::near(s.acceleration, a[i], 1e-10 * std::max(1.0, largest(c["second"]))));
      }
  });
}

TEST_CASE("Bezier segments of degree 1 to 5 agree with scipy") {
  each_case("bernstein", [](const Json& c, double tolerance) {
    std::vector<double> control;
    for (const Json& segment : c["input"]["control"])
      for (const Json& value : segment) control.push_back(value);
    const auto x = list<double>(c["input"]["x"]);
    check_case(bezier_spline<double>(x, control), c, tolerance);
  });
}

TEST_CASE("B-splines of degree 1 to 5 agree with scipy") {
  each_case("bspline", [](const Json& c, double tolerance) {
    const Json& input = c["input"];
    const auto knots = list<double>(input["knots"]);
    const int degree = input["degree"];
    const auto check = [&](auto kind) {
      using T = decltype(kind);
      const auto control = list<T>(input["control"]);
      check_case(b_spline<T>(degree, knots, control), c, tolerance);
    };
    const std::size_t size = input["control"][0].size();
    REQUIRE(size >= 1);
    REQUIRE(size <= 4);
    if (size == 1) check(double{});
    if (size == 2) check(Vec2{});
    if (size == 3) check(Vec3{});
    if (size == 4) check(Vec4{});
  });
}

TEST_CASE("paths through points agree with the splines module for every parametrization and every end") {
  each_case("catmull_kb_natural", [](const Json& c, double tolerance) {
    const std::size_t size = c["input"]["points"][0].size();
    REQUIRE(size >= 1);
    REQUIRE(size <= 3);
    if (size == 1) check_path<double>(c, tolerance);
    if (size == 2) check_path<Vec2>(c, tolerance);
    if (size == 3) check_path<Vec3>(c, tolerance);
  });
}

TEST_CASE("a spline's given ends are met") {
  const std::vector<double> times = {0, 1, 3, 4.5}, values = {2, -1, 5, 0};
  using End = SplineEnd<double>;
  for (const Ease& rule : {Ease::smooth(), Ease::makima(), Ease::catmull_rom(), Ease::centripetal()}) {
    const Curve<double> curve = cubic_spline<double>(times, values, rule, {End::acceleration(3), End::rate(-2)});
    CHECK(test::near(curve.sample(0).acceleration, 3, 1e-13));
    CHECK(test::near(curve.rate(4.5, Side::in), -2, 1e-13));
  }
  const std::vector<double> two = {0, 2}, ends = {1, 4};
  const Curve<double> one =
      cubic_spline<double>(two, ends, Ease::akima(), {End::acceleration(3), End::acceleration(-6)});
  CHECK(test::near(one.sample(0).acceleration, 3, 1e-13));
  CHECK(test::near(one.sample(2, Side::in).acceleration, -6, 1e-13));
}

TEST_CASE("a B-spline on clamped knots begins and ends at its control points, along its first and last legs") {
  const std::vector<Vec2> control = {{0, 1}, {2, 5}, {3, -1}, {4, 4}, {7, 0}};
  for (int degree = 1; degree <= 4; ++degree) {
    const Curve<Vec2> curve = b_spline<Vec2>(degree, clamped_knots(degree, control.size(), -1, 3), control);
    CHECK(curve.start() == -1);
    CHECK(curve.end() == 3);
    CHECK(curve.value(-1) == control.front());
    CHECK(curve.value(3, Side::in) == control.back());
    const double first = degree * (control.size() - static_cast<std::size_t>(degree)) / 4.0;
    CHECK(test::near(curve.rate(-1), Vec2(first * (control[1] - control[0])), 1e-13));
    CHECK(test::near(curve.rate(3, Side::in), Vec2(first * (control[4] - control[3])), 1e-13));
  }
  CHECK(clamped_knots(2, 4, 0, 1) == std::vector<double>{0, 0, 0, 0.5, 1, 1, 1});
}

TEST_CASE("data that is no spline is refused with index and value") {
  const std::vector<double> t = {0, 1, 2}, v = {5, 6, 7}, backwards = {0, 2, 1}, endless = {0, 1, HUGE_VAL},
                            two = {1, 2};
  const auto refused = [](const auto& build, const char* text) {
    CHECK_THROWS_WITH_AS(build(), doctest::Contains(text), std::invalid_argument);
  };
  refused([&] { (void)c2_spline<double>(backwards, v); }, "number 2, 1 s, does not come after 2 s");
  refused([&] { (void)c2_spline<double>(endless, v); }, "non-finite time inf at 2");
  refused([&] { (void)c2_spline<double>(t, two); }, "needs 3 values here; 2 were given");
  refused([&] { (void)c2_spline<double>(t, v, {.closed = true}); }, "needs 2 values here; 3 were given");
  refused([&] { (void)hermite_spline<double>(t, v, endless); }, "non-finite rate inf at 2");
  refused([&] { (void)cubic_spline<double>(t, v, Ease::hold()); }, "\"hold\"");
  refused([&] { (void)cubic_spline<double>(t, v, Ease::natural(), {SplineEnd<double>::rate(1)}); }, "c2_spline");
  refused([&] { (void)cubic_spline<double>(t, v, Ease::akima(), {SplineEnd<double>::not_a_knot()}); }, "knot");
  refused([&] { (void)bezier_spline<double>(t, v); }, "needs 2 control values here; 3 were given");
  refused([&] { (void)b_spline<double>(3, t, v); }, "needs 4 control points or more; 3 were given");
  refused([&] { (void)clamped_knots(3, 3, 0, 1); }, "needs 4 control points or more; 3 were given");
  refused([&] { (void)clamped_knots(3, 5, 1, 0); }, "number 1, 0 s, does not come after 1 s");
  refused([&] { (void)b_spline<double>(1, t, v); }, "needs 5 knots here; 3 were given");
  const std::vector<double> thrice = {0, 0, 1, 1, 1, 1}, four = {1, 2, 3, 4}, turned = {0, 0, 2, 1, 3, 3};
  refused([&] { (void)b_spline<double>(1, thrice, four); }, "2 times at most; 1 occurs more often");
  refused([&] { (void)b_spline<double>(1, turned, four); }, "number 3, 1, lies before 2");
  const std::vector<Vec2> same = {{1, 2}, {3, 4}, {3, 4}};
  refused([&] { (void)spline_times<Vec2>(same, Parametrization::chordal); }, "number 2, (3, 4), lies 0 from");
  CHECK(spline_times<Vec2>(same, Parametrization::uniform, true) == std::vector<double>{0, 1, 2, 3});
}
