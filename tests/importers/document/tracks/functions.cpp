#include <tweenfall/curves/functions.h>

#include "importers/document/document_files.h"

#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {}  // namespace

TEST_CASE("an expression is a track's value at every time, with its exact rate") {
  const Curve<double> wave = curve_of<double>("a.b", R"json({"expression": "2*cos(t)"})json");
  CHECK(wave.value(0.7) == doctest::Approx(2 * std::cos(0.7)).epsilon(1e-15));
  CHECK(wave.rate(0.7) == doctest::Approx(-2 * std::sin(0.7)).epsilon(1e-15));
  const Curve<Vec3> place =
      curve_of<Vec3>("a.position", R"({"expression": ["t", 3, "g*t^2/2"], "parameters": {"g": -9.81}})");
  CHECK(near(place.value(2), Vec3(2, 3, -19.62), 1e-15));
  CHECK(near(place.rate(2), Vec3(1, 0, -19.62), 1e-15));
  CHECK(curve_of<Vec2>("a.uv", R"({"expression": ["t", 1]})").value(3) == Vec2(3, 1));
  CHECK(curve_of<Vec4>("a.uv", R"({"expression": ["t", 1, 2, "t"]})").value(3) == Vec4(3, 1, 2, 3));
  CHECK(curve_of<Vec3>("a.scale", R"({"expression": "1+t"})").value(3) == Vec3(4, 4, 4));
}

TEST_CASE("angles of functions are degrees, and rotations turn about the axis by them") {
  const Curve<Quat> turn = curve_of<Quat>("a.rotation", R"({"axis": "z", "expression": "90*t"})");
  CHECK(near(turn.value(1), Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), 1e-15));
  CHECK(near(turn.rate(0.3), Vec3(0, 0, pi / 2), 1e-15));
  const Curve<double> exact = pendulum({.angle = 150 * degree, .length = 2});
  const Curve<Quat> swing = curve_of<Quat>("a.rotation", R"({"axis": "z", "pendulum": {"angle": 150, "length": 2}})");
  CHECK(swing.rate(0.4)[2] == doctest::Approx(exact.rate(0.4)).epsilon(1e-14));
  CHECK(2 * std::atan2(swing.value(0.4).z(), swing.value(0.4).w()) == doctest::Approx(exact.value(0.4)).epsilon(1e-14));
  const Curve<double> lean = curve_of<double>("a.lean", R"({"pendulum": {"angle": 150, "length": 2}})");
  CHECK(lean.value(0.4) == doctest::Approx(exact.value(0.4) / degree).epsilon(1e-14));
  CHECK(std::abs(lean.rate(0)) < 1e-12);
}

TEST_CASE("an orbit is back after its period, and a hyperbola needs the pull") {
  const Curve<Vec3> ellipse =
      curve_of<Vec3>("a.position",
                     R"({"orbit": {"center": [1, 0, 0], "periapsis": 1, "eccentricity": 0.5, "period": 4, "passage": 1,
          "rotation": {"axis": "x", "angle": 90}}})");
  CHECK(near(ellipse.value(1), Vec3(2, 0, 0), 1e-14));
  CHECK(near(ellipse.value(3), Vec3(-2, 0, 0), 1e-12));
  CHECK(near(ellipse.value(6.3), ellipse.value(2.3), 1e-12));
  CHECK(ellipse.value(1.5)[2] > 0.5);  // y of the plane is z of the world
  const Curve<Vec3> hyperbola =
      curve_of<Vec3>("a.way", R"({"orbit": {"periapsis": 1, "eccentricity": 3, "gravitational_parameter": 2}})");
  // At the periapsis v^2 = (1 + e) G M / r.
  CHECK(hyperbola.rate(0).norm() == doctest::Approx(std::sqrt(8.0)).epsilon(1e-14));
}

TEST_CASE("ways that end give the clip its duration, and go on as the track says") {
  const std::string points = R"("points": [[0, 0, 0], [4, 0, 0], [4, 4, 0]])";
  const Clip even = clip_of("a.position", R"({"path": {)" + points + R"(, "speed": "even", "duration": 3}})");
  CHECK(even.duration == 3);
  const Curve<Vec3>& path = std::get<Curve<Vec3>>(even.tracks[0].curve);
  CHECK(near(path.value(3), Vec3(4, 4, 0), 1e-14));
  CHECK(path.rate(0.2).norm() == doctest::Approx(path.rate(2.9).norm()).epsilon(1e-14));
  const Curve<Vec3> corners = curve_of<Vec3>(
      "a.position", R"({"after": "repeat", "path": {)" + points + R"(, "ease": "linear", "closed": true}})");
  CHECK(corners.rate(0.1).norm() == doctest::Approx(8 + std::sqrt(32.0)).epsilon(1e-14));
  CHECK(near(corners.value(2.1), corners.value(0.1), 1e-13));
  CHECK(clip_of("a.position", R"({"line": {"to": [1, 0, 0]}})").duration == 1);
  const Curve<Vec3> arc = curve_of<Vec3>(
      "a.position", R"({"after": "linear", "arc": {"from": [2, 0, 0], "axis": "y", "angle": 90, "duration": 2}})");
  CHECK(near(arc.value(2), Vec3(0, 0, -2), 1e-15));
  CHECK(near(arc.value(3), Vec3(-pi / 2, 0, -2), 1e-14));
  CHECK(std::isinf(clip_of("a.b", R"({"expression": "t"})").duration));
}

TEST_CASE("a fault in an expression is told at its column in the file") {
  const std::string text =
      "{\"tweenfall\": 1, \"clips\": {\"c\": {\"tracks\": {\n  \"a.b\": {\"expression\": \"1 + 2*cas(t)\"}}}}}";
  CHECK(faults_of(text, "wave.json", {}) ==
        "wave.json:2:32: error: unknown function \"cas\"; did you mean \"cos\"? (at /clips/c/tracks/a.b/expression)\n"
        " 2 |   \"a.b\": {\"expression\": \"1 + 2*cas(t)\"}}}}}\n   |                                ^\n");
}
