#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/modifiers.h>

#include "importers/document/document_files.h"

#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

double length_of(const std::string& track) {
  return clip_of("a.b", track).duration;
}

}  // namespace

TEST_CASE("a spline in a document passes its points at its times, held to what its ends say") {
  const std::string points = R"("points": [0, 2, 1, 3], "times": [0, 0.5, 2, 3])";
  const Curve<double> natural = curve_of<double>("a.b", "{\"spline\": {" + points + "}}");
  const double times[] = {0, 0.5, 2, 3}, values[] = {0, 2, 1, 3};
  for (int i = 0; i < 4; ++i) CHECK(natural.value(times[i]) == doctest::Approx(values[i]).epsilon(1e-14));
  CHECK(std::abs(natural.sample(0).acceleration) < 1e-12);
  CHECK(natural.sample(2, Side::in).acceleration == doctest::Approx(natural.sample(2).acceleration).epsilon(1e-12));
  const Curve<double> held =
      curve_of<double>("a.b", "{\"spline\": {" + points + R"(, "start": {"rate": 7}, "end": {"acceleration": -2}}})");
  CHECK(held.rate(0) == doctest::Approx(7).epsilon(1e-13));
  CHECK(held.sample(3, Side::in).acceleration == doctest::Approx(-2).epsilon(1e-12));
  // Of a cubic, not-a-knot gives the cubic itself.
  const Curve<double> cubic = curve_of<double>(
      "a.b",
      R"({"spline": {"points": [0, 1, 8, 27], "times": [0, 1, 2, 3], "start": "not-a-knot", "end": "not-a-knot"}})");
  CHECK(cubic.value(2.3) == doctest::Approx(2.3 * 2.3 * 2.3).epsilon(1e-13));
}

TEST_CASE("points with rates are Hermite's cubics, with accelerations quintics") {
  const Curve<double> square =
      curve_of<double>("a.b", R"({"spline": {"points": [0, 4], "duration": 2, "rates": [0, 4]}})");
  CHECK(square.value(1.5) == doctest::Approx(2.25).epsilon(1e-14));
  const Curve<double> least = curve_of<double>(
      "a.b", R"({"spline": {"points": [0, 1], "duration": 2, "rates": [0, 0], "accelerations": [0, 0]}})");
  const double u = 0.3;  // 10 u^3 - 15 u^4 + 6 u^5
  CHECK(least.value(0.6) == doctest::Approx(u * u * u * (10 + u * (6 * u - 15))).epsilon(1e-14));
}

TEST_CASE("closed and spaced splines share the duration by distance and return") {
  const Curve<Vec3> loop = curve_of<Vec3>(
      "a.position",
      R"({"spline": {"points": [[0, 0, 0], [1, 0, 0], [1, 3, 0], [0, 3, 0]], "spacing": "chordal", "duration": 8, "closed": true}})");
  CHECK(near(loop.value(1), Vec3(1, 0, 0), 1e-14));
  CHECK(near(loop.value(4), Vec3(1, 3, 0), 1e-14));
  CHECK(near(loop.value(8, Side::in), Vec3(0, 0, 0), 1e-14));
  CHECK(near(loop.rate(8, Side::in), loop.rate(0), 1e-12));
}

TEST_CASE("control points draw Bezier curves and B-splines") {
  // The quadratic 2 s (1 - s) b + s^2 c.
  const Curve<Vec2> arch =
      curve_of<Vec2>("a.uv", R"({"bezier": {"degree": 2, "points": [[0, 0], [1, 1], [2, 0]], "duration": 4}})");
  CHECK(near(arch.value(1), Vec2(0.5, 0.375), 1e-15));
  const Curve<double> two =
      curve_of<double>("a.b", R"({"bezier": {"degree": 1, "points": [0, 1, 0], "times": [0, 1, 3]}})");
  CHECK(two.value(2) == doctest::Approx(0.5).epsilon(1e-15));
  // On one interval a clamped B-spline is a Bezier curve.
  const Curve<double> spline = curve_of<double>("a.b", R"({"b_spline": {"points": [0, 1, 1, 5], "duration": 2}})");
  const Curve<double> bezier = curve_of<double>("a.b", R"({"bezier": {"points": [0, 1, 1, 5], "duration": 2}})");
  CHECK(spline.value(0.7) == doctest::Approx(bezier.value(0.7)).epsilon(1e-14));
  // Evenly knotted, the middle of the span weighs its control values 1, 23, 23 and 1 of 48.
  const Curve<double> even =
      curve_of<double>("a.b", R"({"b_spline": {"points": [0, 48, 0, 96], "knots": [-3, -2, -1, 0, 1, 2, 3, 4]}})");
  CHECK(even.value(0.5) == doctest::Approx(23 + 2).epsilon(1e-14));
}

TEST_CASE("a spline ends the clip, and goes on as the track says") {
  CHECK(length_of(R"({"spline": {"points": [0, 1], "times": [1, 2.5]}})") == 2.5);
  CHECK(length_of(R"({"bezier": {"degree": 1, "points": [0, 1]}})") == 1);
  CHECK(length_of(R"({"b_spline": {"degree": 1, "points": [0, 1], "knots": [0, 1, 3, 9]}})") == 3);
  CHECK(std::isinf(length_of(R"({"spring": {"hz": 1, "goal": 1}})")));
  const Curve<double> on = curve_of<double>("a.b", R"({"after": "linear", "bezier": {"degree": 1, "points": [0, 2]}})");
  CHECK(on.value(3) == doctest::Approx(6).epsilon(1e-14));
}

