#include <tweenfall/curves/rotation.h>

#include <limits>

#include "physics/strategies/ground.h"

using namespace tweenfall;
using test::near;

namespace {

/// Two balls of 1 and 3 kg that overlap by 0.1 m, side by side.
struct Lapping {
  World world;
  BodyId light, heavy;

  explicit Lapping(Parting separation)
      : world(test::weightless(test::with(ContactSolver::iterative, separation))),
        light(world.add(test::solid_at(Sphere{0.5}, Vec3(-0.45, 0, 0), 1))),
        heavy(world.add(test::solid_at(Sphere{0.5}, Vec3(0.45, 0, 0), 3))) {
    world.step(1.0 / 60);
  }
  [[nodiscard]] double moved_light() const { return -0.45 - world.motion(light).pose.position.x(); }
  [[nodiscard]] double moved_heavy() const { return world.motion(heavy).pose.position.x() - 0.45; }
};

}  // namespace

TEST_CASE(
    "overlap is taken apart by half and half, by m2 / (m1 + m2), and whole by one: what the lecture's options say") {
  const Lapping half(Parting::half), mass(Parting::by_mass), impulse(Parting::positional_impulse),
      closest(Parting::closest_point);
  CHECK(near(half.moved_light(), 0.05, 1e-9));
  CHECK(near(half.moved_heavy(), 0.05, 1e-9));
  CHECK(near(mass.moved_light(), 0.075, 1e-9));
  CHECK(near(mass.moved_heavy(), 0.025, 1e-9));
  // The center of mass stays.
  CHECK(near(mass.moved_light(), 3 * mass.moved_heavy(), 1e-12));
  // For balls no arm turns anything.
  CHECK(near(impulse.moved_light(), 0.075, 1e-9));
  CHECK(near(impulse.moved_heavy(), 0.025, 1e-9));
  CHECK(closest.moved_light() == 0);
  CHECK(near(closest.moved_heavy(), 0.1, 1e-9));
  for (const Lapping* each : {&half, &mass, &impulse, &closest}) {
    CHECK(test::deepest(each->world) < 1e-9);
    CHECK(each->world.kinetic_energy() == 0);
  }
}

TEST_CASE("what cannot move leaves all of the overlap to the other") {
  for (const Parting separation :
       {Parting::half, Parting::by_mass, Parting::positional_impulse, Parting::closest_point})
    for (const bool floor_first : {false, true}) {
      World world(test::weightless(test::with(ContactSolver::iterative, separation)));
      if (floor_first) test::add_floor(world);
      const BodyId ball = world.add(test::solid_at(Sphere{0.5}, Vec3(0, 0.4, 0)));
      if (!floor_first) test::add_floor(world);
      world.step(0.01);
      CHECK(near(world.motion(ball).pose.position.y(), 0.5, 1e-9));
    }
}

TEST_CASE("a positional impulse at a rod's end moves and turns it as an impulse would, and others only move it") {
  // depth = impulse (1/m + r^2/I): for a rod 2 m long and 0.1 m square, struck 0.9 m from its center.
  const double depth = 1e-5, mass = 2, inertia = mass / 12 * (2.0 * 2 + 0.1 * 0.1), arm = 0.9;
  const double impulse = depth / (1 / mass + arm * arm / inertia);
  for (const Parting separation : {Parting::positional_impulse, Parting::by_mass}) {
    World world(test::weightless(test::with(ContactSolver::iterative, separation)));
    BodySettings peg = test::solid_at(Sphere{0.1}, Vec3(arm, -0.15 + depth, 0));
    peg.fixed = true;
    world.add(peg);
    const BodyId rod = world.add(test::solid_at(Box{Vec3(1, 0.05, 0.05)}, Vec3(0, 0, 0), mass));
    world.step(0.01);
    const bool turns = separation == Parting::positional_impulse;
    const Motion motion = world.motion(rod);
    CHECK(near(motion.pose.position.y(), turns ? impulse / mass : depth, 1e-3 * depth));
    CHECK(near(log_map(motion.pose.rotation).z(), turns ? arm * impulse / inertia : 0, 1e-3 * depth));
    CHECK(test::deepest(world) < 1e-9);
  }
}

TEST_CASE("a heap is taken apart within its passes by every way, and what is deepest then lies less deep") {
  for (const Parting separation :
       {Parting::half, Parting::by_mass, Parting::positional_impulse, Parting::closest_point}) {
    CAPTURE(static_cast<int>(separation));
    World world(test::weightless(test::with(ContactSolver::iterative, separation)));
    test::add_floor(world);
    for (int i = 0; i < 5; ++i)
      world.add(test::solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0.1 * i, 0.48 + 0.96 * i, 0), 1.0 + i));
    const double before = test::deepest(world);
    CHECK(near(before, 0.04, 1e-9));
    for (int step = 0; step < 30; ++step) world.step(1.0 / 60);
    CHECK(test::deepest(world) < 0.1 * before);
  }
}
