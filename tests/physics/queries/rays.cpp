#include "physics/queries/solids.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

ConvexHull octahedron_hull() {
  return ConvexHull(std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
}

}  // namespace

TEST_CASE("a ray meets each solid where its closed form says") {
  const double r = std::sqrt(0.5);
  struct Case {
    Solid solid;
    Vec3 from, direction;
    double distance;
    Vec3 normal;
  };
  for (const Case& c :
       {Case{Sphere{1}, {-3, 0, 0}, {1, 0, 0}, 2, {-1, 0, 0}},
        Case{Sphere{1}, {-3, r, 0}, {2, 0, 0}, 3 - r, {-r, r, 0}},
        Case{Sphere{1}, {-3, 1, 0}, {1, 0, 0}, 3, {0, 1, 0}},
        Case{Box{{1, 2, 3}}, {5, 1, 2}, {-3, 0, 0}, 4, {1, 0, 0}},
        Case{Box{{1, 2, 3}}, {4, 4, 0}, {-1, -1, 0}, 3 / r, {1, 0, 0}},
        Case{Box{{1, 2, 3}}, {0, 0, -9}, {0, 0, 1e-200}, 6, {0, 0, -1}},
        Case{Box{{1, 2, 3}}, {0, 7, 2}, {0, -1e200, 0}, 5, {0, 1, 0}},
        Case{Capsule{0.5, 1}, {3, 0.9, 0}, {-1, 0, 0}, 2.5, {1, 0, 0}},
        Case{Capsule{0.5, 1}, {0, 9, 0}, {0, -1, 0}, 7.5, {0, 1, 0}},
        Case{Capsule{0.5, 1}, {3, 1 + 0.5 * r, 0}, {-1, 0, 0}, 3 - 0.5 * r, {r, r, 0}},
        Case{Capsule{0.5, 1}, {0, -9, 0.3}, {0, 1, 0}, 9 - 1.4, {0, -0.8, 0.6}},
        Case{Plane{{0, 1, 0}, 2}, {0, 5, 0}, {0, -4, 0}, 3, {0, 1, 0}},
        Case{Plane{{0, 1, 0}, 2}, {0, 5, 0}, {1, -1, 0}, 3 / r, {0, 1, 0}},
        Case{Cylinder{0.5, 1}, {3, 0.9, 0}, {-1, 0, 0}, 2.5, {1, 0, 0}},
        Case{Cylinder{0.5, 1}, {0.1, 9, 0.2}, {0, -1, 0}, 8, {0, 1, 0}},
        Case{Cylinder{0.5, 1}, {3, 2, 0}, {-1, -1, 0}, 2.5 / r, {1, 0, 0}},
        Case{Cone{1, 1}, {3, 0, 0}, {-1, 0, 0}, 2.5, Vec3(2, 1, 0) / std::sqrt(5.0)},
        Case{Cone{1, 1}, {0.25, 9, 0}, {0, -1, 0}, 8.5, Vec3(2, 1, 0) / std::sqrt(5.0)},
        Case{Cone{1, 1}, {0.25, -5, 0}, {0, 2, 0}, 4, {0, -1, 0}},
        Case{TaperedCapsule{0.5, 0.25, 1}, {0, 9, 0}, {0, -1, 0}, 7.75, {0, 1, 0}},
        Case{TaperedCapsule{0.5, 0.25, 1}, {3, -1, 0}, {-3, 0, 0}, 2.5, {1, 0, 0}},
        Case{TaperedCapsule{0.5, 0.25, 1},
             {3, 0, 0},
             {-1, 0, 0},
             3 - 3 / std::sqrt(63.0),
             Vec3(std::sqrt(63.0) / 8, 0.125, 0)},
        Case{Hull{octahedron_hull()}, {3, 0.25, 0.25}, {-1, 0, 0}, 2.5, Vec3(1, 1, 1) / std::sqrt(3.0)}}) {
    CAPTURE(c.solid.index());
    CAPTURE(c.from.x());
    CAPTURE(c.from.y());
    const std::optional<RayHit> hit = cast_ray({c.solid}, {}, c.from, c.direction);
    REQUIRE(hit.has_value());
    CHECK(!hit->inside);
    CHECK(hit->distance == doctest::Approx(c.distance).epsilon(1e-14));
    CHECK(near(hit->point, c.from + c.distance * c.direction.stableNormalized(), 1e-13));
    CHECK(near(hit->normal, c.normal, 1e-7));
    CHECK(hit->normal.norm() == doctest::Approx(1).epsilon(1e-14));
    // Its length is enough, or not; the same ray moved elsewhere.
    CHECK(cast_ray({c.solid}, {}, c.from, c.direction, hit->distance).has_value());
    CHECK(!cast_ray({c.solid}, {}, c.from, c.direction, std::nextafter(hit->distance, 0.0)).has_value());
    CHECK(!cast_ray({c.solid}, {}, c.from, -c.direction).has_value());
    Random random(7);
    for (int i = 0; i < 20; ++i) {
      const Pose pose = any_pose(random, 10), offset = any_pose(random, 10);
      const Quat turn = pose.rotation * offset.rotation;
      const Vec3 from = pose.position + pose.rotation * (offset.position + offset.rotation * c.from);
      // A ray that only grazes may as well miss.
      const std::optional<RayHit> moved =
          cast_ray({c.solid, offset}, pose, from, turn * (c.direction / c.direction.cwiseAbs().maxCoeff()));
      if (!moved) {
        CHECK(std::abs(c.normal.dot(c.direction)) < 1e-6);
        continue;
      }
      CHECK(moved->distance == doctest::Approx(c.distance).epsilon(1e-7));
      CHECK(near(moved->normal, turn * hit->normal, 1e-6));
    }
  }
}

