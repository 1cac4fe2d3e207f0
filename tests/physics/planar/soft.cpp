#include <tweenfall/physics/soft_body.h>

#include <cmath>
#include <limits>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double frame_time = 1.0 / 60, g_down = 9.81, without_sleep = std::numeric_limits<double>::infinity();

World plane_world(WorldPlane plane = WorldPlane::xy) {
  const Vec3 down = plane == WorldPlane::xy ? Vec3(0, -g_down, 0) : Vec3(0, 0, -g_down);
  return World({.gravity = down, .sleep_after = without_sleep, .plane = plane});
}

void run_soft(World& world, double seconds) {
  for (double n = std::round(seconds / frame_time); n > 0; --n) world.step(frame_time);
}

/// Sag of a chain of length L that hangs between two points of one height, l apart: a (cosh(l / 2a) - 1), where
/// 2 a sinh(l / 2a) = L.
double catenary_sag(double length, double apart) {
  double low = 1e-3, high = 1e6;
  for (int n = 0; n < 200; ++n) {
    const double a = std::sqrt(low * high);
    (2 * a * std::sinh(apart / (2 * a)) > length ? low : high) = a;
  }
  return low * (std::cosh(apart / (2 * low)) - 1);
}

void require_in_plane(const World& world, SoftId id, int normal) {
  for (const Vec3& place : soft_positions(world, id)) REQUIRE(place[normal] == 0);
  for (const Vec3& velocity : soft_velocities(world, id)) REQUIRE(velocity[normal] == 0);
}

}  // namespace

TEST_CASE("in a plane a rope between two points hangs as a catenary") {
  for (const WorldPlane plane : {WorldPlane::xy, WorldPlane::yz}) {
    World world = plane_world(plane);
    const Vec3 along = plane == WorldPlane::xy ? Vec3::UnitX() : Vec3::UnitY(),
               up = plane == WorldPlane::xy ? Vec3::UnitY() : Vec3::UnitZ();
    SoftSettings line =
        rope({.from = -along, .to = along, .links = 40, .slack = 0.2, .down = -up, .mass = 1, .stiffness = 1e6});
    line.solver = SoftSolver::springs;
    line.linear_damping = 2;
    line.pins = {{.node = 0, .point = -along}, {.node = 40, .point = along}};
    const SoftId id = add_soft(world, line);
    run_soft(world, 8);
    CHECK(near(-soft_positions(world, id)[20].dot(up), catenary_sag(2.4, 2), 2e-3));
    require_in_plane(world, id, plane == WorldPlane::xy ? 2 : 0);
  }
}

TEST_CASE("in a plane what hangs on a rope weighs on its pin, and swings as a pendulum") {
  World world = plane_world();
  BodySettings ball{.shape = {Sphere{0.1}}, .mass = 2.0};
  ball.motion.pose.position = Vec3(std::sin(0.3), -std::cos(0.3), 0);
  const BodyId bob = world.add(ball);
  SoftSettings line = rope({.from = {0, 0, 0}, .to = ball.motion.pose.position, .links = 8, .mass = 1e-3});
  line.pins = {{.node = 0}, {.node = 8, .body = bob}};
  const SoftId id = add_soft(world, line);
  double crossed = 0;
  int crossings = 0;
  while (crossings < 5 && world.time() < 20) {
    const double before = world.motion(bob).pose.position.x();
    world.step(1.0 / 240);
    const double now = world.motion(bob).pose.position.x();
    if ((before > 0) == (now > 0)) continue;
    crossed = world.time() - now / (now - before) / 240;
    ++crossings;
  }
  // A quarter of a period to the first crossing, and half a period to each later one; for a point, since a rope lets it
  // turn.
  double a = 1, b = std::cos(0.15);
  for (int n = 0; n < 30; ++n) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  CHECK(near(crossed, 2.25 * 2 * pi * std::sqrt(1 / g_down) / a, 3e-3));
  require_in_plane(world, id, 2);
  CHECK(world.motion(bob).pose.position.z() == 0);
  CHECK(world.twist(bob).angular.head<2>() == Vec2::Zero());
  // At rest the pin bears the weight of both, two thousand times the rope's own.
  World still = plane_world();
  ball.motion.pose.position = Vec3(0, -1, 0);
  const BodyId load = still.add(ball);
  line = rope({.from = {0, 0, 0}, .to = {0, -1, 0}, .links = 8, .mass = 1e-3});
  line.pins = {{.node = 0}, {.node = 8, .body = load}};
  const SoftId hung = add_soft(still, line);
  run_soft(still, 2);
  CHECK(near(soft_pins(still, hung)[0].force, Vec3(0, -2.001 * g_down, 0), 1e-6));
  CHECK(near(still.motion(load).pose.position, Vec3(0, -1, 0), 1e-6));
}

