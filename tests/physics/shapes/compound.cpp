#include <tweenfall/physics/query.h>
#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

Pose at(const Vec3& position, const Quat& rotation = Quat(1, 0, 0, 0)) {
  Pose pose;
  pose.position = position;
  pose.rotation = rotation;
  return pose;
}

/// A table top on four legs; the floor is under its feet.
Compound table() {
  std::vector<Shape> parts = {{Box{{0.6, 0.03, 0.4}}, at({0, 0.72, 0})}};
  for (const double x : {-0.5, 0.5})
    for (const double z : {-0.3, 0.3}) parts.push_back({Box{{0.03, 0.345, 0.03}}, at({x, 0.345, z})});
  return Compound(parts);
}

Compound cross() {
  return Compound(
      {{Box{{0.2, 0.05, 0.05}}, {}}, {Capsule{0.06, 0.15}, {}}, {Box{{0.05, 0.05, 0.2}}, at({0.02, 0, 0})}});
}

WorldSettings always_awake(const Vec3& gravity = {0, -9.81, 0}) {
  WorldSettings settings;
  settings.gravity = gravity;
  settings.sleep_after = std::numeric_limits<double>::infinity();
  return settings;
}

}  // namespace

TEST_CASE("a box in two pieces weighs and turns as the whole one, wherever they stand") {
  test::Random random(5);
  const Quat turn = random.rotation();
  const Vec3 place(0.3, -1, 2);
  const Shape whole{Box{{0.5, 0.2, 0.3}}, at(place, turn)};
  const Shape pieces{Compound({{Box{{0.1, 0.2, 0.3}}, at({-0.4, 0, 0})}, {Box{{0.4, 0.2, 0.3}}, at({0.1, 0, 0})}}),
                     at(place, turn)};
  const MassProperties expected = mass_properties(whole, 3), told = mass_properties(pieces, 3);
  CHECK(near(volume(pieces.solid), volume(whole.solid), 1e-15));
  CHECK(near(told.center, expected.center, 1e-14));
  CHECK(near(told.inertia, expected.inertia, 1e-14));
  World world;
  const BodyId body = world.add({.shape = pieces, .mass = 3.0});
  CHECK(near(world.mass(body).inertia, expected.inertia, 1e-14));
  const Pose node = at({1, 2, 3}, random.rotation());
  CHECK(near(bounds(pieces, node).low, bounds(whole, node).low, 1e-14));
  CHECK(near(bounds(pieces, node).high, bounds(whole, node).high, 1e-14));
  CHECK(near(bounds(world.shape(body), node).high, bounds(whole, node).high, 1e-14));
}

TEST_CASE("compounds that cannot be are refused with the part and words") {
  CHECK_THROWS_WITH(Compound(std::vector<Shape>{}), "a compound needs at least one part");
  CHECK_THROWS_WITH(Compound(std::vector<Shape>{{Sphere{1}}, {Plane{}}}),
                    "part 1 of a compound: a plane is infinite; give it to a fixed body of its own");
  CHECK_THROWS_WITH(Compound(std::vector<Shape>{{Compound(std::vector<Shape>{{Sphere{1}}})}}),
                    "part 0 of a compound: it is a compound itself; put its parts here, at their places");
  CHECK_THROWS_WITH(Compound(std::vector<Shape>{{Sphere{-1}}}),
                    "part 0 of a compound: radius of a sphere must be positive and finite, but is -1");
  CHECK_THROWS_WITH(
      Compound({{Sphere{1}, at({0, std::numeric_limits<double>::infinity(), 0})}}),
      "part 0 of a compound: its place must be finite, and its rotation a quaternion that can be normalized");
}

TEST_CASE("a table stands on its four legs for ten seconds, and each leg has contacts of its own") {
  World world(always_awake());
  world.add({.shape = {Plane{}}, .fixed = true});
  BodySettings settings{.shape = {table()}};
  const BodyId body = world.add(settings);
  for (int k = 0; k < 600; ++k) world.step(1.0 / 60);
  CHECK(near(world.motion(body).pose.position, Vec3(0, 0, 0), 1e-3));
  CHECK((world.motion(body).pose.rotation * Vec3(0, 1, 0)).y() > 1 - 1e-7);
  REQUIRE(world.contacts().size() == 4);
  double pressing = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Contact& contact = world.contacts()[i];
    CHECK(contact.part_a == 0);
    CHECK(contact.part_b == i + 1);
    CHECK_FALSE(contact.began);
    pressing += contact.impulse;
  }
  CHECK(near(pressing, world.mass(body).mass * 9.81 / 60, 1e-3));
}

