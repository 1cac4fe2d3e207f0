#include <tweenfall/physics/planar_world.h>
#include <tweenfall/physics/world.h>

#include <cmath>
#include <limits>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double geared_step = 1.0 / 240, awake_for_ever = std::numeric_limits<double>::infinity(),
                 pull_of_earth = 9.81;

template <class AnyWorld>
void run_on(AnyWorld& world, double seconds) {
  for (double n = std::round(seconds / geared_step); n > 0; --n) world.step(geared_step);
}

/// A frame whose x axis is perpendicular to xy, or points the other way.
Pose axle_along(double sign, const Vec3& place = Vec3(0, 0, 0)) {
  return {place, Quat(std::sqrt(0.5), 0, -sign * std::sqrt(0.5), 0), Vec3(1, 1, 1)};
}

}  // namespace

TEST_CASE("in a plane two on a rope over pulleys fall as Atwood's do, by whatever ratio, and none gains energy") {
  for (const double ratio : {1.0, 2.0, 0.4}) {
    planar::World world({.sleep_after = awake_for_ever});
    const auto ball = [&](double x, double mass) {
      return world.add({.shape = {planar::Circle{0.1}}, .mass = mass, .motion = {.position = Vec2(x, -4)}});
    };
    const BodyId a = ball(-1, 1.5), b = ball(1, 4);
    const JointId rope = world.add_joint(
        {.a = a, .b = b, .kind = planar::Pulley{.pulley_a = Vec2(-1, 0), .pulley_b = Vec2(1, 0), .ratio = ratio}});
    // Down by d at b, up by ratio d at a: (m_b + ratio^2 m_a) d'' = (m_b - ratio m_a) g; at b the rope carries the
    // rest.
    const double down = (4 - ratio * 1.5) * pull_of_earth / (4 + ratio * ratio * 1.5);
    const double seconds = 0.5;
    run_on(world, seconds);
    CAPTURE(ratio);
    CHECK(near(world.motion(b).velocity, Vec2(0, -down * seconds), 1e-9));
    CHECK(near(world.motion(a).velocity, Vec2(0, ratio * down * seconds), 1e-9));
    CHECK(near(world.reading(rope).value, 4 + 4 * ratio, 2e-5));
    CHECK(std::abs(world.reading(rope).rate) < 1e-9);
    CHECK(near(Vec2(world.reading(rope).impulse / geared_step), Vec2(0, 4 * (pull_of_earth - down)), 1e-6));
    const double fallen = 1.5 * (world.motion(a).position.y() + 4) + 4 * (world.motion(b).position.y() + 4);
    // Each sub-step moves by the speed at its end: this is half a sub-step ahead, and loses that much energy.
    const double ahead = 0.5 * down * seconds * geared_step / 4;
    CHECK(near(world.kinetic_energy() + pull_of_earth * fallen, -(4 - ratio * 1.5) * pull_of_earth * ahead, 1e-3));
  }
}