TEST_CASE("a ray that starts in a solid hits it at once, and one that starts on its surface has no way to go") {
  for (const Solid& solid : {Solid{Sphere{1}}, Solid{Box{{1, 1, 1}}}, Solid{Capsule{1, 0.5}},
                             Solid{Plane{{1, 0, 0}, 1}}, Solid{Hull{octahedron_hull()}}, Solid{Cylinder{1, 2}}}) {
    CAPTURE(solid.index());
    const Vec3 direction(3, 4, 0);
    const std::optional<RayHit> hit = cast_ray({solid}, {}, Vec3(0.1, 0.2, 0.1), direction, 0);
    REQUIRE(hit.has_value());
    CHECK(hit->inside);
    CHECK(hit->distance == 0);
    CHECK(hit->point == Vec3(0.1, 0.2, 0.1));
    CHECK(near(hit->normal, Vec3(-0.6, -0.8, 0), 1e-15));
    // On the surface, whichever way it goes.
    for (const double way : {1.0, -1.0}) {
      const std::optional<RayHit> touching = cast_ray({solid}, {}, Vec3(1, 0, 0), Vec3(way, 0, 0));
      REQUIRE(touching.has_value());
      CHECK(touching->distance == 0);
    }
    // One ulp outside it is still hit, or left.
    CHECK(!cast_ray({solid}, {}, Vec3(1 + 4e-16, 0, 0), Vec3(1, 0, 0)).has_value());
    const std::optional<RayHit> outside = cast_ray({solid}, {}, Vec3(1 + 4e-16, 0, 0), Vec3(-1, 0, 0));
    REQUIRE(outside.has_value());
    CHECK(!outside->inside);
    CHECK(outside->distance < 1e-15);
    CHECK(near(outside->normal, Vec3(1, 0, 0), solid.index() == 4 ? 1 : 1e-12));
  }
}

TEST_CASE("a ball is hit to a millionth of a millionth of the distance from a million times its size away") {
  for (const double far : {1e3, 1e6, 1e9}) {
    const std::optional<RayHit> hit = cast_ray({Sphere{1}}, {}, Vec3(-far, 0.6, 0), Vec3(1, 0, 0));
    REQUIRE(hit.has_value());
    CHECK(std::abs(hit->distance - (far - 0.8)) <= 2e-16 * far);
    const std::optional<RayHit> rod = cast_ray({Capsule{1, 5}}, {}, Vec3(-far, 0, 0.6), Vec3(1, 0, 0));
    REQUIRE(rod.has_value());
    CHECK(std::abs(rod->distance - (far - 0.8)) <= 2e-16 * far);
  }
}

TEST_CASE("a ray along a face, an edge or a side belongs to the solid, and beside it to nothing") {
  CHECK(cast_ray({Box{{1, 1, 1}}}, {}, Vec3(-3, 1, 0), Vec3(1, 0, 0)).has_value());
  CHECK(cast_ray({Box{{1, 1, 1}}}, {}, Vec3(-3, 1, -1), Vec3(1, 0, 0)).has_value());
  CHECK(!cast_ray({Box{{1, 1, 1}}}, {}, Vec3(-3, std::nextafter(1, 2), 0), Vec3(1, 0, 0)).has_value());
  CHECK(cast_ray({Capsule{1, 2}}, {}, Vec3(1, 9, 0), Vec3(0, -1, 0)).has_value());
  CHECK(!cast_ray({Capsule{1, 2}}, {}, Vec3(1 + 1e-12, 9, 0), Vec3(0, -1, 0)).has_value());
  // From beyond an end, between the prolonged sides, away.
  CHECK(!cast_ray({Capsule{1, 2}}, {}, Vec3(-0.5, 4, 0), Vec3(1, 1, 0)).has_value());
  CHECK(!cast_ray({Capsule{1, 2}}, {}, Vec3(-0.9, 3.1, 0), Vec3(1, 0.2, 0)).has_value());
  CHECK(!cast_ray({Plane{}}, {}, Vec3(0, 1e-9, 0), Vec3(1, 0, 0)).has_value());
  CHECK(cast_ray({Plane{}}, {}, Vec3(0, 0, 0), Vec3(1, 0, 0)).has_value());
}

