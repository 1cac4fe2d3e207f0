#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>

#include <array>
#include <stdexcept>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// Counter-clockwise about (x, y), in one second.
Curve<Vec2> circle(double x, double y, double radius) {
  const Curve<double> c = oscillator({.amplitude = radius, .center = x});
  const Curve<double> s = oscillator({.amplitude = radius, .phase = -pi / 2, .center = y});
  const Curve<Vec2> both = parametric(c, s);
  return Curve<Vec2>([both](double t, Side side) { return both.sample(t, side); }, 0, 1);
}

Curve<Vec2> polygon(const std::vector<Vec2>& corners, bool closed) {
  std::vector<Key<Vec2>> keys;
  for (std::size_t i = 0; i < corners.size() + (closed ? 1 : 0); ++i)
    keys.push_back({.time = static_cast<double>(i), .value = corners[i % corners.size()], .ease = Ease::linear()});
  return keyed_curve<Vec2>(keys);
}

Curve<Vec3> knot() {
  const auto part = [](const char* text) { return expression_curve(Expression(text)); };
  const Curve<Vec3> endless =
      parametric(part("(2+cos(3*t))*cos(2*t)"), part("(2+cos(3*t))*sin(2*t)"), part("sin(3*t)"));
  return Curve<Vec3>([endless](double t, Side side) { return endless.sample(t, side); }, 0, 2 * pi);
}

// Half a circle from the lower pole to the upper one.
Curve<Vec2> half_circle(double radius) {
  const Curve<Vec2> whole = circle(0, 0, radius).with_outside(Outside::repeat, Outside::repeat);
  return Curve<Vec2>(
      [whole](double t, Side side) {
        Sample<Vec2> s = whole.sample(t / 2 - 0.25, side);
        return Sample<Vec2>{s.value, Vec2(s.rate / 2), Vec2(s.acceleration / 4)};
      },
      0, 1);
}

// Normals are on the triangles' outer sides.
bool normals_agree(const SurfaceMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const auto a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
    const Vec3 across = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    for (const auto v : {a, b, c}) {
      if (std::abs(mesh.normals[v].norm() - 1) > 1e-12) return false;
      if (across.dot(mesh.normals[v]) < -1e-9 * across.norm()) return false;
    }
  }
  return mesh.normals.size() == mesh.positions.size() && mesh.texture_coordinates.size() == mesh.positions.size();
}

// Area and volume within 3/n^2 of the truth, and four times nearer with each doubling of the steps.
template <class Make>
void check_second_order(const Make& make, double area, double volume) {
  double area_before = 0, volume_before = 0;
  for (const int n : {16, 32, 64}) {
    CAPTURE(n);
    const SurfaceMesh mesh = make(n);
    CHECK(is_closed(mesh));
    CHECK(normals_agree(mesh));
    const MeshMeasures m = measure(mesh);
    const double area_fault = std::abs(m.area / area - 1), volume_fault = std::abs(m.volume / volume - 1);
    if (n > 16) {
      CHECK((area_fault < 1e-12 || area_before / area_fault == doctest::Approx(4).epsilon(0.05)));
      CHECK((volume_fault < 1e-12 || volume_before / volume_fault == doctest::Approx(4).epsilon(0.05)));
    }
    area_before = area_fault;
    volume_before = volume_fault;
  }
  CHECK(area_before < 30.0 / (64 * 64));
  CHECK(volume_before < 30.0 / (64 * 64));
}

}  // namespace

