#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>
#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

Hull cube_hull(double half, const Vec3& middle = Vec3(0, 0, 0)) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(middle + half * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  return Hull{ConvexHull(corners)};
}

Hull turned_hull(const std::vector<Vec2>& profile, int sides) {
  std::vector<Key<Vec2>> keys;
  for (std::size_t i = 0; i < profile.size(); ++i) keys.push_back({static_cast<double>(i), profile[i], Ease::linear()});
  const Curve<Vec2> curve = keyed_curve<Vec2>(std::span<const Key<Vec2>>(keys));
  return Hull{ConvexHull(lathe(curve, {.segments = sides, .profile_steps = 1}))};
}

}  // namespace

TEST_CASE("a cube as a hull falls, lands and rests as the box does") {
  for (const double restitution : {0.0, 0.5}) {
    double height[2] = {0, 0};
    for (const bool as_hull : {false, true}) {
      World world;
      world.add({.shape = {Plane{}}, .restitution = restitution, .fixed = true});
      BodySettings cube;
      if (as_hull)
        cube.shape.solid = cube_hull(0.5);
      else
        cube.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
      cube.restitution = restitution;
      cube.motion.pose.position = Vec3(0, 1.5, 0);
      const BodyId body = world.add(cube);
      for (int i = 0; i < 240 * 4; ++i) world.step(1.0 / 240);
      const Vec3 settled = world.motion(body).pose.position;
      for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
      CHECK((world.motion(body).pose.position - settled).norm() < 1e-6);
      CHECK(world.asleep(body));
      CHECK(near(world.mass(body).mass, 1000, 1e-12));
      height[as_hull] = settled.y();
    }
    CHECK(std::abs(height[0] - 0.5) < 1e-3);
    CHECK(std::abs(height[1] - height[0]) < 1e-5);
  }
}

TEST_CASE("hull cubes in a stack, and hull cubes and boxes in turn, stand") {
  for (const bool mixed : {false, true}) {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    std::vector<BodyId> bodies;
    for (int i = 0; i < 5; ++i) {
      BodySettings cube;
      if (mixed && i % 2 == 1)
        cube.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
      else
        cube.shape.solid = cube_hull(0.5);
      cube.mass = 1;
      cube.motion.pose.position = Vec3(0, 0.5 + i, 0);
      bodies.push_back(world.add(cube));
    }
    for (int i = 0; i < 240 * 10; ++i) world.step(1.0 / 240);
    for (int i = 0; i < 5; ++i)
      CHECK((world.motion(bodies[static_cast<std::size_t>(i)]).pose.position - Vec3(0, 0.5 + i, 0)).norm() < 0.01);
    CHECK(world.asleep(bodies.back()));
  }
}

TEST_CASE("a hull whose origin is far from its middle flies about its center of mass") {
  World world;
  BodySettings cube;
  cube.shape.solid = cube_hull(0.5, Vec3(3, 0, 1));
  cube.motion.twist.angular = Vec3(1, 2, 3);
  const BodyId body = world.add(cube);
  CHECK(near(world.mass(body).center, Vec3(3, 0, 1), 1e-14));
  const Vec3 start = world.twist(body).linear;
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  const Pose pose = world.motion(body).pose;
  const Vec3 center = pose.position + pose.rotation * Vec3(3, 0, 1);
  CHECK(near(center, Vec3(Vec3(3, 0, 1) + start - Vec3(0, 0.5 * 9.81, 0)), 1e-9));
  CHECK(near(world.twist(body).angular, Vec3(1, 2, 3), 1e-9));  // all axes of a cube are principal
}

TEST_CASE("what two hulls do to each other changes neither their momentum nor their angular momentum") {
  World world({.gravity = Vec3(0, 0, 0)});
  test::Random random(31);
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.push_back(random.vector(0.4));
  BodySettings first;
  first.shape.solid = Hull{ConvexHull(points)};
  first.mass = 2;
  first.restitution = 0.5;
  first.motion.twist = {Vec3(4, 0, 0), Vec3(1, 2, -1)};
  BodySettings second;
  second.shape.solid = turned_hull({{0, -0.5}, {0.3, 0}, {0, 0.6}}, 16);
  second.mass = 1;
  second.motion.pose.position = Vec3(2, 0.2, 0.1);
  const BodyId a = world.add(first), b = world.add(second);
  const auto momentum = [&](Vec3& angular) {
    Vec3 linear(0, 0, 0);
    angular.setZero();
    for (const BodyId id : {a, b}) {
      const MassProperties& mass = world.mass(id);
      const Pose pose = world.motion(id).pose;
      const Twist twist = world.twist(id);
      const Mat3 axes = pose.rotation.toRotationMatrix();
      const Vec3 center = pose.position + axes * mass.center;
      linear += mass.mass * twist.linear;
      angular += axes * (mass.inertia * (axes.transpose() * twist.angular)) + mass.mass * center.cross(twist.linear);
    }
    return linear;
  };
  Vec3 angular_before, angular_after;
  const Vec3 before = momentum(angular_before);
  bool met = false;
  for (int i = 0; i < 480; ++i) {
    world.step(1.0 / 240);
    met = met || !world.contacts().empty();
  }
  CHECK(met);
  const Vec3 after = momentum(angular_after);
  CHECK(near(after, before, 1e-12));
  CHECK(near(angular_after, angular_before, 1e-12));
  CHECK(world.twist(b).linear.x() > 1);
}

