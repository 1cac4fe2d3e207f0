#include <tweenfall/physics/planar_query.h>

#include <cmath>
#include <limits>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double endlessly = std::numeric_limits<double>::infinity();

/// A shape in a plane, and the same in space, perpendicular to it.
struct Twins {
  planar::Shape flat;
  tweenfall::Shape space;
};

Pose upright(const planar::Place& place) {
  return {Vec3(place.position.x(), place.position.y(), 0),
          Quat(std::cos(place.angle / 2), 0, 0, std::sin(place.angle / 2)), Vec3(1, 1, 1)};
}

Twins twins(int kind, Random& random) {
  const double a = random.between(0.1, 0.7), b = random.between(0.1, 0.7), turn = random.between(-3, 3);
  const Vec2 off(random.between(-0.3, 0.3), random.between(-0.3, 0.3));
  const Pose offset = upright({off, turn});
  if (kind == 0) return {{planar::Circle{a}, off, turn}, {Sphere{a}, offset}};
  if (kind == 1) return {{planar::Capsule{a, b}, off, turn}, {Capsule{a, b}, offset}};
  if (kind == 2) return {{planar::Box{Vec2(a, b)}, off, turn}, {Box{Vec3(a, b, 0.5)}, offset}};
  std::vector<Vec2> corners;
  std::vector<Vec3> points;
  for (int i = 0; i < 7; ++i) {
    const double angle = (i + random.between(0, 0.8)) * 2 * pi / 7;
    corners.emplace_back(a * std::cos(angle), a * std::sin(angle));
    for (const double z : {-0.5, 0.5}) points.emplace_back(corners.back().x(), corners.back().y(), z);
  }
  return {{planar::Polygon{corners}, off, turn}, {Hull{ConvexHull(points)}, offset}};
}

planar::Place somewhere(Random& random, double reach) {
  return {Vec2(random.between(-reach, reach), random.between(-reach, reach)), random.between(-4, 4)};
}

Vec3 in_space(const Vec2& v) {
  return {v.x(), v.y(), 0};
}
Vec2 in_plane(const Vec3& v) {
  return {v.x(), v.y()};
}

}  // namespace

TEST_CASE("in a plane rays meet circles, boxes, capsules, polygons and half-planes where closed forms say") {
  const auto ray = [](const planar::Outline& outline, const Vec2& from, const Vec2& way, double length = endlessly) {
    return planar::cast_ray({outline}, {Vec2(1, 0), 0}, from, way, length);
  };
  // A circle about (1, 0), hit by a line 0.3 above its center
  const auto circle = ray(planar::Circle{0.5}, Vec2(-2, 0.3), Vec2(7, 0));
  REQUIRE(circle);
  CHECK(near(circle->distance, 3 - 0.4, 1e-14));
  CHECK(near(circle->point, Vec2(0.6, 0.3), 1e-14));
  CHECK(near(circle->normal, Vec2(-0.8, 0.6), 1e-14));
  CHECK_FALSE(ray(planar::Circle{0.5}, Vec2(-2, 0.5 + 1e-9), Vec2(1, 0)));
  CHECK_FALSE(ray(planar::Circle{0.5}, Vec2(-2, 0.3), Vec2(1, 0), 2.59));
  CHECK_FALSE(ray(planar::Circle{0.5}, Vec2(-2, 0.3), Vec2(-1, 0)));
  const auto box = ray(planar::Box{Vec2(0.5, 0.25)}, Vec2(-2, 1.25), Vec2(1, -0.5));
  REQUIRE(box);
  CHECK(near(box->point, Vec2(0.5, 0), 1e-14));  // where the line comes down to the near side
  CHECK(near(box->normal, Vec2(-1, 0), 1e-14));
  const auto half = ray(planar::HalfPlane{Vec2(0, 2), 0.5}, Vec2(0, 2.5), Vec2(3, -4), 10);
  REQUIRE(half);
  CHECK(near(half->distance, 2.5, 1e-14));
  CHECK(near(half->point, Vec2(1.5, 0.5), 1e-14));
  CHECK(near(half->normal, Vec2(0, 1), 1e-15));
  const auto capsule = ray(planar::Capsule{0.25, 1}, Vec2(1, 5), Vec2(0, -1));
  REQUIRE(capsule);
  CHECK(near(capsule->distance, 3.75, 1e-14));
  CHECK(near(capsule->normal, Vec2(0, 1), 1e-15));
  const auto inside = ray(planar::Circle{0.5}, Vec2(1.5, 0), Vec2(0, 1));  // on its outline
  REQUIRE(inside);
  CHECK(inside->inside);
  CHECK(inside->distance == 0);
  CHECK(near(inside->normal, Vec2(0, -1), 0));
}