TEST_CASE("turned circles, lines and triangles are tori, cylinders, cones and balls, to the second order") {
  // Area and volume by Pappus: the path of the center times the profile's length and area.
  check_second_order([](int n) { return lathe(circle(3, 1, 0.8), {.segments = n, .profile_steps = n}); },
                     4 * pi * pi * 3 * 0.8, 2 * pi * pi * 3 * 0.8 * 0.8);
  check_second_order(
      [](int n) {
        return lathe(polygon({{2, -1}, {2, 2}}, false), {.segments = n});
      },
      2 * pi * 2 * 3 + 2 * pi * 4, pi * 4 * 3);
  check_second_order(
      [](int n) {
        return lathe(polygon({{2, 0}, {0, 3}}, false), {.segments = n});
      },
      pi * 2 * std::sqrt(13.0) + pi * 4, pi * 4 * 3 / 3);
  check_second_order([](int n) { return lathe(half_circle(1.5), {.segments = n, .profile_steps = n}); },
                     4 * pi * 1.5 * 1.5, 4.0 / 3 * pi * 1.5 * 1.5 * 1.5);
  check_second_order(
      [](int n) {
        return lathe(polygon({{1, 0}, {3, 0}, {2, 2}}, true), {.segments = n});
      },
      2 * pi * (2 * 2 + 2 * std::sqrt(5.0) * 2), 2 * pi * 2 * 2);
}

TEST_CASE("a part of a turn is closed by its cuts") {
  const double third = 2 * pi / 3;
  check_second_order(
      [=](int n) { return lathe(circle(3, 1, 0.8), {.segments = n, .profile_steps = n, .angle = third}); },
      third * 3 * 2 * pi * 0.8 + 2 * pi * 0.64, third * 3 * pi * 0.64);
  check_second_order(
      [=](int n) {
        return lathe(polygon({{2, -1}, {2, 2}}, false), {.segments = n, .angle = third});
      },
      third * 2 * 3 + third * 4 + 2 * 6, third * 2 * 3);
  check_second_order(
      [=](int n) { return lathe(half_circle(1.5), {.segments = n, .profile_steps = n, .angle = third}); },
      third * 2 * 2.25 + pi * 2.25, third * 2 / 3 * 1.5 * 1.5 * 1.5);
}

TEST_CASE("a profile may run either way: the surface is turned out") {
  for (const auto& corners : {std::vector<Vec2>{{2, -1}, {2, 2}}, std::vector<Vec2>{{2, 2}, {2, -1}}})
    CHECK(measure(lathe(polygon(corners, false))).volume > 0);
  for (const auto& corners : {std::vector<Vec2>{{1, 0}, {3, 0}, {2, 2}}, std::vector<Vec2>{{2, 2}, {3, 0}, {1, 0}}}) {
    CHECK(measure(lathe(polygon(corners, true))).volume > 0);
    const SurfaceMesh mesh = sweep(polygon(corners, true), line({.to = {0, 0, 4}}));
    CHECK(normals_agree(mesh));
    CHECK(measure(mesh).volume == doctest::Approx(8).epsilon(1e-14));
  }
}

TEST_CASE("swept circles are cylinders and tori, to the second order") {
  check_second_order(
      [](int n) {
        return sweep(circle(0, 0, 0.5), line({.from = {1, 2, 3}, .to = {4, 6, 3}}), {.profile_steps = n});
      },
      pi * 5 + 2 * pi * 0.25, pi * 0.25 * 5);
  check_second_order(
      [](int n) {
        return sweep(circle(0, 0, 0.5), arc({.from = {2, 0, 0}, .axis = {1, 1, 1}}),
                     {.rail_steps = n, .profile_steps = n});
      },
      4 * pi * pi * 0.5 * std::hypot(std::sqrt(8.0 / 3), 0.0), 2 * pi * pi * 0.25 * std::sqrt(8.0 / 3));
  // A helix: the volume is the profile's area times the length, for its center is on the rail (Pappus).
  const auto part = [](const char* text) { return expression_curve(Expression(text)); };
  const Curve<Vec3> helix = parametric(part("2*cos(t)"), part("2*sin(t)"), part("t/2"));
  const Curve<Vec3> rail([helix](double t, Side side) { return helix.sample(t, side); }, 0, 7);
  double before = 1;
  for (const int n : {32, 64, 128}) {
    const SurfaceMesh mesh = sweep(circle(0, 0, 0.4), rail, {.rail_steps = n, .profile_steps = n});
    CHECK(is_closed(mesh));
    CHECK(normals_agree(mesh));
    const double fault = std::abs(measure(mesh).volume / (pi * 0.16 * 7 * std::sqrt(4.25)) - 1);
    CHECK(fault < before / 3.5);
    before = fault;
  }
}

