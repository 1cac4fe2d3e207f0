#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/frames.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include <stdexcept>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Curve<Vec3> curve_of(const char* x, const char* y, const char* z) {
  return parametric(expression_curve(Expression(x)), expression_curve(Expression(y)), expression_curve(Expression(z)));
}

std::vector<double> times(double from, double to, int steps) {
  std::vector<double> result;
  for (int i = 0; i <= steps; ++i) result.push_back(from + (to - from) * i / steps);
  return result;
}

bool is_orthonormal(const Frame& f) {
  return std::abs(f.tangent.norm() - 1) < 1e-14 && std::abs(f.normal.norm() - 1) < 1e-14 &&
         std::abs(f.tangent.dot(f.normal)) < 1e-14 && (f.tangent.cross(f.normal) - f.binormal).norm() < 1e-15;
}

}  // namespace

TEST_CASE("a helix has the curvature and the Frenet frame of the closed form") {
  const double a = 2, b = 0.5;
  const Curve<Vec3> helix = curve_of("2*cos(t)", "2*sin(t)", "0.5*t");
  for (const double t : {0.0, 1.3, -4.0}) {
    CHECK(curvature(helix.sample(t)) == doctest::Approx(a / (a * a + b * b)).epsilon(1e-14));
    const auto frame = frenet_frame(helix, t);
    REQUIRE(frame.has_value());
    CHECK(near(frame->normal, Vec3(-std::cos(t), -std::sin(t), 0), 1e-14));
    CHECK(near(frame->binormal, Vec3(Vec3(b * std::sin(t), -b * std::cos(t), a) / std::hypot(a, b)), 1e-14));
    CHECK(is_orthonormal(*frame));
  }
  CHECK_FALSE(frenet_frame(line({.from = {0, 0, 0}, .to = {1, 2, 3}}), 0.5).has_value());
  CHECK_FALSE(frenet_frame(Curve<Vec3>({1, 2, 3}), 0.5).has_value());
}

// A frame that does not turn about its tangent turns back against Frenet's by the torsion, b / (a^2 + b^2) per meter.
TEST_CASE("a rotation-minimizing frame falls behind Frenet's by the torsion, to the fourth order") {
  const double a = 2, b = 1.5, torsion = b / (a * a + b * b), length = 6 * std::hypot(a, b);
  const Curve<Vec3> helix = curve_of("2*cos(t)", "2*sin(t)", "1.5*t");
  double before = 0;
  for (const int steps : {8, 16, 32}) {
    const std::vector<Frame> frames =
        rotation_minimizing_frames(helix, times(0, 6, steps), {.normal = frenet_frame(helix, 0)->normal});
    for (const Frame& f : frames) CHECK(is_orthonormal(f));
    const Frame frenet = *frenet_frame(helix, 6);
    const double angle = std::atan2(frames.back().normal.dot(frenet.binormal), frames.back().normal.dot(frenet.normal));
    const double fault = std::abs(std::remainder(angle + torsion * length, 2 * pi));
    if (before > 0) CHECK(fault < before / 12);
    before = fault;
  }
  CHECK(before < 1e-6);
}

TEST_CASE("on a plane curve the frame's binormal never moves, whatever the plane") {
  Random random(4);
  const Quat plane = random.rotation();
  std::vector<Key<Vec3>> keys;
  for (int i = 0; i < 8; ++i)
    keys.push_back({.time = i * 1.0,
                    .value = plane * Vec3(random.between(-3, 3), random.between(-3, 3), 0),
                    .ease = Ease::natural()});
  const Curve<Vec3> rail = keyed_curve<Vec3>(keys);
  const Vec3 up = plane * Vec3(0, 0, 1);
  for (const Frame& f : rotation_minimizing_frames(rail, times(0, 7, 200), {.normal = up})) {
    CHECK(near(f.normal, up, 1e-12));
    CHECK(is_orthonormal(f));
  }
}

TEST_CASE("on a closed curve the last frame is the first, and the missing turn is spread evenly") {
  // A knot: three twists around a ring.
  const Curve<Vec3> knot = curve_of("(2+cos(3*t))*cos(2*t)", "(2+cos(3*t))*sin(2*t)", "sin(3*t)");
  const std::vector<double> at = times(0, 2 * pi, 240);
  const std::vector<Frame> open = rotation_minimizing_frames(knot, at),
                           closed = rotation_minimizing_frames(knot, at, {.closed = true});
  CHECK((open.back().normal - open.front().normal).norm() > 0.1);
  CHECK(near(closed.back().normal, closed.front().normal, 1e-12));
  CHECK(near(closed.back().tangent, closed.front().tangent, 1e-14));
  const auto angle = [&](std::size_t i) {
    return std::atan2(closed[i].normal.dot(open[i].binormal), closed[i].normal.dot(open[i].normal));
  };
  // By symmetry a third of the knot is a third of the way.
  CHECK(std::abs(std::remainder(angle(80) * 3 - angle(240), 2 * pi)) < 1e-6);
}

TEST_CASE("twist turns the last frame by its angle and the middle by half of it") {
  const Curve<Vec3> rail = line({.from = {0, 0, 0}, .to = {0, 0, 5}});
  const std::vector<Frame> f =
      rotation_minimizing_frames(rail, times(0, 1, 4), {.normal = Vec3(1, 0, 7), .twist = pi / 2});
  CHECK(near(f[0].normal, Vec3(1, 0, 0), 1e-15));
  CHECK(near(f[2].normal, Vec3(std::sqrt(0.5), std::sqrt(0.5), 0), 1e-15));
  CHECK(near(f[4].normal, Vec3(0, 1, 0), 1e-15));
}

TEST_CASE("a curve that rests has the tangent of the way it sets out on, or has come") {
  const Curve<Vec3> eased = keyed_curve<Vec3>({{0, {0, 0, 0}, Ease::named("cubic-in-out").value()}, {1, {0, 3, 0}}});
  for (const Frame& f : rotation_minimizing_frames(eased, times(0, 1, 4))) CHECK(near(f.tangent, Vec3(0, 1, 0), 1e-12));
  const Curve<Vec3> still({1, 2, 3});
  CHECK(is_orthonormal(rotation_minimizing_frames(still, times(0, 1, 2)).back()));
}

TEST_CASE("faulty times and normals are refused with their numbers") {
  const Curve<Vec3> rail = line({.to = {1, 0, 0}});
  CHECK_THROWS_AS((void)rotation_minimizing_frames(rail, {}), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)rotation_minimizing_frames(rail, std::vector<double>{0, 1, 1}),
                       doctest::Contains("time 2"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)rotation_minimizing_frames(rail, std::vector<double>{0, 1}, {.normal = Vec3(2, 0, 0)}),
                       doctest::Contains("along the curve"), std::invalid_argument);
}