TEST_CASE("what is no ray is refused") {
  const Shape ball{Sphere{1}};
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)cast_ray(ball, {}, Vec3(0, 0, 0), Vec3(0, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {}, Vec3(0, none, 0), Vec3(1, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {}, Vec3(without_end, 0, 0), Vec3(1, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {}, Vec3(0, 0, 0), Vec3(without_end, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {}, Vec3(0, 0, 0), Vec3(1, 0, 0), -1), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {}, Vec3(0, 0, 0), Vec3(1, 0, 0), none), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {.position = Vec3(none, 0, 0)}, Vec3(0, 0, 0), Vec3(1, 0, 0)),
                  std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray(ball, {.rotation = Quat(0, 0, 0, 0)}, Vec3(0, 0, 0), Vec3(1, 0, 0)),
                  std::invalid_argument);
}

TEST_CASE("a ray meets what is turned about an axis where one through its outline's corners would") {
  // With the most sides possible, from inside and from outside.
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    const double size = std::pow(10, random.between(-4, 4));
    const double bottom = size * random.between(0.2, 1), top = i % 3 == 0 ? bottom : i % 3 == 1 ? 0 : 0.5 * bottom;
    const double half = size * random.between(0.6, 1), lean = i % 3 == 2 ? (bottom - top) / (2 * half) : 0;
    const double upright = std::sqrt(1 - lean * lean);
    const Solid solid = i % 3 == 0   ? Solid{Cylinder{bottom, half}}
                        : i % 3 == 1 ? Solid{Cone{bottom, half}}
                                     : Solid{TaperedCapsule{bottom, top, half}};
    constexpr int sides = 64;
    std::vector<Vec3> inner, outer;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * pi * k / sides;
      const Vec3 around(std::cos(angle), 0, std::sin(angle));
      for (const double end : {-1.0, 1.0}) {
        const double radius = upright * (end < 0 ? bottom : top), height = end * half + lean * (end < 0 ? bottom : top);
        if (radius == 0 && k > 0) continue;
        inner.push_back(radius * around + Vec3(0, height, 0));
        outer.push_back(radius / std::cos(pi / sides) * around + Vec3(0, height, 0));
      }
    }
    const Shape within{Hull{ConvexHull(inner)}}, around{Hull{ConvexHull(outer)}};
    for (int k = 0; k < 20; ++k) {
      const Vec3 from = random.vector(4 * size), direction = random.vector(0.7 * size) - from;
      const auto hit = cast_ray({solid}, {}, from, direction), inner_hit = cast_ray(within, {}, from, direction),
                 outer_hit = cast_ray(around, {}, from, direction);
      CAPTURE(i);
      CAPTURE(k);
      if (inner_hit) {
        REQUIRE(hit.has_value());
        CHECK(hit->distance <= inner_hit->distance + 1e-12 * size);
      }
      if (i % 3 == 2) continue;
      CHECK(outer_hit.has_value() >= hit.has_value());
      if (hit && outer_hit) CHECK(hit->distance >= outer_hit->distance - 1e-12 * size);
    }
  }
}

TEST_CASE("along every ray nothing of a solid comes before the hit, and the hit is on its surface") {
  Random random(21);
  double worst = 0;
  int hits = 0, misses = 0;
  const int count = cases(1000);
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10, random.between(-2, 2));
    const Shape shape = any_shape(random, size);
    const Pose pose = any_pose(random, 3 * size);
    const Vec3 from = pose.position + random.vector(4 * size);
    const Vec3 toward = pose.position + random.vector(size) - from;
    const std::optional<RayHit> hit = cast_ray(shape, pose, from, toward);
    const double start = height_over(shape, pose, from);
    if (hit && hit->inside) {
      CHECK(start <= 1e-12 * size);
      continue;
    }
    CHECK(start >= -1e-12 * size);
    const Vec3 direction = toward.normalized();
    const double length = hit ? hit->distance : 12 * size;
    // A height is a lower bound of the distance, so it is safe to go on.
    double along = 0, least = start;
    for (int k = 0; k < 400 && along < length; ++k) {
      const double height = height_over(shape, pose, from + along * direction);
      least = std::min(least, height);
      along += std::max(height, 1e-3 * size);
    }
    if (!hit) {
      ++misses;
      CHECK(least >= -1e-9 * size);
      continue;
    }
    ++hits;
    CHECK(hit->distance > 0);
    CHECK(least >= -2e-3 * size);
    for (const double share : {0.5, 0.9, 0.999, 0.999999})
      CHECK(height_over(shape, pose, from + share * hit->distance * direction) >= -1e-12 * size);
    const double off = std::abs(height_over(shape, pose, hit->point)) / size;
    worst = std::max(worst, off);
    CHECK(off < 1e-11);
    CHECK(hit->normal.dot(direction) <= 1e-9);
    CHECK(height_over(shape, pose, hit->point + 1e-4 * size * hit->normal) > 0);
  }
  MESSAGE(count << " rays, " << hits << " hits: at worst " << worst << " of the size off the surface");
  CHECK(hits > 0.2 * count);
  CHECK(misses > 0.1 * count);
}
