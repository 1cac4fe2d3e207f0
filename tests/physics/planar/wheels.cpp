#include <tweenfall/physics/planar_world.h>
#include <tweenfall/physics/vehicle.h>
#include <tweenfall/physics/world.h>

#include <cmath>
#include <limits>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double short_step = 1.0 / 240, weight = 9.81, wheels_awake = std::numeric_limits<double>::infinity();

/// Along z, as the x axis of a wheel's frame, with y up.
const Quat axle(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);

template <class World>
void roll_on(World& world, double seconds) {
  for (double n = std::round(seconds / short_step); n > 0; --n) world.step(short_step);
}

struct Car {
  BodyId chassis, front, back;
  JointId joints[2];
};

/// Balls as wheels: in a plane they have the moments that they have in space.
Car add_car(World& world, const Motor& motor) {
  BodySettings body{.shape = {Box{Vec3(1, 0.2, 0.3)}}, .mass = 100.0};
  body.motion.pose.position = Vec3(0, 0.7, 0);
  Car car;
  car.chassis = world.add(body);
  BodySettings wheel{.shape = {Sphere{0.3}}, .mass = 10.0, .friction = 1};
  int n = 0;
  for (const double x : {-0.8, 0.8}) {
    wheel.motion.pose.position = Vec3(x, 0.3, 0);
    const BodyId id = (n == 0 ? car.back : car.front) = world.add(wheel);
    car.joints[n++] = world.add_joint({.a = car.chassis,
                                       .b = id,
                                       .frame_a = {.position = Vec3(x, -0.4, 0), .rotation = axle},
                                       .frame_b = {.rotation = axle},
                                       .kind = WheelJoint{.hz = 3, .zeta = 0.7, .motor = motor}});
  }
  return car;
}

World ground_world(WorldPlane plane, double tilt = 0) {
  World world(
      {.gravity = weight * Vec3(-std::sin(tilt), -std::cos(tilt), 0), .sleep_after = wheels_awake, .plane = plane});
  world.add({.shape = {Plane{}}, .friction = 1, .fixed = true});
  return world;
}

}  // namespace

TEST_CASE("in a plane a wheel hangs on its spring, swings at its rate, stays on its line and turns freely") {
  for (const double slant : {0.0, 0.6}) {
    const Vec2 line(std::sin(slant), std::cos(slant)), down = -weight * line;
    planar::World world({.gravity = down, .sub_steps = 8, .sleep_after = wheels_awake});
    const BodyId wheel =
        world.add({.shape = {planar::Circle{0.3}}, .mass = 3.0, .motion = {.position = Vec2(1, 2), .spin = 5}});
    const JointId joint = world.add_joint(
        {.b = wheel, .anchor_a = Vec2(1, 2), .kind = planar::Wheel{.axis = 7 * line, .hz = 1, .zeta = 0}});
    // From rest at 0 it swings about its sag, g / (2 pi hz)^2, as a cosine.
    const double sag = weight / (4 * pi * pi);
    roll_on(world, 0.5);
    CHECK(near(world.reading(joint).way, -2 * sag, 0.02 * sag));
    CHECK(near(world.motion(wheel).position, Vec2(1, 2) + world.reading(joint).way * line, 1e-4));
    CHECK(near(world.reading(joint).rate, 5, 1e-12));
    CHECK(near(world.reading(joint).value, 2.5, 1e-12));
    roll_on(world, 0.5);
    CHECK(std::abs(world.reading(joint).way) < 0.08 * sag);
    CHECK(world.reading(joint).gap < 1e-4);
  }
  // Damped, it rests at its sag, and a stop holds it before that.
  for (const double stop : {1.0, 0.1}) {
    planar::World world({.sleep_after = wheels_awake});
    const BodyId wheel = world.add({.shape = {planar::Circle{0.3}}, .mass = 3.0});
    const JointId joint =
        world.add_joint({.b = wheel, .kind = planar::Wheel{.hz = 1, .zeta = 1, .suspension = Limits{-stop, stop}}});
    roll_on(world, 4);
    CHECK(near(world.reading(joint).way, -std::min(stop, weight / (4 * pi * pi)), 1e-3));
    CHECK(near(world.reading(joint).impulse, Vec2(0, 3 * weight * short_step), 1e-6));
  }
}

