#include "physics/queries/solids.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("a shape on its way meets another where the closed form says") {
  const auto at = [](double x, double y, double z) { return Pose{.position = Vec3(x, y, z)}; };
  struct Case {
    Shape moving;
    Pose start;
    Vec3 way;
    Shape shape;
    double fraction;
    Vec3 point, normal;
  };
  for (const Case& c : {
           Case{{Sphere{1}}, at(-5, 0, 0), {10, 0, 0}, {Sphere{1}}, 0.3, {-1, 0, 0}, {-1, 0, 0}},
           Case{{Sphere{1}},
                at(-5, 1, 0),
                {10, 0, 0},
                {Sphere{1}},
                (5 - std::sqrt(3.0)) / 10,
                {-std::sqrt(0.75), 0.5, 0},
                {-std::sqrt(0.75), 0.5, 0}},
           Case{{Box{{1, 1, 1}}}, at(0, 8, 0), {0, -8, 0}, {Plane{{0, 1, 0}, 2}}, 5.0 / 8, {1, 2, 1}, {0, 1, 0}},
           Case{{Plane{{0, -1, 0}, -8}}, {}, {0, -8, 0}, {Sphere{1}}, 7.0 / 8, {0, 1, 0}, {0, 1, 0}},
           Case{{Capsule{0.5, 1}}, at(3, 0, 0), {-1, 0, 0}, {Box{{1.75, 5, 5}}}, 0.75, {1.75, 0, 0}, {1, 0, 0}},
           Case{{Box{{1, 1, 1}}}, at(-4, -4, 0.25), {4, 4, 0}, {Box{{1, 1, 1}}}, 0.5, {-1, -1, 0}, {-1, 0, 0}},
       }) {
    CAPTURE(c.moving.solid.index());
    CAPTURE(c.shape.solid.index());
    const std::optional<ShapeHit> hit = cast_shape(c.moving, c.start, c.way, c.shape, {});
    REQUIRE(hit.has_value());
    CHECK(!hit->inside);
    CHECK(hit->fraction == doctest::Approx(c.fraction).epsilon(1e-13));
    if (c.shape.solid.index() != 1 && c.moving.solid.index() != 1) CHECK(near(hit->point, c.point, 1e-9));
    const bool corner = c.moving.solid.index() == 1 && c.shape.solid.index() == 1;
    if (!corner) CHECK(near(hit->normal, c.normal, 1e-7));
    CHECK(hit->normal.dot(c.way) < 0);
    CHECK(!cast_shape(c.moving, c.start, 0.999999999 * c.fraction * c.way, c.shape, {}).has_value());
    CHECK(!cast_shape(c.moving, c.start, -c.way, c.shape, {}).has_value());
  }
}

TEST_CASE("a ball on its way is a ray against a ball as much larger, and a box a ray against a larger box") {
  Random random(52);
  double worst = 0;
  int hits = 0;
  for (int i = 0; i < cases(1000); ++i) {
    const bool balls = i % 2 == 0;
    const Vec3 half(random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1));
    const Vec3 other(random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1));
    const auto solid = [balls](const Vec3& size) -> Solid {
      if (balls) return Sphere{size.x()};
      return Box{size};
    };
    const Solid moving = solid(half), shape = solid(other), larger = solid(half + other);
    const Vec3 from = random.vector(3), way = random.vector(9);
    const std::optional<RayHit> ray = cast_ray({larger}, {}, from, way, way.norm());
    const std::optional<ShapeHit> hit = cast_shape({moving}, {.position = from}, way, {shape}, {});
    REQUIRE(hit.has_value() == ray.has_value());
    if (!hit) continue;
    ++hits;
    CHECK(hit->inside == ray->inside);
    const double off = std::abs(hit->fraction * way.norm() - ray->distance);
    worst = std::max(worst, off);
    CHECK(off < 1e-9);
    if (balls && !ray->inside) CHECK(near(hit->normal, ray->normal, 1e-5));
  }
  MESSAGE(hits << " hits, at worst " << worst << " m off");
  CHECK(hits > 50);
}

