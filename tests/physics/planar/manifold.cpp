#include <tweenfall/physics/planar_shape.h>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Convex: random points on an ellipse, in order.
planar::Polygon random_polygon(Random& random, int corners) {
  std::vector<double> angles;
  for (int i = 0; i < corners; ++i) angles.push_back(2 * pi * (i + 0.8 * random.between(0, 1)) / corners);
  const double wide = random.between(0.2, 1), high = random.between(0.2, 1);
  planar::Polygon polygon;
  for (const double angle : angles) polygon.corners.emplace_back(wide * std::cos(angle), high * std::sin(angle));
  return polygon;
}

std::vector<Vec2> placed(const planar::Polygon& polygon, const planar::Place& place) {
  std::vector<Vec2> all;
  const double c = std::cos(place.angle), s = std::sin(place.angle);
  for (const Vec2& p : polygon.corners)
    all.push_back(place.position + Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  return all;
}

double point_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double part = std::clamp((b - a).dot(p - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + part * (b - a) - p).norm();
}

/// From all corners and all sides; if they overlap, the negative depth along the best of all sides' normals.
double brute_distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double best = -1e300, nearest = 1e300;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (std::size_t i = 0; i < one->size(); ++i) {
      const Vec2 from = (*one)[i], to = (*one)[(i + 1) % one->size()];
      const Vec2 normal = Vec2(to.y() - from.y(), from.x() - to.x()).normalized();
      double least = 1e300;
      for (const Vec2& p : *other) {
        least = std::min(least, normal.dot(p - from));
        nearest = std::min(nearest, point_to_segment(p, from, to));
      }
      best = std::max(best, least);
    }
  return best > 0 ? nearest : best;
}

/// A circle, a capsule or a polygon as corners with a round skin.
struct Skinned {
  planar::Shape shape;
  std::vector<Vec2> corners;
  double skin = 0;
};

Skinned random_outline(Random& random, std::size_t kind) {
  if (kind == 0) {
    const double radius = random.between(0.05, 1);
    return {{planar::Circle{radius}}, {Vec2(0, 0)}, radius};
  }
  if (kind == 1) {
    const double radius = random.between(0.02, 0.5), half = random.between(0.01, 1);
    return {{planar::Capsule{radius, half}}, {Vec2(0, -half), Vec2(0, half)}, radius};
  }
  if (kind == 2) {
    const Vec2 half(random.between(0.05, 1), random.between(0.05, 1));
    return {{planar::Box{half}}, {half, Vec2(-half.x(), half.y()), -half, Vec2(half.x(), -half.y())}};
  }
  const planar::Polygon polygon = random_polygon(random, 3 + static_cast<int>(random.bits() % 6));
  return {{polygon}, polygon.corners};
}

/// Of two of them. What has no area is a polygon of two corners, seen from both sides.
double brute_gap(const Skinned& a, const planar::Place& at_a, const Skinned& b, const planar::Place& at_b) {
  std::vector<Vec2> corners_a = placed({a.corners}, at_a), corners_b = placed({b.corners}, at_b);
  double nearest = 1e300, best = -1e300;
  for (const auto& [one, other] : {std::pair(&corners_a, &corners_b), std::pair(&corners_b, &corners_a)})
    for (std::size_t i = 0; i < one->size(); ++i) {
      const Vec2 from = (*one)[i], to = (*one)[(i + 1) % one->size()], along = to - from;
      double least = 1e300;
      const Vec2 normal = along.norm() > 0 ? Vec2(Vec2(along.y(), -along.x()).normalized()) : Vec2(0, 0);
      for (const Vec2& p : *other) {
        least = std::min(least, normal.dot(p - from));
        nearest = std::min(nearest, along.norm() > 0 ? point_to_segment(p, from, to) : (p - from).norm());
      }
      if (along.norm() > 0) best = std::max(best, least);
    }
  // Two lines without area on one line overlap nowhere beside each other; two points never do.
  const bool apart = best > 0 || best == -1e300 || (best > -1e-9 && nearest > 1e-9);
  return (apart ? nearest : best) - a.skin - b.skin;
}

}  // namespace