TEST_CASE("degrees of splines and springs are degrees, and axes turn by them") {
  const Curve<Quat> turn = curve_of<Quat>(
      "a.rotation", R"({"axis": "z", "spline": {"points": [0, 90], "rates": [90, 90], "times": [0, 1]}})");
  CHECK(near(turn.rate(0.4), Vec3(0, 0, 90 * degree), 1e-14));
  const Curve<Quat> swing =
      curve_of<Quat>("a.rotation", R"({"axis": "x", "spring": {"hz": 1, "zeta": 0, "from": 30, "goal": 0}})");
  CHECK(2 * std::atan2(swing.value(0.5).x(), swing.value(0.5).w()) == doctest::Approx(-30 * degree).epsilon(1e-13));
}

TEST_CASE("a spring of a document is the exact damped spring, component by component") {
  const Curve<double> one = curve_of<double>(
      "a.b", R"({"spring": {"hz": 2, "zeta": 0.2, "from": 1, "velocity": 3, "goal": -1, "goal_velocity": 0.5}})");
  const Curve<double> exact =
      damped_spring({.hz = 2, .damping_ratio = 0.2, .position = 1, .velocity = 3, .goal = -1, .goal_velocity = 0.5});
  CHECK(one.value(0.37) == exact.value(0.37));
  CHECK(one.rate(0) == doctest::Approx(3).epsilon(1e-14));
  const Curve<Vec3> place = curve_of<Vec3>(
      "a.position",
      R"({"spring": {"hz": 2, "zeta": 0.2, "from": [0, 1, 0], "velocity": [0, 3, 0], "goal": [0, -1, 4], "goal_velocity": [0, 0.5, 0]}})");
  CHECK(place.value(0.37).y() == exact.value(0.37));
  CHECK(place.value(0.37).x() == 0);
  CHECK(place.value(40).z() == doctest::Approx(4).epsilon(1e-9));
}

TEST_CASE("modifiers change vectors component by component, or all alike") {
  const std::string keys = R"("keys": [[0, [0, 0, 0], "linear"], [2, [2, 4, 6]]])";
  const Curve<Vec3> some = curve_of<Vec3>(
      "a.position",
      "{" + keys + R"(, "modifiers": {"x": [{"limits": {"high": 0.5}}], "z": [{"stepped": {"step": 0.5}}]}})");
  CHECK(near(some.value(0.9), Vec3(0.5, 1.8, 1.5), 1e-14));
  CHECK(near(some.rate(0.9), Vec3(0, 2, 0), 1e-14));
  CHECK(some.knots().size() == 2);
  const Curve<Vec3> back =
      curve_of<Vec3>("a.position", "{" + keys + R"(, "modifiers": [{"warp": [[0, 2, "linear"], [2, 0]]}]})");
  CHECK(near(back.value(0.5), Vec3(1.5, 3, 4.5), 1e-14));
  CHECK(near(back.rate(0.5), Vec3(-1, -2, -3), 1e-14));
  const Curve<Quat> nod = curve_of<Quat>(
      "a.rotation",
      R"({"axis": "x", "keys": [[0, 0, "linear"], [1, 90]], "modifiers": [{"polynomial": {"coefficients": [10], "add": true}}]})");
  CHECK(2 * std::atan2(nod.value(0.5).x(), nod.value(0.5).w()) == doctest::Approx(55 * degree).epsilon(1e-14));
  CHECK(near(nod.rate(0.5), Vec3(90 * degree, 0, 0), 1e-14));
  // Of three angles only the first: held at 30 degrees while the last goes on.
  const Curve<Quat> held = curve_of<Quat>(
      "a.rotation",
      R"({"keys": [[0, {"euler": [0, 0, 0]}, "linear"], [1, {"euler": [90, 0, 40]}]], "modifiers": {"x": [{"limits": {"high": 30}}]}})");
  const Quat about_x(std::cos(15 * degree), std::sin(15 * degree), 0, 0);
  const Quat about_z(std::cos(10 * degree), 0, 0, std::sin(10 * degree));
  CHECK(near(held.value(0.5), about_x * about_z, 1e-14));
  CHECK(near(held.rate(0.5), about_x * Vec3(0, 0, 40 * degree), 1e-14));
}

TEST_CASE("splines through rotations pass them with the angular velocities that their ends state") {
  const Curve<Quat> spline = curve_of<Quat>(
      "a.rotation",
      R"({"spline": {"points": [{"euler": [0, 0, 0]}, {"axis": "z", "angle": 90}, {"axis": "x", "angle": 90}], "times": [0, 1, 3],
          "start": {"rate": [0, 0, 30]}, "end": {"rate": [10, 0, -20]}}})");
  CHECK(near(spline.rate(0), degree * Vec3(0, 0, 30), 1e-12));
  CHECK(near(spline.rate(3, Side::in), degree * Vec3(10, 0, -20), 1e-12));
  CHECK(near(spline.value(1), Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), 1e-12));
  CHECK(near(spline.rate(1, Side::in), spline.rate(1), 1e-9));
  // Control rotations about one axis: Bernstein's cubic of their angles, 90 u^3 + 3 u^2 (1 - u) 30.
  const Curve<Quat> bezier = curve_of<Quat>(
      "a.rotation",
      R"({"bezier": {"points": [{"axis": "y", "angle": 0}, {"axis": "y", "angle": 0}, {"axis": "y", "angle": 30}, {"axis": "y", "angle": 90}], "duration": 2}})");
  const double u = 0.4, angle = (90 * u * u * u + 90 * u * u * (1 - u)) * degree;
  CHECK(near(bezier.value(0.8), Quat(std::cos(angle / 2), 0, std::sin(angle / 2), 0), 1e-12));
}
