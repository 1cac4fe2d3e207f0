#include <doctest/doctest.h>

#include <algorithm>

#include "physics/joints/joint_scene.h"
#include "support.h"

namespace tweenfall::jointed {

namespace {

/// Bars of 0.4 m in a row, each joined to the one before by what `kind_of` says, with random spins.
World bars(test::Random& random, int count, bool anchored, double spin, const JointKind& kind) {
  World world(weightless);
  BodyId before{};
  for (int i = 0; i < count; ++i) {
    const BodyId bar = world.add(
        {.shape = {Box{Vec3(0.2, 0.07, 0.1)}},
         .mass = std::pow(10, random.between(-1, 1)),
         .collides_with = 0,
         .motion = {.pose = {.position = Vec3(0.4 * i, 0, 0)}, .twist = {random.vector(1), random.vector(spin)}}});
    if (i > 0 || anchored)
      join(world, before, bar, Vec3(0.4 * i - 0.2, 0, 0), kind, random.vector(1), random.vector(1));
    before = bar;
  }
  return world;
}

}  // namespace

TEST_CASE("chains that come to their bounds, all at once and again and again, never gain energy") {
  const Limits narrow{-0.35, 0.2};
  const std::array<JointKind, 5> kinds{HingeJoint{.limits = narrow}, SliderJoint{.limits = narrow},
                                       UniversalJoint{.first_limits = narrow, .second_limits = narrow},
                                       SwingTwistJoint{.swing_y = 0.3, .swing_z = 0.6, .twist = narrow},
                                       DistanceJoint{{0, 0.3}}};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    for (std::uint64_t seed = 0; seed < 9; ++seed) {
      CAPTURE(kind);
      CAPTURE(seed);
      test::Random random(seed);
      World world = bars(random, 7, seed % 2 == 0, seed % 3 == 0 ? 12 : 0.6, kinds[kind]);
      world.step(1.0 / 60);
      const double start = world.kinetic_energy();
      double most = 0;
      for (int i = 0; i < 150; ++i) {
        world.step(1.0 / 60);
        most = std::max(most, world.kinetic_energy());
      }
      CHECK(most < 1.02 * start);
    }
}

TEST_CASE("a motor that drives against its own bound gives no more than its force over the way there") {
  for (const double force : {0.02, 1.0, 30.0})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      CAPTURE(force);
      CAPTURE(seed);
      test::Random random(seed);
      const Limits bounds{-0.4, 0.4};
      World world = bars(random, 4, false, 3, HingeJoint{bounds, Motor{.speed = 2, .max_force = force}});
      world.step(1.0 / 60);
      const double start = world.kinetic_energy();
      for (int i = 0; i < 180; ++i) {
        world.step(1.0 / 60);
        // Each of the three hinges turns by at most its range before it is struck back.
        CHECK(world.kinetic_energy() < 1.05 * start + 3 * force * 0.8);
      }
      for (const JointId joint : world.joints()) {
        CHECK(std::abs(world.reading(joint).position[0]) < 0.41);
        CHECK(world.reading(joint).gap < 1e-6);
      }
    }
  // At its bound it presses with its full force, and holds against less.
  World world(weightless);
  const BodyId bar = add_box(world, Vec3(0.2, 0, 0), Vec3(0.2, 0.05, 0.05), 2);
  const JointId hinge = join(world, {}, bar, Vec3(0, 0, 0), HingeJoint{Limits{-1, 0.3}, Motor{2, {}, 5, 1, 6}});
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  CHECK(world.reading(hinge).position[0] == doctest::Approx(0.3).epsilon(1e-6));
  for (int i = 0; i < 60; ++i) {
    world.apply_torque(bar, Vec3(0, 0, -5.9));
    world.step(1.0 / 60);
  }
  CHECK(world.reading(hinge).position[0] == doctest::Approx(0.3).epsilon(1e-6));
  const double moment = world.mass(bar).inertia(2, 2) + 2 * 0.2 * 0.2;
  for (int i = 0; i < 10; ++i) {
    world.apply_torque(bar, Vec3(0, 0, -6.5));
    world.step(1.0 / 60);
  }
  CHECK(world.reading(hinge).rate[0] == doctest::Approx(-0.5 / moment * 10 / 60).epsilon(1e-4));
}

}  // namespace tweenfall::jointed