TEST_CASE("in a plane a rope lies over what a box and a compound of space are there, and gives what it takes") {
  World world = plane_world();
  // Thin across the plane: there is no way around it there.
  BodySettings block{
      .shape = {Compound({{Box{Vec3(0.3, 0.5, 0.01)}}, {Box{Vec3(0.5, 0.1, 0.01)}, {.position = Vec3(0, -0.5, 0)}}})},
      .fixed = true};
  world.add(block);
  SoftSettings line = rope({.from = {-0.8, 0.9, 0}, .to = {0.8, 0.9, 0}, .links = 64, .mass = 0.4});
  line.friction = 1;
  line.linear_damping = 0.5;
  const SoftId id = add_soft(world, line);
  run_soft(world, 4);
  require_in_plane(world, id, 2);
  double highest = -1;
  for (const Vec3& place : soft_positions(world, id)) {
    highest = std::max(highest, place.y());
    CHECK_FALSE((std::abs(place.x()) < 0.3 && std::abs(place.y()) < 0.5));
  }
  CHECK(near(highest, 0.51, 5e-3));
  CHECK(soft_positions(world, id)[0].y() < 0.4);

  // Without weight and without holders, a body and the rope that it hits keep their common momentum.
  World free({.gravity = {0, 0, 0}, .sleep_after = without_sleep, .plane = WorldPlane::xy});
  BodySettings flying{.shape = {Box{Vec3(0.2, 0.2, 0.2)}}, .mass = 1.0};
  flying.motion.twist.linear = Vec3(3, 0, 0);
  const BodyId body = free.add(flying);
  const SoftId met = add_soft(free, rope({.from = {0.6, -0.5, 0}, .to = {0.6, 0.7, 0}, .links = 24, .mass = 0.5}));
  run_soft(free, 1);
  Vec3 momentum = free.mass(body).mass * free.twist(body).linear;
  const SoftSettings& made = soft_settings(free, met);
  for (std::size_t i = 0; i < made.masses.size(); ++i) momentum += made.masses[i] * soft_velocities(free, met)[i];
  CHECK(near(momentum, Vec3(3, 0, 0), 1e-9));
  CHECK(free.twist(body).linear.x() < 2.9);
  CHECK(std::abs(free.twist(body).angular.z()) > 1e-3);
  CHECK(free.motion(body).pose.position.z() == 0);
}

TEST_CASE("in a plane a rope on a driven body bends its drive and lets it go on to where it was told") {
  World world = plane_world();
  BodySettings hand{.shape = {Sphere{0.1}}, .mass = 1.0, .drive = {.hz = 2, .zeta = 1}};
  const BodyId driven = world.add(hand);
  Motion target;
  target.pose.position = Vec3(1, 0, 0);
  world.set_target(driven, target);
  SoftSettings line = rope({.from = {0, 0, 0}, .to = {0, -1, 0}, .links = 10, .mass = 0.2});
  line.pins = {{.node = 0, .body = driven}};
  static_cast<void>(add_soft(world, line));
  run_soft(world, 5);
  // Its spring, (2 pi hz)^2 of its mass, carries the rope, too.
  CHECK(near(world.motion(driven).pose.position.x(), 1, 5e-3));
  CHECK(near(world.motion(driven).pose.position.y(), -(g_down + 0.2 * g_down) / (16 * pi * pi), 5e-3));
}

TEST_CASE("in a plane a rope tears where it is strained too far, and its bits are kept") {
  World world = plane_world();
  SoftSettings line =
      rope({.from = {0, 0, 0}, .to = {0, -1, 0}, .links = 10, .mass = 0.1, .stiffness = 1000, .tear = 0.05});
  BodySettings ball{.shape = {Sphere{0.1}}, .mass = 4.0};
  ball.motion.pose.position = Vec3(0, -1, 0);
  const BodyId load = world.add(ball);
  line.pins = {{.node = 0}, {.node = 10, .body = load}};
  const SoftId id = add_soft(world, line);
  bool tore = false;
  for (int i = 0; i < 60 && !tore; ++i) {
    world.step(frame_time);
    tore = !soft_tears(world, id).empty();
  }
  CHECK(tore);
  World copy = world, loaded;
  loaded.load(world.save());
  for (World* one : {&world, &copy, &loaded}) run_soft(*one, 1);
  CHECK(copy.state_hash() == world.state_hash());
  CHECK(loaded.state_hash() == world.state_hash());
  CHECK(world.twist(load).linear.y() < -5);
}

TEST_CASE("soft bodies that do not lie in a world's plane are refused in words") {
  using doctest::Contains;
  World world = plane_world();
  const auto refused = [&](const SoftSettings& soft, const char* words) {
    CHECK_THROWS_WITH_AS(static_cast<void>(add_soft(world, soft)), Contains(words), std::invalid_argument);
  };
  refused(cloth(ClothSettings{}), "neither faces nor volumes: of a cloth that is seen from its side a rope is left");
  refused(soft_box({}), "neither faces nor volumes");
  refused(rope({.from = {0, 0, 0}, .to = {0, 0, 1}}), "node 1 does not lie in the world's plane, xy");
  SoftSettings line = rope({});
  line.pins = {{.node = 0, .point = Vec3(0, 0, 1)}};
  refused(line, "the point of a pin does not lie in the world's plane, xy");
  line.pins = {{.node = 0}};
  const SoftId id = add_soft(world, line);
  CHECK_THROWS_WITH_AS(lead_pin(world, id, 0, Vec3(0, 0, 0), Vec3(0, 0, 1)),
                       Contains("the velocity of a pin does not lie in the world's plane, xy"), std::invalid_argument);
  // The plane bears a blow across it.
  apply_impulse(world, id, 5, Vec3(0, 0, 3));
  CHECK(soft_velocities(world, id)[5] == Vec3::Zero());
}