TEST_CASE("a ball dropped into a cup of walls stays in it") {
  std::vector<Shape> walls = {{Box{{0.5, 0.05, 0.5}}, at({0, 0.05, 0})}};
  for (const double side : {-0.45, 0.45}) {
    walls.push_back({Box{{0.05, 0.4, 0.5}}, at({side, 0.5, 0})});
    walls.push_back({Box{{0.5, 0.4, 0.05}}, at({0, 0.5, side})});
  }
  for (const bool fixed : {true, false}) {
    World world(always_awake());
    world.add({.shape = {Plane{}}, .fixed = true});
    world.add({.shape = {Compound(walls)}, .fixed = fixed});
    BodySettings ball{.shape = {Sphere{0.1}}};
    ball.motion.pose.position = {0.1, 1.5, 0.05};
    ball.motion.twist.linear = {0.3, 0, 0.2};
    const BodyId id = world.add(ball);
    for (int k = 0; k < 600; ++k) world.step(1.0 / 120);
    const Vec3 p = world.motion(id).pose.position;
    CAPTURE(fixed);
    CHECK(std::abs(p.x()) < 0.31);
    CHECK(std::abs(p.z()) < 0.31);
    CHECK(std::abs(p.y() - 0.2) < 2e-3);
  }
}

TEST_CASE("a gas of crosses in a box never gains energy at restitution 1, and none leaves") {
  World world(always_awake({0, 0, 0}));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      world.add({.shape = {Plane{-side * Vec3::Unit(axis), -1.2}}, .friction = 0, .restitution = 1, .fixed = true});
  test::Random random(11);
  std::vector<BodyId> bodies;
  const auto energy = [&] {
    double sum = 0;
    for (const BodyId id : bodies) {
      const Twist twist = world.twist(id);
      const Mat3 axes = world.motion(id).pose.rotation.toRotationMatrix();
      const MassProperties& mass = world.mass(id);
      sum += 0.5 * mass.mass * twist.linear.squaredNorm() +
             0.5 * twist.angular.dot(axes * mass.inertia * axes.transpose() * twist.angular);
    }
    return sum;
  };
  for (int i = 0; i < 27; ++i) {
    BodySettings body{.shape = {cross()}, .friction = 0, .restitution = 1};
    body.motion.pose = at(0.7 * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), random.rotation());
    body.motion.twist = {random.vector(2), random.vector(2)};
    bodies.push_back(world.add(body));
  }
  const double before = energy();
  for (int k = 0; k < 1200; ++k) world.step(1.0 / 240);
  CHECK(energy() < 1.01 * before);
  CHECK(energy() > 0.5 * before);
  for (const BodyId id : bodies) CHECK(world.motion(id).pose.position.cwiseAbs().maxCoeff() < 1.25);
}

TEST_CASE("a world with compounds that is saved and loaded steps on to the same bits") {
  World world;
  world.add({.shape = {Plane{}}, .fixed = true});
  test::Random random(3);
  for (int i = 0; i < 8; ++i) {
    BodySettings body{.shape = {i % 2 == 0 ? Solid{cross()} : Solid{table()}, at({0.1, 0, 0})}};
    body.motion.pose = at({0.2 * i, 0.6 + 0.7 * i, 0}, random.rotation());
    world.add(body);
  }
  for (int k = 0; k < 120; ++k) world.step(1.0 / 60);
  World loaded;
  loaded.load(world.save());
  World copy = world;
  for (int k = 0; k < 120; ++k)
    for (World* each : {&world, &loaded, &copy}) each->step(1.0 / 60);
  CHECK(loaded.state_hash() == world.state_hash());
  CHECK(copy.state_hash() == world.state_hash());
}

TEST_CASE("a ray, a distance and an overlap see the parts of a compound and not what lies between them") {
  const Shape shape{table()};
  const std::optional<RayHit> under = cast_ray(shape, {}, {-2, 0.3, 0}, {1, 0, 0}, 10);
  CHECK_FALSE(under);
  const std::optional<RayHit> leg = cast_ray(shape, {}, {-2, 0.3, 0.3}, {1, 0, 0}, 10);
  REQUIRE(leg);
  CHECK(near(leg->distance, 2 - 0.53, 1e-12));
  const Manifold below = collide(shape, {}, {Sphere{0.1}}, at({0, 0.3, 0}));
  CHECK(below.count == 0);
  const Manifold touched = collide(shape, {}, {Sphere{0.1}}, at({0, 0.8, 0}));
  REQUIRE(touched.count == 1);
  CHECK(near(touched.points[0].penetration, 0.05, 1e-12));
  CHECK(near(touched.normal, Vec3(0, 1, 0), 1e-12));
}