TEST_CASE("a fast hull does not pass a thin wall of any shape") {
  for (int wall = 0; wall < 3; ++wall) {
    World world({.gravity = Vec3(0, 0, 0)});
    Shape shape{Box{Vec3(0.01, 2, 2)}};
    if (wall == 1)
      shape.solid = Hull{ConvexHull(std::vector<Vec3>{
          {-0.01, -2, -2}, {-0.01, 3, 0}, {-0.01, 0, 3}, {0.01, -2, -2}, {0.01, 3, 0}, {0.01, 0, 3}})};
    if (wall == 2) shape = {Plane{Vec3(-1, 0, 0), 0.01}};
    world.add({.shape = shape, .fixed = true});
    BodySettings top;
    top.shape.solid = turned_hull({{0, -0.2}, {0.15, 0}, {0.15, 0.1}, {0, 0.15}}, 20);
    top.motion.pose.position = Vec3(-3, 0.1, 0.2);
    top.motion.twist = {Vec3(120, 0, 0), Vec3(3, 20, 5)};
    const BodyId body = world.add(top);
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    CAPTURE(wall);
    CHECK(world.motion(body).pose.position.x() < 0);
  }
}

TEST_CASE("a turned cylinder stands, rolls without slipping, and a tilted one falls over") {
  const Hull cylinder = turned_hull({{0.2, -0.3}, {0.2, 0.3}}, 32);
  World world;
  world.add({.shape = {Plane{}}, .fixed = true});
  BodySettings upright;
  upright.shape.solid = cylinder;
  upright.motion.pose.position = Vec3(0, 0.3, 0);
  BodySettings leaning = upright;
  leaning.motion.pose.position = Vec3(3, 0.45, 0);
  const double tilt = 50 * test::pi / 180;
  leaning.motion.pose.rotation = Quat(std::cos(tilt / 2), 0, 0, std::sin(tilt / 2));
  const BodyId a = world.add(upright), b = world.add(leaning);
  for (int i = 0; i < 240 * 6; ++i) world.step(1.0 / 240);
  CHECK((world.motion(a).pose.position - Vec3(0, 0.3, 0)).norm() < 1e-3);
  CHECK(world.asleep(a));
  const Motion fallen = world.motion(b);
  CHECK(std::abs((fallen.pose.rotation * Vec3(0, 1, 0)).y()) < 0.01);
  CHECK(std::abs(fallen.pose.position.y() - 0.2) < 2e-3);
}

TEST_CASE("all shapes in one heap come to rest, the same way to the bit each time") {
  const auto run = [] {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    test::Random random(77);
    std::vector<BodyId> bodies;
    std::vector<Vec3> rock;
    for (int i = 0; i < 20; ++i) rock.push_back(random.vector(0.25));
    const Solid solids[] = {Hull{ConvexHull(rock)}, Sphere{0.2}, turned_hull({{0.2, -0.2}, {0.1, 0.3}}, 16),
                            Box{Vec3(0.2, 0.15, 0.25)}, Capsule{0.12, 0.2}};
    for (int i = 0; i < 20; ++i) {
      BodySettings body;
      body.shape.solid = solids[i % 5];
      body.rolling_friction = 0.01;
      body.motion.pose.position = Vec3(random.between(-0.4, 0.4), 0.5 + 0.4 * i, random.between(-0.4, 0.4));
      body.motion.pose.rotation = random.rotation();
      bodies.push_back(world.add(body));
    }
    for (int i = 0; i < 240 * 12; ++i) world.step(1.0 / 240);
    for (const BodyId body : bodies) {
      const Vec3 at = world.motion(body).pose.position;
      CHECK(at.y() > 0.05);
      CHECK(at.y() < 1.5);
      CHECK(world.twist(body).linear.norm() < 0.05);
    }
    return world.state_hash();
  };
  const auto first = run();
  CHECK(run() == first);
}
