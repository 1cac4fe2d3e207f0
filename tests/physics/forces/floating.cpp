#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <limits>

#include "physics/saved_bytes.h"
#include "physics/scene.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

WorldSettings afloat(Integrator integrator) {
  WorldSettings settings;
  settings.integrator = integrator;
  settings.sleep_after = std::numeric_limits<double>::infinity();
  return settings;
}

BodySettings raft(double density, const Vec3& half, double height) {
  BodySettings settings;
  settings.shape.solid = Box{half};
  settings.density = density;
  settings.motion.pose.position = Vec3(0, height, 0);
  return settings;
}

}  // namespace

TEST_CASE("a box floats as deep as its density says, and bobs by 2 pi sqrt(draught / g)") {
  World world(afloat(Integrator::rk4));
  const Vec3 half(0.5, 0.2, 0.7);
  // It floats with 600 / 1000 of its 0.4 m submerged: its center is 0.04 m below the surface at 3 m.
  const BodyId body = world.add(raft(600, half, 2.96));
  world.add_force(Buoyancy{.level = 3});
  world.step(0.01);
  CHECK(near(world.twist(body).linear.y(), 0, 1e-13));
  CHECK(near(world.motion(body).pose.position.y(), 2.96, 1e-14));
  Motion lifted = world.motion(body);
  lifted.pose.position.y() += 0.05;
  lifted.twist = {};
  world.set_motion(body, lifted);
  const double period = 2 * pi * std::sqrt(0.24 / 9.81);
  for (int i = 0; i < 240; ++i) world.step(period / 240);
  CHECK(near(world.motion(body).pose.position.y(), 3.01, 1e-7));
  for (int i = 0; i < 120; ++i) world.step(period / 240);
  CHECK(near(world.motion(body).pose.position.y(), 2.91, 1e-7));
}

TEST_CASE("a ball of half the density floats with half of it under, and a heavy one weighs less by what it displaces") {
  World world(afloat(Integrator::exact_quadratic));
  BodySettings ball;
  ball.shape.solid = Sphere{0.3};
  ball.density = 500;
  const BodyId half = world.add(ball);
  ball.density = 4000;
  ball.motion.pose.position = Vec3(5, -9, 0);
  const BodyId heavy = world.add(ball);
  world.add_force(Buoyancy{});
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  CHECK(near(world.motion(half).pose.position, Vec3(0, 0, 0), 1e-12));
  CHECK(near(world.twist(heavy).linear.y(), -0.75 * 9.81, 1e-12));
}

TEST_CASE("a raft that leans is righted by its metacentric height, and one that is too high falls over") {
  for (const double high : {0.2, 1.0}) {
    World world(afloat(Integrator::explicit_euler));
    const Vec3 half(0.5, high, 0.7);
    BodySettings box = raft(500, half, 0);
    const double lean = 1e-4;
    box.motion.pose.rotation = exp_map(Vec3(0, 0, lean));
    const BodyId body = world.add(box);
    world.add_force(Buoyancy{});
    world.step(1e-3);
    // G M = K B + I / V - K G, with I / V = b^2 / (12 draft); the moment is that times weight and lean.
    const double draught = high, metacentric = draught / 2 + 1.0 / (12 * draught) - high;
    const double moment = -world.mass(body).mass * 9.81 * metacentric * lean;
    const double spin = world.twist(body).angular.z();
    CHECK(near(spin * world.mass(body).inertia(2, 2) / 1e-3 / moment, 1, 1e-6));
    CHECK((spin < 0) == (high < 0.5));
  }
}

TEST_CASE("what tumbles in a liquid without drag keeps its energy, whatever its shape") {
  const std::vector<Vec3> wedge{
      {-0.4, -0.3, -0.5}, {0.6, -0.3, -0.5}, {0.5, 0.7, -0.4}, {-0.4, -0.2, 0.5}, {0.3, 0.5, 0.6}};
  for (const Solid& solid : {Solid{Box{Vec3(0.3, 0.2, 0.5)}}, Solid{Capsule{0.2, 0.4}}, Solid{Cone{0.4, 0.4}},
                             Solid{Hull{ConvexHull(wedge)}}}) {
    CAPTURE(std::string(kind_name(solid)));
    World world(afloat(Integrator::rk4));
    BodySettings body;
    body.shape.solid = solid;
    body.density = 450;
    body.motion.pose.position = Vec3(0, 0.6, 0);
    body.motion.twist.angular = Vec3(1, 2, 3);
    world.add(body);
    const std::size_t liquid = world.add_force(Buoyancy{.normal = Vec3(0, 3, 0)});
    REQUIRE(world.potential_energy(liquid));
    const double start = world.kinetic_energy() + world.potential_energy();
    for (int i = 0; i < 300; ++i) world.step(1.0 / 200);
    CHECK(near(world.kinetic_energy() + world.potential_energy(), start, 1e-5));
  }
  World tilted;
  tilted.add({});
  const std::size_t liquid = tilted.add_force(Buoyancy{.normal = Vec3(1, 1, 0)});
  CHECK_FALSE(tilted.potential_energy(liquid));
}