TEST_CASE("whatever moves is free until it is hit, and touches there; what hits nothing is free all the way") {
  Random random(53);
  double worst = 0, worst_touch = 0;
  int hits = 0, stuck = 0, misses = 0;
  const int count = cases(1000);
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    const double size = std::pow(10, random.between(-2, 2));
    const Shape a = any_shape(random, size);
    const Shape b = i % 20 == 0 ? Shape{Plane{random.rotation() * Vec3(0, 1, 0), size * random.between(-1, 1)}}
                                : any_shape(random, size * std::pow(10, random.between(-1, 0.5)));
    const Pose start = any_pose(random, 4 * size), pose = any_pose(random, size);
    const Vec3 way = i % 2 == 0 ? Vec3(random.vector(9 * size)) : Vec3(1.5 * (pose.position - start.position));
    const std::optional<ShapeHit> hit = cast_shape(a, start, way, b, pose);
    const auto gap_at = [&](double fraction) {
      Pose at = start;
      at.position += fraction * way;
      return distance(a, at, b, pose).distance / size;
    };
    if (hit && hit->inside) {
      ++stuck;
      CHECK(hit->fraction == 0);
      CHECK(gap_at(0) == 0);
      CHECK(height_over(a, start, hit->point) < 1e-10 * size);
      CHECK(height_over(b, pose, hit->point) < 1e-10 * size);
      CHECK(hit->normal.norm() == doctest::Approx(1).epsilon(1e-9));
      continue;
    }
    const double free = hit ? hit->fraction : 1;
    for (int k = 0; k < 50; ++k) CHECK((gap_at(free * k / 50) > 0 || free < 1e-9));
    if (!hit) {
      ++misses;
      CHECK(gap_at(1) > 0);
      continue;
    }
    ++hits;
    CHECK(hit->normal.dot(way) < 0);
    worst_touch = std::max(worst_touch, gap_at(free));
    CHECK(gap_at(free) < 1e-9);
    Pose there = start;
    there.position += free * way;
    const double off = std::max(std::abs(height_over(b, pose, hit->point)), height_over(a, there, hit->point)) / size;
    worst = std::max(worst, off);
    CHECK(off < 1e-9);
    // One of the two is in front of the tangent plane, the other behind it.
    Pose back = there;
    back.position += 1e-6 * size * hit->normal;
    CHECK(distance(a, back, b, pose).distance > 0);
  }
  MESSAGE(count << " ways, " << hits << " hits, " << stuck << " stuck: gaps of at worst " << worst_touch
                << " and points at worst " << worst << " of the size off");
  CHECK(hits > 0.2 * count);
  CHECK(stuck > 0.02 * count);
  CHECK(misses > 0.2 * count);
}

TEST_CASE("what is turned about an axis touches where it is told to, on both surfaces") {
  Random random(9);
  for (int i = 0; i < 60; ++i) {
    const Solid solids[] = {Cylinder{0.3, 0.5}, Cone{0.5, 0.4}, TaperedCapsule{0.4, 0.2, 0.5}, Box{{0.3, 0.6, 0.2}}};
    const Shape moving{solids[i % 3]}, shape{solids[i / 3 % 4]};
    const Pose start = any_pose(random, 4), pose = any_pose(random, 1);
    const Vec3 way = 1.5 * (pose.position - start.position);
    const std::optional<ShapeHit> hit = cast_shape(moving, start, way, shape, pose);
    REQUIRE(hit.has_value());
    Pose there = start;
    there.position += hit->fraction * way;
    CAPTURE(i);
    CHECK(distance(moving, there, shape, pose).distance < 1e-9);
    CHECK((closest_point(shape, pose, hit->point) - hit->point).norm() < 1e-6);
    CHECK((closest_point(moving, there, hit->point) - hit->point).norm() < 1e-6);
  }
}

TEST_CASE("what lies on a surface goes along it and off it freely, and not into it") {
  const Shape box{Box{{1, 1, 1}}}, floor{Plane{}}, ball{Sphere{1}};
  for (const double gap : {1e-12, 1e-9, 1e-3}) {
    const Pose on{.position = Vec3(0, 1 + gap, 0)};
    CHECK(!cast_shape(box, on, Vec3(5, 0, 0), floor, {}).has_value());
    CHECK(!cast_shape(ball, on, Vec3(0, 5, 0), floor, {}).has_value());
    const std::optional<ShapeHit> into = cast_shape(ball, on, Vec3(3, -4, 0), floor, {});
    REQUIRE(into.has_value());
    CHECK(into->fraction == doctest::Approx(gap / 4).epsilon(1e-3));
  }
  // A displacement of zero hits what overlaps, and nothing else.
  CHECK(!cast_shape(ball, {.position = Vec3(0, 2, 0)}, Vec3(0, 0, 0), floor, {}).has_value());
  CHECK(cast_shape(ball, {.position = Vec3(0, 0.5, 0)}, Vec3(0, 0, 0), floor, {})->inside);
}

TEST_CASE("ways that are none, and two planes, are refused") {
  const Shape ball{Sphere{1}};
  const double none = std::numeric_limits<double>::quiet_NaN(), end = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS((void)cast_shape(ball, {}, Vec3(none, 0, 0), ball, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_shape(ball, {}, Vec3(0, end, 0), ball, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_shape({Plane{}}, {}, Vec3(1, 0, 0), {Plane{}}, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_shape(ball, {.position = Vec3(end, 0, 0)}, Vec3(1, 0, 0), ball, {}),
                  std::invalid_argument);
}