TEST_CASE("in a plane a pulley's rope goes slack, is caught by its length, and turns what it holds by the arm") {
  // Both are thrown up: the rope does not affect them, since it is slack.
  planar::World world({.sleep_after = awake_for_ever});
  const auto ball = [&](double x, const Vec2& velocity) {
    return world.add(
        {.shape = {planar::Circle{0.1}}, .mass = 1.0, .motion = {.position = Vec2(x, -2), .velocity = velocity}});
  };
  const BodyId a = ball(-1, Vec2(0, 2)), b = ball(1, Vec2(0, 3));
  const JointId rope = world.add_joint(
      {.a = a, .b = b, .kind = planar::Pulley{.pulley_a = Vec2(-1, 0), .pulley_b = Vec2(1, 0), .length = 4.0}});
  run_on(world, 0.25);
  CHECK(near(world.motion(a).velocity.y(), 2 - pull_of_earth * 0.25, 1e-9));
  CHECK(near(world.motion(b).velocity.y(), 3 - pull_of_earth * 0.25, 1e-9));
  CHECK(world.reading(rope).value < 4);
  run_on(world, 2);
  CHECK(near(world.reading(rope).value, 4, 1e-3));
  CHECK(world.reading(rope).gap < 1e-3);
  // From then on they only move relative to each other: their common motion is gone.
  CHECK(near(world.motion(a).velocity.y(), -world.motion(b).velocity.y(), 1e-6));

  // A beam on a hinge at one end, held at the other by a weight of half of its own: the moments about the hinge are
  // m g l / 2 and l (m / 2) g, and nothing moves.
  planar::World balance({.sleep_after = awake_for_ever});
  const BodyId beam = balance.add({.shape = {planar::Box{Vec2(0.5, 0.02)}}, .mass = 2.0, .moment = 2.0 / 12});
  const BodyId weight = balance.add({.shape = {planar::Circle{0.1}}, .mass = 1.0, .motion = {.position = Vec2(3, 0)}});
  balance.add_joint({.b = beam, .anchor_a = Vec2(-0.5, 0), .anchor_b = Vec2(-0.5, 0), .kind = planar::Hinge{}});
  const JointId over = balance.add_joint({.a = beam,
                                          .b = weight,
                                          .anchor_a = Vec2(0.5, 0),
                                          .kind = planar::Pulley{.pulley_a = Vec2(0.5, 2), .pulley_b = Vec2(3, 2)}});
  run_on(balance, 2);
  CHECK(near(balance.motion(beam).angle, 0, 1e-5));
  CHECK(near(balance.motion(weight).position, Vec2(3, 0), 1e-5));
  CHECK(near(Vec2(balance.reading(over).impulse / geared_step), Vec2(0, pull_of_earth), 1e-6));
}

TEST_CASE("in a plane gears turn by their ratio, weigh as I_a + ratio^2 I_b, and keep their energy") {
  for (const double ratio : {1.0 / 3, -2.5}) {
    planar::World world({.gravity = {0, 0}, .sleep_after = awake_for_ever});
    const auto wheel = [&](double x, double moment) {
      const BodyId body =
          world.add({.shape = {planar::Circle{0.3}}, .mass = 1.0, .moment = moment, .motion = {.position = {x, 0}}});
      world.add_joint({.b = body, .anchor_a = Vec2(x, 0), .kind = planar::Hinge{}});
      return body;
    };
    const BodyId a = wheel(0, 0.2), b = wheel(1, 0.7);
    const JointId gear = world.add_joint({.a = a, .b = b, .kind = planar::Gear{ratio}});
    const double torque = 1.5, together = 0.2 + ratio * ratio * 0.7;  // moment of inertia that a feels
    for (int n = 0; n < 480; ++n) {
      world.apply_torque(a, torque);
      world.step(geared_step);
    }
    const double spin = torque / together * 2, turned = 0.5 * spin * 2;
    CAPTURE(ratio);
    CHECK(near(world.motion(a).spin, spin, 1e-9));
    CHECK(near(world.motion(b).spin, -ratio * spin, 1e-9));
    CHECK(near(world.reading(gear).turned_a, turned, 0.01 * turned));
    CHECK(near(world.reading(gear).value, -ratio * world.reading(gear).turned_a, 1e-5));
    CHECK(near(world.reading(gear).value, world.motion(b).angle, 1e-9));
    // b is turned by the motion that it gains.
    CHECK(near(world.reading(gear).angular_impulse / geared_step, -ratio * 0.7 * torque / together, 1e-6));
    const double energy = world.kinetic_energy();
    CHECK(near(energy, torque * turned, 1e-6 * energy));
    run_on(world, 10);
    CHECK(near(world.kinetic_energy(), energy, 1e-9 * energy));
    CHECK(near(world.reading(gear).value, -ratio * world.reading(gear).turned_a, 1e-8));
  }
  planar::World world;
  const BodyId a = world.add({}), b = world.add({.motion = {.position = {5, 0}}});
  CHECK_THROWS_AS(world.add_joint({.a = a, .b = b, .kind = planar::Gear{0}}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = a, .b = b, .kind = planar::Gear{1, NAN}}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = a, .b = b, .kind = planar::Pulley{.ratio = -1}}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = a, .b = b, .kind = planar::Pulley{.pulley_a = {NAN, 0}}}),
                  std::invalid_argument);
}