TEST_CASE("in a plane a car on two wheels rolls at the speed of its motors, climbs, and does as it does in space") {
  // What turns the wheels clockwise drives to the right.
  const Motor motor{.speed = -10, .max_force = 40};
  for (const double tilt : {0.0, 0.15}) {
    World flat = ground_world(WorldPlane::xy, tilt), space = ground_world(WorldPlane::none, tilt);
    const Car car = add_car(flat, motor), other = add_car(space, motor);
    roll_on(flat, 5);
    roll_on(space, 5);
    const Motion moved = flat.motion(car.chassis), wanted = space.motion(other.chassis);
    CHECK(moved.pose.position.z() == 0);
    CHECK(near(moved.pose.position, wanted.pose.position, 5e-3));
    // By then it has its speed, and its wheels roll: v = w r.
    const double speed = flat.twist(car.chassis).linear.x();
    if (tilt == 0) CHECK(near(speed, 3, 1e-3));
    CHECK(speed > 1);
    CHECK(near(flat.twist(car.front).angular.z() * -0.3, speed, 0.02));
    for (int n = 0; n < 2; ++n) {
      const JointReading here = flat.reading(car.joints[n]), there = space.reading(other.joints[n]);
      CHECK(here.coordinates == 2);
      CHECK(near(here.position[0], there.position[0], 5e-3));
      CHECK(near(here.position[1], there.position[1], 2e-3));
      CHECK(here.gap < 1e-3);
    }
  }
}

TEST_CASE("in a plane worlds with wheels keep their bits in copies and in bytes") {
  World world = ground_world(WorldPlane::xy);
  const Car car = add_car(world, {.speed = -8, .max_force = 60});
  roll_on(world, 1);
  World copy = world, loaded;
  loaded.load(world.save());
  for (World* one : {&world, &copy, &loaded}) {
    one->set_joint(car.joints[0], WheelJoint{.hz = 2, .suspension = Limits{-0.1, 0.1}});
    roll_on(*one, 1);
  }
  CHECK(copy.state_hash() == world.state_hash());
  CHECK(loaded.state_hash() == world.state_hash());
}

TEST_CASE("in a plane a vehicle with struts and tyres stops after v^2 / (2 mu g)") {
  for (const double grip : {0.5, 0.9}) {
    World world = ground_world(WorldPlane::xy);
    BodySettings body{.shape = {Box{Vec3(1, 0.2, 0.3)}}, .mass = 1000.0};
    body.motion.pose.position = Vec3(0, 0.7, 0);
    const BodyId chassis = world.add(body);
    VehicleSettings settings{.chassis = chassis};
    for (const double x : {-0.8, 0.8})
      settings.wheels.push_back({.mount = Vec3(x, 0, 0), .radius = 0.3, .rest_length = 0.5, .grip = grip});
    Vehicle car(settings);
    const auto go = [&](double seconds) {
      for (double n = std::round(seconds / short_step); n > 0; --n) {
        car.act(world, short_step);
        world.step(short_step);
      }
    };
    go(3);
    for (std::size_t i = 0; i < 2; ++i) car.control(i, {.brake = 1e6});
    Motion motion = world.motion(chassis);
    motion.twist.linear = Vec3(15, 0, 0);
    world.set_motion(chassis, motion);
    go(6);
    CHECK(std::abs(world.twist(chassis).linear.x()) < 1e-3);
    CHECK(
        near(world.motion(chassis).pose.position.x() - motion.pose.position.x(), 15 * 15 / (2 * grip * weight), 1e-2));
    CHECK(world.motion(chassis).pose.position.z() == 0);
  }
}