TEST_CASE("in a plane every pair of outlines is as far apart or as deep as by brute force, in 100,000 random places") {
  Random random(12);
  double worst = 0, worst_normal = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Skinned a = random_outline(random, random.bits() % 4), b = random_outline(random, random.bits() % 4);
    const planar::Place at_a{Vec2(0, 0), random.between(-7, 7)};
    planar::Place at_b{Vec2(0, 0), i % 4 == 0 ? at_a.angle + random.between(-1e-4, 1e-4) : random.between(-7, 7)};
    // Along a line to where they touch, nearly, or lie in each other.
    const double way = random.between(-4, 4),
                 wanted = i % 2 == 0 ? random.between(-0.3, 0.02) : random.between(0, 0.02);
    double near_by = 0, far = 6;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (near_by + far);
      at_b.position = middle * Vec2(std::cos(way), std::sin(way));
      (brute_gap(a, at_a, b, at_b) < wanted ? near_by : far) = middle;
    }
    if (brute_gap(a, at_a, b, at_b) > 0.09) continue;
    const auto gap_of = [](const planar::Manifold& manifold) {
      double gap = -manifold.points[0].penetration;
      return manifold.count == 2 ? std::min(gap, -manifold.points[1].penetration) : gap;
    };
    const planar::Manifold manifold = planar::collide(a.shape, at_a, b.shape, at_b, 0.1);
    REQUIRE(manifold.count > 0);
    const double gap = gap_of(manifold);
    worst = std::max(worst, std::abs(gap - brute_gap(a, at_a, b, at_b)));
    // So much along the normal, and they just touch.
    at_b.position -= gap * manifold.normal;
    worst_normal = std::max(worst_normal, std::abs(brute_gap(a, at_a, b, at_b)));
  }
  CHECK(worst < 1e-13);
  CHECK(worst_normal < 1e-7);
}

TEST_CASE("in a plane the gap of two polygons is that of all corners and sides") {
  Random random(11);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 4000; ++i) {
    const planar::Polygon a = random_polygon(random, 3 + i % 6), b = random_polygon(random, 3 + i / 6 % 6);
    const planar::Place at_a{Vec2(0, 0), random.between(-7, 7)};
    const planar::Place at_b{Vec2(random.between(-2, 2), random.between(-2, 2)), random.between(-7, 7)};
    const double expected = brute_distance(placed(a, at_a), placed(b, at_b));
    const planar::Manifold manifold = planar::collide({a}, at_a, {b}, at_b, 10);
    REQUIRE(manifold.count > 0);
    double gap = -manifold.points[0].penetration;
    if (manifold.count == 2) gap = std::min(gap, -manifold.points[1].penetration);
    CAPTURE(i);
    CHECK(std::abs(gap - expected) < 1e-13);
    CHECK(std::abs(manifold.normal.norm() - 1) < 1e-12);
    // Swapped, it is the same contact.
    const planar::Manifold back = planar::collide({b}, at_b, {a}, at_a, 10);
    double other_gap = -back.points[0].penetration;
    if (back.count == 2) other_gap = std::min(other_gap, -back.points[1].penetration);
    CHECK(std::abs(other_gap - gap) < 2e-4);
    (expected > 0 ? apart : overlapping) += 1;
  }
  CHECK(apart > 500);
  CHECK(overlapping > 500);
}