TEST_CASE("in a plane rays, moving shapes, distances and nearest points are those of the same shapes in space") {
  Random random(5);
  int met = 0, passed = 0, apart = 0, deep = 0;
  for (int n = 0; n < 1200; ++n) {
    const Twins a = twins(n % 4, random), b = twins(n / 4 % 4, random);
    const planar::Place place_a = somewhere(random, 2), place_b = somewhere(random, 1);
    const Pose pose_a = upright(place_a), pose_b = upright(place_b);
    CAPTURE(n);
    const auto flat_ray =
        planar::cast_ray(b.flat, place_b, place_a.position, Vec2(place_b.position - place_a.position), 2);
    const auto ray = cast_ray(b.space, pose_b, pose_a.position, Vec3(pose_b.position - pose_a.position), 2);
    REQUIRE(flat_ray.has_value() == ray.has_value());
    if (ray) CHECK(near(flat_ray->distance, ray->distance, 1e-9));
    if (ray) CHECK(near(flat_ray->normal, in_plane(ray->normal), 1e-6));
    if (ray) CHECK(flat_ray->inside == ray->inside);
    const planar::Separation flat_gap = planar::distance(a.flat, place_a, b.flat, place_b);
    const Separation gap = distance(a.space, pose_a, b.space, pose_b);
    REQUIRE(near(flat_gap.distance, gap.distance, 1e-8));
    CHECK(near((flat_gap.on_b - flat_gap.on_a).norm(), flat_gap.distance, 1e-12));
    for (const Vec2& point : {flat_gap.on_a, flat_gap.on_b}) {
      // Points of the shapes, or of both.
      const bool of_a = (planar::closest_point(a.flat, place_a, point) - point).norm() < 1e-12;
      const bool of_b = (planar::closest_point(b.flat, place_b, point) - point).norm() < 1e-12;
      CHECK((of_a || of_b));
      if (flat_gap.distance == 0) CHECK((of_a && of_b));
    }
    flat_gap.distance > 0 ? ++apart : ++deep;
    const Vec2 point = place_a.position;
    CHECK(near(planar::closest_point(b.flat, place_b, point), in_plane(closest_point(b.space, pose_b, in_space(point))),
               1e-8));
    const Vec2 way(random.between(-3, 3), random.between(-3, 3));
    const auto flat_hit = planar::cast_shape(a.flat, place_a, way, b.flat, place_b);
    const auto hit = cast_shape(a.space, pose_a, in_space(way), b.space, pose_b);
    REQUIRE(flat_hit.has_value() == hit.has_value());
    (hit ? met : passed) += 1;
    if (!hit) continue;
    CHECK(near(flat_hit->fraction, hit->fraction, 1e-7));
    CHECK(flat_hit->inside == hit->inside);
    if (!hit->inside) CHECK(near(flat_hit->normal, in_plane(hit->normal), 1e-4));
    // Where it stops they touch, and the point is there.
    planar::Place there = place_a;
    there.position += flat_hit->fraction * way;
    CHECK(planar::distance(a.flat, there, b.flat, place_b).distance < 1e-12);
    CHECK(near(planar::closest_point(b.flat, place_b, flat_hit->point), flat_hit->point, 1e-12));
    if (hit->inside) continue;
    CHECK(near(planar::closest_point(a.flat, there, flat_hit->point), flat_hit->point, 1e-11));
    there.position += 1e-6 * way;
    CHECK(planar::overlapping(a.flat, there, b.flat, place_b));
  }
  for (const int count : {met, passed, apart, deep}) CHECK(count > 100);
}