TEST_CASE("a plane rail does not twist what is swept along it") {
  std::vector<Vec3> points;
  for (const double x : {0.0, 1.0, 2.0, 4.0, 5.0}) points.push_back({x, std::sin(2 * x), 0});
  const Curve<Vec3> rail = even_path({.points = points, .duration = 1});
  const SurfaceMesh mesh =
      sweep(polygon({{-0.1, -0.2}, {0.1, -0.2}, {0.1, 0.2}, {-0.1, 0.2}}, true), rail, {.normal = Vec3(0, 0, 1)});
  for (const Vec3& p : mesh.positions) CHECK(std::abs(std::abs(p[2]) - 0.1) < 1e-12);
  CHECK(is_closed(mesh));
}

TEST_CASE("a closed rail gives a closed tube without lids, even where it is knotted") {
  const SurfaceMesh mesh =
      sweep(polygon({{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}, true), knot(), {.rail_steps = 200});
  CHECK(is_closed(mesh));
  CHECK(normals_agree(mesh));
  CHECK(mesh.positions.size() == 201 * 8);
  // One more ring would be another tube: with a hole, Euler's number is 0.
  const SurfaceMesh whole = welded(mesh);
  CHECK(whole.positions.size() * 2 == whole.triangles.size() / 3);
}

TEST_CASE("normals are exact, and stand double at edges only") {
  const SurfaceMesh ball = lathe(half_circle(2), {.segments = 12, .profile_steps = 8});
  for (std::size_t i = 0; i < ball.positions.size(); ++i)
    CHECK(near(ball.normals[i], Vec3(ball.positions[i] / 2), 1e-14));
  const SurfaceMesh torus = sweep(circle(0, 0, 0.5), arc({.from = {2, 0, 0}}), {.rail_steps = 10, .profile_steps = 6});
  for (std::size_t i = 0; i < torus.positions.size(); ++i) {
    const Vec3& p = torus.positions[i];
    const Vec3 middle = 2 * Vec3(p[0], p[1], 0) / std::hypot(p[0], p[1]);
    CHECK(near(torus.normals[i], Vec3((p - middle) / 0.5), 1e-12));
  }
  CHECK(torus.positions.size() == 11 * 7);
  for (std::size_t i = 0; i < torus.positions.size(); ++i) {
    CHECK(torus.texture_coordinates[i].minCoeff() >= 0);
    CHECK(torus.texture_coordinates[i].maxCoeff() <= 1);
  }
}

TEST_CASE("a twisted bar keeps its volume, and its normals lean with it") {
  const Curve<Vec2> bar = polygon({{-0.3, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {-0.3, 0.1}}, true);
  double before = 1;
  for (const int n : {32, 64, 128}) {
    const SurfaceMesh mesh = sweep(bar, line({.to = {0, 0, 3}}), {.rail_steps = n, .profile_steps = n, .twist = pi});
    CHECK(is_closed(mesh));
    const double fault = std::abs(measure(mesh).volume / (0.6 * 0.2 * 3) - 1);
    CHECK(fault < before / 3);
    before = fault;
    // A corner moves by the twist rate times its arm; the normal is perpendicular to that.
    const double rate = pi / 3;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (std::abs(std::abs(mesh.normals[i][2]) - 1) < 1e-9) continue;  // the lids
      const Vec3 along(-rate * mesh.positions[i][1], rate * mesh.positions[i][0], 1);
      CHECK(std::abs(along.dot(mesh.normals[i])) < 1e-12);
    }
  }
  CHECK(before < 1e-3);
}

TEST_CASE("center and inertia are those of the closed forms") {
  const MeshMeasures ball = measure(lathe(half_circle(1.5), {.segments = 200, .profile_steps = 200}));
  const double mass = ball.volume;
  CHECK(near(ball.center, Vec3(0, 0, 0), 1e-12));
  CHECK(near(ball.inertia, Mat3(0.4 * mass * 2.25 * Mat3::Identity()), 5e-4));
  // A cone's center is a quarter up; 3/10 m r^2 about its axis, 3/20 m r^2 + 3/80 m h^2 across.
  const MeshMeasures cone = measure(lathe(polygon({{2, 10}, {0, 13}}, false), {.segments = 400}));
  CHECK(near(cone.center, Vec3(0, 10.75, 0), 1e-12));
  CHECK(cone.inertia(1, 1) == doctest::Approx(0.3 * cone.volume * 4).epsilon(2e-4));
  CHECK(cone.inertia(0, 0) == doctest::Approx(cone.volume * (0.15 * 4 + 3.0 / 80 * 9)).epsilon(2e-4));
  // A box is exact: m (b^2 + c^2) / 12.
  const MeshMeasures box = measure(sweep(polygon({{-1, -2}, {1, -2}, {1, 2}, {-1, 2}}, true),
                                         line({.from = {5, 5, 5}, .to = {5, 5, 8}}), {.normal = Vec3(1, 0, 0)}));
  CHECK(box.volume == doctest::Approx(24).epsilon(1e-14));
  CHECK(box.area == doctest::Approx(52).epsilon(1e-14));
  CHECK(near(box.center, Vec3(5, 5, 6.5), 1e-14));
  CHECK(near(box.inertia, Mat3(Vec3(24.0 / 12 * (16 + 9), 24.0 / 12 * (4 + 9), 24.0 / 12 * 20).asDiagonal()), 1e-13));
}

TEST_CASE("lids fill profiles that are not convex") {
  const std::vector<Vec2> star = {{3, 0}, {1, 1}, {0, 3}, {-1, 1}, {-3, 0}, {-1, -1}, {0, -3}, {1, -1}};
  const SurfaceMesh mesh = sweep(polygon(star, true), line({.to = {0, 0, 1}}));
  CHECK(is_closed(mesh));
  CHECK(measure(mesh).volume == doctest::Approx(12).epsilon(1e-14));
  // A comb with straight runs of points.
  const std::vector<Vec2> comb = {{0, 0}, {1, 0}, {2, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                                  {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 1}};
  const SurfaceMesh teeth = sweep(polygon(comb, true), line({.to = {0, 0, 2}}));
  CHECK(is_closed(teeth));
  CHECK(measure(teeth).volume == doctest::Approx(2 * (5 + 3 * 2)).epsilon(1e-14));
  CHECK(normals_agree(teeth));
}

TEST_CASE("without lids, or with an open profile, the surface is open") {
  CHECK_FALSE(is_closed(sweep(circle(0, 0, 1), line({.to = {0, 0, 1}}), {.caps = false})));
  CHECK_FALSE(is_closed(sweep(polygon({{0, 0}, {1, 0}}, false), line({.to = {0, 0, 1}}))));
  CHECK_FALSE(is_closed(lathe(polygon({{2, -1}, {2, 2}}, false), {.caps = false})));
}

TEST_CASE("what cannot be swept or turned is refused with its numbers") {
  const Curve<Vec2> round = circle(0, 0, 1);
  const Curve<Vec3> rail = line({.to = {0, 0, 1}});
  CHECK_THROWS_WITH_AS((void)lathe(round), doctest::Contains("x >= 0"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)lathe(circle(2, 0, 1), {.segments = 2}), doctest::Contains("2"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)lathe(circle(2, 0, 1), {.angle = 7}), doctest::Contains("7"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)lathe(Curve<Vec2>({1, 1})), doctest::Contains("end"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sweep(round, Curve<Vec3>({1, 1, 1})), doctest::Contains("rail"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sweep(round, line({})), doctest::Contains("length"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sweep(round, rail, {.rail_steps = 0}), doctest::Contains("step"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sweep(round, rail, {.normal = Vec3(0, 0, 1)}), doctest::Contains("normal"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sweep(round, knot(), {.twist = 1}), doctest::Contains("whole turns"),
                       std::invalid_argument);
  CHECK(is_closed(sweep(circle(0, 0, 0.1), knot(), {.twist = 2 * pi})));
}