TEST_CASE("in a plane round skins are as far apart as their cores less the radii") {
  const planar::Place origin{};
  const auto gap = [&](const planar::Outline& a, const planar::Outline& b, const Vec2& at, double angle = 0) {
    const planar::Manifold manifold = planar::collide({a}, origin, {b}, {at, angle}, 10);
    REQUIRE(manifold.count > 0);
    return -manifold.points[0].penetration;
  };
  CHECK(near(gap(planar::Circle{0.5}, planar::Circle{0.25}, Vec2(3, 4)), 4.25, 1e-15));
  CHECK(near(gap(planar::Box{}, planar::Circle{0.25}, Vec2(0.2, 2)), 1.25, 1e-15));
  CHECK(near(gap(planar::Box{}, planar::Circle{0.25}, Vec2(3.5, 4.5)), 4.75, 1e-15));
  CHECK(near(gap(planar::Capsule{0.25, 1}, planar::Circle{0.25}, Vec2(0, 3)), 1.5, 1e-15));
  CHECK(near(gap(planar::Capsule{0.25, 1}, planar::Capsule{0.25, 1}, Vec2(2, 0)), 1.5, 1e-15));
  CHECK(near(gap(planar::Box{}, planar::Capsule{0.25, 1}, Vec2(0, 2), pi / 2), 1.25, 1e-15));
  CHECK(near(gap(planar::HalfPlane{}, planar::Box{}, Vec2(7, 2)), 1.5, 1e-15));
  CHECK(near(gap(planar::HalfPlane{Vec2(0, 3), -1}, planar::Circle{}, Vec2(7, 2)), 2.5, 1e-15));
  CHECK(planar::collide({planar::Box{}}, origin, {planar::Box{}}, {Vec2(1.2, 0)}, 0.1).count == 0);
}

TEST_CASE("in a plane masses and moments are those of the closed forms") {
  CHECK(near(planar::mass_properties({planar::Circle{2}}, 3).moment, 6.0, 1e-15));
  CHECK(near(planar::mass_properties({planar::Box{Vec2(1, 2)}}, 3).moment, 5.0, 1e-15));
  CHECK(near(planar::area(planar::Capsule{1, 2}), 8 + pi, 1e-15));
  // Of a right triangle with legs b and h: m (b^2 + h^2) / 18 about its center of mass.
  const planar::MassProperties triangle =
      planar::mass_properties({planar::Polygon{{Vec2(1, 1), Vec2(4, 1), Vec2(1, 5)}}}, 2);
  CHECK(near(triangle.center, Vec2(2, 7.0 / 3), 1e-15));
  CHECK(near(triangle.moment, 2 * 25.0 / 18, 1e-14));
  // A capsule from a box and two half circles, by sums over small squares.
  const planar::Capsule capsule{0.5, 1};
  double area = 0, second = 0;
  const int cells = 400;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < 3 * cells; ++k) {
      const Vec2 p((i + 0.5) / cells - 0.5, 3 * (k + 0.5) / (3 * cells) - 1.5);
      if (point_to_segment(p, Vec2(0, -1), Vec2(0, 1)) > 0.5) continue;
      area += 1;
      second += p.squaredNorm();
    }
  CHECK(near(planar::mass_properties({capsule}, 1).moment, second / area, 1e-3));
}

TEST_CASE("in a plane shapes that cannot be are refused in words") {
  using doctest::Contains;
  const auto check = [](const planar::Outline& outline, const char* words) {
    CHECK_THROWS_WITH_AS(planar::validate({outline}), Contains(words), std::invalid_argument);
  };
  check(planar::Circle{0}, "radius of a circle must be positive");
  check(planar::Circle{NAN}, "radius of a circle must be positive");
  check(planar::Box{Vec2(1, -1)}, "half height of a box must be positive");
  check(planar::Polygon{{Vec2(0, 0), Vec2(1, 0)}}, "3 to 64 corners, but this one has 2");
  check(planar::Polygon{{Vec2(0, 0), Vec2(1, 0), Vec2(2, 0)}}, "lie on one line");
  check(planar::Polygon{{Vec2(0, 0), Vec2(2, 0), Vec2(0.5, 0.5), Vec2(0, 2)}}, "not convex at corner 2");
  check(planar::Polygon{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 0), Vec2(0, 1)}}, "one and the same");
  std::vector<Vec2> star;
  for (int i = 0; i < 5; ++i) star.emplace_back(std::cos(4 * pi * i / 5), std::sin(4 * pi * i / 5));
  check(planar::Polygon{star}, "go round more than once");
  check(planar::HalfPlane{Vec2(0, 0)}, "longer than 0");
  // Clockwise is fine, too.
  CHECK_NOTHROW(planar::validate({planar::Polygon{{Vec2(0, 1), Vec2(1, 0), Vec2(0, 0)}}}));
}
