#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/world.h>

#include <cmath>
#include <limits>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double per_step = 1.0 / 240, no_sleep = std::numeric_limits<double>::infinity();

World weightless_world(WorldPlane plane = WorldPlane::xy) {
  return World({.gravity = {0, 0, 0}, .sleep_after = no_sleep, .plane = plane});
}

BodyId ball_at(World& world, const Vec3& place, const Vec3& velocity = Vec3(0, 0, 0), double mass = 2) {
  BodySettings body{.shape = {Sphere{0.2}}, .mass = mass};
  body.motion.pose.position = place;
  body.motion.twist.linear = velocity;
  return world.add(body);
}

void run_plane(World& world, double seconds) {
  for (double n = std::round(seconds / per_step); n > 0; --n) world.step(per_step);
}

}  // namespace

TEST_CASE("in a plane drag, a wind and a push do what they do in space, by closed forms") {
  World world = weightless_world();
  const BodyId slow = ball_at(world, Vec3(0, 0, 0), Vec3(3, 1, 0)), blown = ball_at(world, Vec3(0, 3, 0)),
               pushed = ball_at(world, Vec3(0, 6, 0));
  world.add_force(Drag{.linear = 1.5}, {.bodies = {slow}});
  world.add_force(Wind{.velocity = Vec3(4, 0, 9), .linear = 0.8}, {.bodies = {blown}});
  world.add_force(Push{.body = pushed, .force = Vec3(0, 3, 5), .torque = Vec3(1, 0, 0.2)});
  run_plane(world, 1);
  // dv/dt = -c v / m
  CHECK(near(world.twist(slow).linear, std::exp(-0.75) * Vec3(3, 1, 0), 5e-3));
  CHECK(near(world.twist(blown).linear, Vec3(4 * (1 - std::exp(-0.4)), 0, 0), 5e-3));
  CHECK(near(world.twist(pushed).linear, Vec3(0, 1.5, 0), 1e-9));
  CHECK(near(world.motion(pushed).pose.position, Vec3(0, 6.75, 0), 1e-9));
  const double moment = 0.4 * 2 * 0.04;
  CHECK(near(world.twist(pushed).angular, Vec3(0, 0, 0.2 / moment), 1e-6));
}

TEST_CASE("in a plane a mass on a spring swings as a cosine, two draw each other, and a stiff spring never grows") {
  for (const WorldPlane plane : {WorldPlane::xy, WorldPlane::xz, WorldPlane::yz}) {
    World world = weightless_world(plane);
    const Vec3 along = plane == WorldPlane::yz ? Vec3::UnitY() : Vec3::UnitX();
    const BodyId one = ball_at(world, 1.5 * along);
    world.add_force(Spring{.a = one, .rest_length = 1, .stiffness = 50});
    run_plane(world, 1);
    CHECK(near(world.motion(one).pose.position.dot(along), 1 + 0.5 * std::cos(5.0), 5e-3));
    CHECK(world.motion(one).pose.position.cross(along).norm() == 0);
  }
  World world = weightless_world();
  const BodyId left = ball_at(world, Vec3(-1, 0, 0)), right = ball_at(world, Vec3(1, 0, 0), Vec3(0, 0, 0), 6);
  world.add_force(Spring{.a = left, .b = right, .rest_length = 1.5, .stiffness = 1e7});
  const double before = world.kinetic_energy();
  run_plane(world, 1);
  CHECK(before == 0);
  CHECK(world.kinetic_energy() < 0.1);
  const Vec3 a = world.motion(left).pose.position, b = world.motion(right).pose.position;
  CHECK(near((b - a).norm(), 1.5, 1e-3));
  CHECK(near(Vec3(2 * a + 6 * b), Vec3(4, 0, 0), 1e-9));
}

TEST_CASE("in a plane a moon circles an attractor, and a box floats by its density") {
  World sky = weightless_world();
  const BodyId moon = ball_at(sky, Vec3(1, 0, 0), Vec3(0, 2, 0));
  sky.add_force(Attractor{.acceleration = 4});  // v^2 = a / r
  run_plane(sky, pi);
  CHECK(near(sky.motion(moon).pose.position.norm(), 1, 2e-3));
  World sea({.sleep_after = no_sleep, .plane = WorldPlane::xy});
  BodySettings raft{.shape = {Box{Vec3(0.5, 0.2, 0.5)}}, .density = 400.0};
  const BodyId floating = sea.add(raft);
  sea.add_force(Buoyancy{.drag = {.linear = 2000, .angular = 200}});
  run_plane(sea, 8);
  // 0.4 of its height is submerged: its center is 0.04 m above the water.
  CHECK(near(sea.motion(floating).pose.position.y(), 0.04, 1e-4));
}

TEST_CASE("in a plane what forces move is the same after saving, and a strength that comes wakes what sleeps") {
  World world({.plane = WorldPlane::xy});
  world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId ball = ball_at(world, Vec3(0, 0.2, 0));
  world.add_force(Push{.body = ball, .force = Vec3(20, 0, 0)},
                  {.strength = Strength(keyed_curve<double>(
                       {{.time = 0, .value = 0.0, .ease = Ease::hold()}, {.time = 3, .value = 1.0}}))});
  run_plane(world, 2);
  CHECK(world.asleep(ball));
  World loaded;
  loaded.load(world.save());
  for (World* const one : {&world, &loaded}) run_plane(*one, 1.5);
  CHECK_FALSE(world.asleep(ball));
  CHECK(world.motion(ball).pose.position.x() > 0.1);
  CHECK(world.state_hash() == loaded.state_hash());
  CHECK(world.motion(ball).pose.position == loaded.motion(ball).pose.position);
  // Absurd numbers are reported, and end nothing but the step.
  World absurd = weightless_world();
  const BodyId thrown = ball_at(absurd, Vec3(0, 0, 0));
  absurd.add_force(Push{.body = thrown, .force = Vec3(1e30, 0, 0)});
  CHECK_THROWS_AS(for (int n = 0; n < 5000; ++n) absurd.step(1e3), NotFinite);
}