TEST_CASE("a raft comes to rest in a liquid that resists, sleeps, and wakes when the liquid rises") {
  World world;
  const BodyId body = world.add(raft(600, Vec3(0.5, 0.2, 0.7), 0.5));
  Strength strength = keyed_curve<double>({{.time = 30.0, .value = 1.0, .ease = Ease::hold()},
                                           {.time = 31.0, .value = 1.5, .ease = Ease::hold()},
                                           {.time = 40.0, .value = 1.5}});
  world.add_force(Buoyancy{.drag = {.linear = 800, .angular = 200}}, {{}, strength});
  for (int i = 0; i < 29 * 60; ++i) world.step(1.0 / 60);
  CHECK(world.asleep(body));
  CHECK(near(world.motion(body).pose.position.y(), -0.04, 2e-3));
  for (int i = 0; i < 3 * 60; ++i) world.step(1.0 / 60);
  CHECK_FALSE(world.asleep(body));
  for (int i = 0; i < 20 * 60; ++i) world.step(1.0 / 60);
  CHECK(world.asleep(body));
  CHECK(near(world.motion(body).pose.position.y(), 0.04, 2e-3));
}

TEST_CASE("a world with every force that is no function is saved, copied and shared out to the same bits") {
  const auto make = [](Integrator integrator, int threads) {
    WorldSettings settings = afloat(integrator);
    settings.threads = threads;
    World world(settings);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 6; ++i) {
      BodySettings body = raft(400 + 50.0 * i, Vec3(0.2, 0.15, 0.1), 0.3 * i);
      body.motion.pose.position.x() = 0.7 * i;
      body.motion.twist.angular = Vec3(0.1 * i, 1, 0);
      bodies.push_back(world.add(body));
    }
    const std::vector<Key<double>> keys{{0.0, 0.5, *Ease::named("bounce-out")}, {0.4, 1.5, Ease::hold()}, {0.7, 0.2}};
    world.add_force(Drag{.linear = 0.1}, {{}, Strength::formula("1 + sin(3*t)")});
    world.add_force(Wind{.velocity = Vec3(1, 0, 2), .coefficient = 1},
                    {{bodies[0], bodies[2]}, keyed_curve<double>(keys)});
    world.add_force(Damper{.a = bodies[0], .b = bodies[1], .damping = 3});
    world.add_force(Buoyancy{.level = 0.1, .drag = {.linear = 3, .angular = 0.1}, .flow = Vec3(0.1, 0, 0)});
    world.add_force(Attractor{.of = bodies[3], .acceleration = 0.3, .softening = 0.2});
    world.add_force(Vortex{.at = Vec3(1, 0, 0), .acceleration = 0.5, .softening = 0.1});
    world.add_force(ForceFormula({"sin(t)*mass", "a", "-vz"}, {{"a", 0.2}}), {.bodies = {bodies[4]}});
    world.add_force(ForceFormula::potential("x^2"), {{bodies[5]}, Curve<double>(0.5)});
    world.add_force(Push{.body = bodies[1], .force = Vec3(1, 0, 0), .at = Vec3(0, 0.1, 0), .turns = true});
    return world;
  };
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::rk4}) {
    World world = make(integrator, 0), shared = make(integrator, 4);
    for (int i = 0; i < 30; ++i) {
      world.step(1.0 / 60);
      shared.step(1.0 / 60);
    }
    CHECK(world.state_hash() == shared.state_hash());
    World loaded, copy = world;
    loaded.load(world.save());
    CHECK(loaded.state_hash() == world.state_hash());
    for (int i = 0; i < 30; ++i)
      for (World* each : {&world, &loaded, &copy}) each->step(1.0 / 60);
    CHECK(loaded.state_hash() == world.state_hash());
    CHECK(copy.state_hash() == world.state_hash());
  }
  // Another strength makes another world.
  World one, other;
  one.add_force(Drag{.linear = 1}, {{}, 2});
  other.add_force(Drag{.linear = 1}, {{}, 3});
  CHECK(one.state_hash() != other.state_hash());
}