TEST_CASE("in a plane half-planes are met by what comes down on them, and hold what is behind them") {
  const planar::Shape ground{planar::HalfPlane{Vec2(0, 1), 0.5}}, box{planar::Box{Vec2(0.5, 0.5)}};
  const double tilt = 0.3, low = 0.5 * (std::cos(tilt) + std::sin(tilt));
  const planar::Place above{Vec2(0, 3), tilt};
  for (const bool falls : {true, false}) {
    const auto hit = falls ? planar::cast_shape(box, above, Vec2(1, -4), ground, {})
                           : planar::cast_shape(ground, {}, Vec2(-1, 4), box, above);
    REQUIRE(hit);
    CHECK(near(hit->fraction, (2.5 - low) / 4, 1e-14));
    CHECK(near(hit->normal, Vec2(0, falls ? 1 : -1), 1e-14));
  }
  CHECK_FALSE(planar::cast_shape(box, above, Vec2(4, 0), ground, {}));
  const planar::Separation apart = planar::distance(box, above, ground, {});
  CHECK(near(apart.distance, 2.5 - low, 1e-14));
  CHECK(near(apart.on_b.y(), 0.5, 1e-14));
  CHECK(planar::overlapping(ground, {}, box, {Vec2(0, -50), 0}));
  const auto stuck = planar::cast_shape(box, {Vec2(0, 0.9), 0}, Vec2(1, 0), ground, {});
  REQUIRE(stuck);
  CHECK(stuck->inside);
  CHECK(near(stuck->normal, Vec2(0, 1), 0));
  // A touching shape may leave and slide, but not move on into it.
  CHECK_FALSE(planar::cast_shape(box, {Vec2(0, 1), 0}, Vec2(1, 0), ground, {}));
  CHECK_FALSE(planar::cast_shape(box, {Vec2(0, 1), 0}, Vec2(1, 1), ground, {}));
  CHECK(planar::cast_shape(box, {Vec2(0, 1), 0}, Vec2(1, -1), ground, {})->fraction == 0);
  CHECK(near(planar::closest_point(ground, {}, Vec2(3, 2)), Vec2(3, 0.5), 1e-15));
}