TEST_CASE("a world's pulleys and gears are in a plane what they are in space, whichever way their axles point") {
  for (const double sign : {1.0, -1.0}) {
    World space({.gravity = Vec3(0, -pull_of_earth, 0), .sleep_after = awake_for_ever});
    World flat({.gravity = Vec3(0, -pull_of_earth, 0), .sleep_after = awake_for_ever, .plane = WorldPlane::xy});
    JointId gear, rope;
    BodyId small, large, load;
    for (World* const world : {&space, &flat}) {
      const auto wheel = [&](const Vec3& place, double radius, double way) {
        BodySettings body{.shape = {Sphere{radius}}, .mass = 10 * radius};
        body.motion.pose.position = place;
        const BodyId id = world->add(body);
        world->add_joint(
            {.b = id, .frame_a = axle_along(way, place), .frame_b = axle_along(way), .kind = HingeJoint{}});
        return id;
      };
      small = wheel(Vec3(0, 0, 0), 0.2, 1);
      large = wheel(Vec3(2, 0, 0), 0.5, sign);
      gear = world->add_joint(
          {.a = small, .b = large, .frame_a = axle_along(1), .frame_b = axle_along(sign), .kind = GearJoint{0.4}});
      BodySettings hung{.shape = {Sphere{0.1}}, .mass = 0.5};
      hung.motion.pose.position = Vec3(5, -2, 0);
      load = world->add(hung);
      // Over two pulleys from the rim of the large wheel.
      rope = world->add_joint({.a = large,
                               .b = load,
                               .frame_a = {.position = Vec3(0.5, 0, 0)},
                               .kind = PulleyJoint{.pulley_a = Vec3(2.5, 4, 0), .pulley_b = Vec3(5, 1, 0)}});
    }
    for (int n = 0; n < 60; ++n) {
      space.step(geared_step);
      flat.step(geared_step);
      for (const JointId joint : {gear, rope}) {
        REQUIRE(flat.reading(joint).coordinates == space.reading(joint).coordinates);
        for (std::size_t i = 0; i < 2; ++i) {
          REQUIRE(near(flat.reading(joint).position[i], space.reading(joint).position[i], 2e-3));
          REQUIRE(near(flat.reading(joint).rate[i], space.reading(joint).rate[i], 2e-2));
        }
      }
      REQUIRE(near(flat.motion(load).pose.position, space.motion(load).pose.position, 2e-3));
    }
    const JointReading turned = flat.reading(gear);
    CHECK(near(turned.position[1], -0.4 * turned.position[0], 1e-4));
    CHECK(std::abs(turned.position[1]) > 0.05);
    CHECK(near(flat.reading(rope).force, space.reading(rope).force, 0.02));
    CHECK(near(flat.reading(gear).torque, space.reading(gear).torque, 0.02));

    // The turned angles are kept when the gear gets its ratio again, and when the world is saved.
    flat.set_joint(gear, GearJoint{0.4});
    World loaded;
    loaded.load(flat.save());
    for (World* const world : {&flat, &loaded}) world->step(geared_step);
    CHECK(loaded.state_hash() == flat.state_hash());
    CHECK(near(flat.reading(gear).position[0], turned.position[0], 0.1));
    CHECK(near(flat.reading(gear).position[1], -0.4 * flat.reading(gear).position[0], 1e-4));
  }
}