TEST_CASE("a world in a plane answers by body, filtered, at once after changes, and as asking each body does") {
  Random random(9);
  planar::World world;
  world.add({.shape = {planar::HalfPlane{Vec2(0, 1), -4}}, .fixed = true, .groups = 2});
  std::vector<BodyId> bodies;
  std::vector<planar::Shape> shapes;
  for (int i = 0; i < 60; ++i) {
    shapes.push_back(twins(i % 4, random).flat);
    const planar::Place place = somewhere(random, 4);
    bodies.push_back(world.add({.shape = shapes.back(),
                                .sensor = i % 10 == 0,
                                .groups = i % 2 == 0 ? 1u : 4u,
                                .motion = {.position = place.position, .angle = place.angle}}));
  }
  const auto place_of = [&](BodyId body) {
    const planar::Motion motion = world.motion(body);
    return planar::Place{motion.position, motion.angle};
  };
  world.set_motion(bodies[5], {.position = Vec2(50, 0)});
  world.remove(bodies[7]);
  const QueryFilter odd{.groups = 4};
  for (int n = 0; n < 100; ++n) {
    const Vec2 from = somewhere(random, 5).position, way = somewhere(random, 5).position;
    std::optional<double> best;
    double close = endlessly;
    std::size_t touched = 0;
    const planar::Shape probe{planar::Box{Vec2(0.6, 0.3)}};
    for (int i = 1; i < 60; i += 2) {
      if (!world.contains(bodies[static_cast<std::size_t>(i)])) continue;
      const planar::Place place = place_of(bodies[static_cast<std::size_t>(i)]);
      const planar::Shape& shape = shapes[static_cast<std::size_t>(i)];
      const auto hit = planar::cast_ray(shape, place, from, way, 6);
      if (hit && (!best || hit->distance < *best)) best = hit->distance;
      close = std::min(close, (planar::closest_point(shape, place, from) - from).norm());
      touched += planar::overlapping(probe, {from, 0.5}, shape, place) ? 1 : 0;
    }
    const auto first = planar::cast_ray(world, from, way, 6, odd);
    REQUIRE(first.has_value() == best.has_value());
    if (first) CHECK(near(first->distance, *best, 1e-12));
    const auto all = planar::cast_ray_through(world, from, way, 6, odd);
    CHECK(all.empty() == !best.has_value());
    if (first) CHECK((all.front().body == first->body && near(all.front().distance, first->distance, 1e-12)));
    for (std::size_t i = 1; i < all.size(); ++i) CHECK(all[i - 1].distance <= all[i].distance);
    CHECK(planar::overlapping(world, probe, {from, 0.5}, odd).size() == touched);
    const auto nearest = planar::nearest_body(world, from, 100, odd);
    REQUIRE(nearest);
    CHECK(near(nearest->distance, close, 1e-12));
    CHECK(near(planar::closest_point(world, nearest->body, from), nearest->point, 1e-15));
    CHECK(planar::nearest_body(world, from, close * 0.999, odd).has_value() == (close == 0));
  }
  CHECK(planar::cast_ray(world, Vec2(49, 0), Vec2(1, 0))->body == bodies[5]);
  CHECK(planar::cast_ray(world, Vec2(90, 0), Vec2(0, -1), endlessly, {.groups = 2})->point.y() == -4);
  const QueryFilter not_five{.accept = [&](BodyId body) { return body != bodies[5]; }};
  CHECK_FALSE(planar::cast_ray(world, Vec2(49, 0), Vec2(1, 0), 5, not_five));
  const auto swept = planar::cast_shape(world, {planar::Circle{0.5}}, {Vec2(90, 0), 0}, Vec2(0, -10));
  REQUIRE(swept);
  CHECK(near(swept->fraction, 0.35, 1e-14));
}

TEST_CASE("in a plane questions with numbers that cannot be are refused in words") {
  const planar::World world;
  const planar::Shape half{planar::HalfPlane{}}, circle{planar::Circle{}};
  using doctest::Contains;
  CHECK_THROWS_WITH_AS((void)planar::cast_ray(circle, {}, Vec2(0, 0), Vec2(0, 0)), Contains("longer than 0"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)planar::cast_ray(circle, {}, Vec2(NAN, 0), Vec2(0, 1)), Contains("start of a ray"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)planar::cast_ray(world, Vec2(0, 0), Vec2(0, 1), -1), Contains("must not be negative"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)planar::distance(half, {}, half, {}), Contains("a half-plane is infinite"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)planar::overlapping(world, half, {}), Contains("a half-plane is infinite"),
                       std::invalid_argument);
  CHECK_THROWS_AS((void)planar::cast_shape(circle, {}, Vec2(INFINITY, 0), circle, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)planar::closest_point({planar::Circle{-1}}, {}, Vec2(0, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)planar::closest_point(world, BodyId{}, Vec2(0, 0)), std::invalid_argument);
  // Directions of any length, and shapes of any size.
  for (const double scale : {1e-300, 1e-6, 1e6, 1e30})
    CHECK(near(planar::cast_ray(circle, {}, Vec2(-3, 0), Vec2(scale, 0))->distance, 2.5, 1e-14));
  for (const double size : {1e-6, 1e6}) {
    const auto hit = planar::cast_shape({planar::Box{Vec2(size, size)}}, {Vec2(-5 * size, 0.5 * size), 0},
                                        Vec2(10 * size, 0), {planar::Box{Vec2(size, size)}}, {});
    REQUIRE(hit);
    CHECK(near(hit->fraction, 0.3, 1e-12));
  }
}
