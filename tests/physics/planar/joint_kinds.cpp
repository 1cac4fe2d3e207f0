#include <tweenfall/physics/planar_world.h>
#include <tweenfall/physics/world.h>

#include <cmath>
#include <limits>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double beat = 1.0 / 240, ever = std::numeric_limits<double>::infinity();
/// Along z, as the x axis of a hinge.
const Quat to_us(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);

template <class AnyWorld>
void pass(AnyWorld& world, double seconds) {
  for (double n = std::round(seconds / beat); n > 0; --n) world.step(beat);
}

/// How a damped spring of frequency w and damping ratio z goes from 1 to 0, starting at rest.
double settling(double w, double z, double t) {
  if (z == 1) return (1 + w * t) * std::exp(-w * t);
  const double wd = w * std::sqrt(1 - z * z);
  return std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
}

/// The same scene in space and in a plane: only the plane differs.
template <class Build>
void compare(const Build& build, double seconds, double within) {
  World space({.gravity = Vec3(0, -9.81, 0), .sleep_after = ever});
  World flat({.gravity = Vec3(0, -9.81, 0), .sleep_after = ever, .plane = WorldPlane::xy});
  const auto [body, joint] = build(space);
  static_cast<void>(build(flat));
  for (double n = std::round(seconds / beat); n > 0; --n) {
    space.step(beat);
    flat.step(beat);
    REQUIRE(near(flat.motion(body).pose.position, space.motion(body).pose.position, within));
    REQUIRE(near(flat.reading(joint).position[0], space.reading(joint).position[0], within));
  }
  CHECK(near(flat.reading(joint).force, space.reading(joint).force, 0.02 * space.reading(joint).force.norm() + 0.05));
  CHECK(
      near(flat.reading(joint).torque, space.reading(joint).torque, 0.02 * space.reading(joint).torque.norm() + 0.02));
}

}  // namespace

TEST_CASE("in a plane what slides down a tilted line does so by g sin, turns not, and bears g cos and the torque") {
  planar::World world({.sleep_after = ever});
  const double tilt = 0.4;
  planar::BodySettings cart{.shape = {planar::Box{Vec2(0.2, 0.1)}}, .mass = 3.0};
  const BodyId body = world.add(cart);
  // Held off its center, by 0.15 m along the line.
  const Vec2 axis(std::cos(tilt), -std::sin(tilt));
  const JointId joint =
      world.add_joint({.b = body, .anchor_a = 0.15 * axis, .anchor_b = 0.15 * axis, .kind = planar::Slider{5 * axis}});
  pass(world, 1);
  const double way = 0.5 * 9.81 * std::sin(tilt);
  CHECK(near(world.motion(body).position, Vec2(way * axis), 0.03));
  CHECK(near(world.reading(joint).value, way, 0.03));
  CHECK(near(world.reading(joint).rate, 9.81 * std::sin(tilt), 1e-6));
  CHECK(std::abs(world.motion(body).angle) < 1e-9);
  CHECK(world.reading(joint).gap < 1e-5);
  // The line pushes at the point, 0.15 m from the center: a torque holds the cart against that.
  const Vec2 across(std::sin(tilt), std::cos(tilt));
  const double load = 3 * 9.81 * std::cos(tilt);
  CHECK(near(Vec2(world.reading(joint).impulse / beat), Vec2(load * across), 1e-6));
  CHECK(near(world.reading(joint).angular_impulse / beat, -0.15 * load, 1e-6));
}

TEST_CASE("in a plane a motor draws a slider and a hinge to a place as a damped spring of the mass that moves") {
  for (const double zeta : {1.0, 0.2}) {
    planar::World world({.gravity = {0, 0}, .sub_steps = 16, .sleep_after = ever});
    const BodyId sled = world.add({.shape = {planar::Circle{0.2}}, .mass = 2.0});
    planar::BodySettings rod{.shape = {planar::Box{Vec2(0.5, 0.05)}}, .mass = 2.0, .motion = {.position = {0.5, 3}}};
    const BodyId arm = world.add(rod);
    const JointId slide =
        world.add_joint({.b = sled, .kind = planar::Slider{.motor = Motor{.position = 1.0, .hz = 1.5, .zeta = zeta}}});
    // About its end: the spring accounts for the rod's moment of inertia there.
    const JointId turn =
        world.add_joint({.b = arm,
                         .anchor_a = {0, 3},
                         .anchor_b = {-0.5, 0},
                         .kind = planar::Hinge{.motor = Motor{.position = 0.5, .hz = 1.5, .zeta = zeta}}});
    for (int n = 0; n < 5; ++n) {
      pass(world, 0.1);
      const double part = 1 - settling(2 * pi * 1.5, zeta, world.time());
      CAPTURE(world.time());
      CHECK(near(world.reading(slide).value, part, 1e-2));
      CHECK(near(world.reading(turn).value, 0.5 * part, 1e-2));
    }
    CHECK(world.reading(turn).gap < 1e-3);
  }
  // Against gravity it yields by g / w^2, and carries the weight.
  planar::World world;
  const BodyId lift = world.add({.shape = {planar::Circle{0.2}}, .mass = 2.0});
  const JointId joint =
      world.add_joint({.b = lift, .kind = planar::Slider{.axis = {0, 1}, .motor = Motor{.position = 0.0, .hz = 2}}});
  pass(world, 3);
  const double w = 2 * pi * 2;
  CHECK(near(world.reading(joint).value, -9.81 / (w * w), 1e-4));
  CHECK(near(world.reading(joint).impulse.y() / beat, 2 * 9.81, 1e-4));
  CHECK(world.asleep(lift));
}

TEST_CASE("in a plane a motor that may push by so much lifts by what is left, and a speed is reached") {
  planar::World world({.sleep_after = ever});
  const BodyId lift = world.add({.shape = {planar::Circle{0.2}}, .mass = 2.0});
  world.add_joint(
      {.b = lift,
       .kind = planar::Slider{
           .axis = {0, 1}, .limits = Limits{-1, 2}, .motor = Motor{.speed = 1.5, .max_force = 2 * (9.81 + 2)}}});
  pass(world, 0.5);
  CHECK(near(world.motion(lift).velocity.y(), 1, 1e-6));
  pass(world, 0.5);
  CHECK(near(world.motion(lift).velocity.y(), 1.5, 1e-6));
  pass(world, 3);
  CHECK(near(world.motion(lift).position.y(), 2, 1e-3));
}

TEST_CASE("in a plane springs hang, swing and settle as their closed forms say, and none is too stiff") {
  planar::World world({.sleep_after = ever});
  const auto hung = [&](double x, const planar::Spring& spring, double y) {
    const BodyId ball = world.add({.shape = {planar::Circle{0.1}}, .mass = 2.0, .motion = {.position = Vec2(x, y)}});
    return world.add_joint({.b = ball, .anchor_a = {x, 0}, .kind = spring});
  };
  // At rest it is m g / k below its length; released there, it stays.
  const JointId still = hung(0, {0.7, 130, 0}, -0.7 - 2 * 9.81 / 130);
  const JointId swinging = hung(2, {1, 80, 0}, -1), damped = hung(4, {1, 80, 2 * std::sqrt(160.0)}, -1);
  const JointId stiff = hung(6, {0.5, 1e12, 0}, -0.5), pulled = hung(8, {0, 80, 3}, -0.3);
  const double w = std::sqrt(80 / 2.0), sag = 9.81 / (w * w);
  for (int n = 1; n <= 480; ++n) {
    world.step(beat);
    REQUIRE(near(world.reading(still).value, 0.7 + 2 * 9.81 / 130, 1e-9));
    REQUIRE(near(world.reading(stiff).value, 0.5, 1e-6));
    // Springs use the end of each sub-step, so that the swing decays by exp(-w^2 h t / 2).
    const double fading = std::exp(-w * w * beat / 4 * n * beat / 2);
    REQUIRE(near(world.reading(swinging).value, 1 + sag * (1 - fading * std::cos(w * n * beat)), 0.01 * sag + 2e-3));
    REQUIRE(near(world.reading(damped).value, 1 + sag * (1 - settling(w, 1, n * beat)), 1e-3));
  }
  CHECK(near(world.reading(still).impulse.y() / beat, 2 * 9.81, 1e-6));
  pass(world, 20);
  CHECK(near(world.reading(pulled).value, sag, 1e-6));
  CHECK_THROWS_AS(hung(9, {1, -1, 0}, 0), std::invalid_argument);
}

TEST_CASE("in a plane two that a spring joins swing about their center of mass, which stays, and turn by its lever") {
  World world({.gravity = Vec3(0, 0, 0), .sleep_after = ever, .plane = WorldPlane::xy});
  BodySettings body{.shape = {Box{Vec3(0.3, 0.1, 0.2)}}, .mass = 1.0};
  const BodyId a = world.add(body);
  body.mass = 3;
  body.motion.pose.position = Vec3(2, 0, 0);
  const BodyId b = world.add(body);
  const JointId spring = world.add_joint({.a = a,
                                          .b = b,
                                          .frame_a = {.position = Vec3(0, 0.1, 0)},
                                          .frame_b = {.position = Vec3(0, 0.1, 0)},
                                          .kind = SpringJoint{1.8, 30, 0}});
  world.step(beat);
  const double inertia = (0.36 + 0.04) / 12, force = 30 * 0.2;
  CHECK(near(world.twist(a).linear.x(), force * beat, 0.01 * force * beat));
  CHECK(near(world.twist(a).angular.z(), -0.1 * force * beat / inertia, 0.02 * 0.1 * force * beat / inertia));
  CHECK(near(world.reading(spring).force.x(), -force, 0.02 * force));
  for (int n = 0; n < 480; ++n) {
    world.step(beat);
    REQUIRE(near(Vec3(world.twist(a).linear + 3 * world.twist(b).linear), Vec3(0, 0, 0), 1e-12));
  }
}

TEST_CASE("in a plane limits give way as springs do, of a hinge, a slider and a distance") {
  planar::World world;
  const double w = 2 * pi * 3, give = 9.81 / (w * w);
  const BodyId slid = world.add({.shape = {planar::Circle{0.1}}, .mass = 2.0});
  const BodyId hung = world.add({.shape = {planar::Circle{0.1}}, .mass = 2.0, .motion = {.position = Vec2(5, -1)}});
  const JointId slide =
      world.add_joint({.b = slid, .kind = planar::Slider{.axis = {0, 1}, .limits = Limits{-0.2, 1, 3, 1}}});
  const JointId rope = world.add_joint({.b = hung, .anchor_a = {5, 0}, .kind = planar::Distance{{0, 1, 3, 1}}});
  // A rod that lies on its stop: m g l = k a, and k = I w^2 about the hinge.
  const BodyId rod =
      world.add({.shape = {planar::Box{Vec2(0.5, 0.05)}}, .mass = 2.0, .motion = {.position = Vec2(10.5, 0)}});
  const JointId stop = world.add_joint(
      {.b = rod, .anchor_a = {10, 0}, .anchor_b = {-0.5, 0}, .kind = planar::Hinge{.limits = Limits{0, 1, 3, 1}}});
  pass(world, 3);
  CHECK(near(world.reading(slide).value, -0.2 - give, 1e-6));
  CHECK(near(world.reading(rope).value, 1 + give, 1e-6));
  const double inertia = 2 * (1 + 0.01) / 12 + 2 * 0.25;
  double angle = 0;
  for (int n = 0; n < 50; ++n) angle = -2 * 9.81 * 0.5 * std::cos(angle) / (inertia * w * w);
  CHECK(near(world.reading(stop).value, angle, 1e-5));
  CHECK(near(world.reading(stop).angular_impulse / beat, 2 * 9.81 * 0.5 * std::cos(angle), 1e-3));
}

TEST_CASE("in a plane sliders, motors, soft limits and hinges do what they do in space") {
  const auto box = [](const Vec3& place) {
    BodySettings body{.shape = {Box{Vec3(0.3, 0.1, 0.1)}}, .mass = 2.0};
    body.motion.pose.position = place;
    return body;
  };
  const auto both = [](World& world, const BodyId& body, const JointKind& kind, const Pose& on_b = {}) {
    return std::pair(
        body, world.add_joint({.b = body, .frame_a = {.rotation = on_b.rotation}, .frame_b = on_b, .kind = kind}));
  };
  const Quat slope(std::cos(0.15), 0, 0, -std::sin(0.15));
  compare(
      [&](World& world) {
        return both(world, world.add(box(Vec3(0, 0, 0))),
                    SliderJoint{Limits{-1, 0.4}, Motor{.speed = 0.2, .max_force = 3}}, {.rotation = slope});
      },
      2, 2e-3);
  compare(
      [&](World& world) {
        return both(world, world.add(box(Vec3(0.3, 0, 0))),
                    HingeJoint{{}, Motor{.position = 0.8, .hz = 2, .zeta = 0.3}},
                    {.position = Vec3(-0.3, 0, 0), .rotation = to_us});
      },
      2, 1e-2);
  compare(
      [&](World& world) {
        return both(world, world.add(box(Vec3(0.3, 0, 0))), HingeJoint{Limits{-0.4, 1, 4, 0.3}},
                    {.position = Vec3(-0.3, 0, 0), .rotation = to_us});
      },
      2, 1e-2);
}

TEST_CASE("in a plane a weld breaks by the torque that it bears, m g l, and no sooner") {
  for (const double most : {9.0, 11.0}) {
    World world({.sleep_after = ever, .plane = WorldPlane::xy});
    BodySettings shelf{.shape = {Box{Vec3(0.5, 0.05, 0.05)}}, .mass = 2.0};
    shelf.motion.pose.position = Vec3(0.5, 0, 0);
    const BodyId body = world.add(shelf);
    // 2 kg at 0.5 m: 9.81 N m.
    const JointId joint = world.add_joint(
        {.b = body, .frame_b = {.position = Vec3(-0.5, 0, 0)}, .kind = FixedJoint{}, .break_torque = most});
    pass(world, 0.5);
    CHECK(world.contains(joint) == (most > 10));
    if (world.contains(joint)) CHECK(near(world.reading(joint).torque, Vec3(0, 0, 9.81), 1e-3));
    if (world.contains(joint)) CHECK(near(world.reading(joint).force, Vec3(0, 2 * 9.81, 0), 1e-3));
  }
}

TEST_CASE("in a plane a body under a steady force falls asleep, and wakes when the force is another or gone") {
  planar::World world;
  world.add({.shape = {planar::HalfPlane{}}, .fixed = true});
  const BodyId box = world.add({.shape = {planar::Box{}}, .mass = 2.0, .motion = {.position = Vec2(0, 0.5)}});
  const auto pushed = [&](double force, double seconds) {
    for (double n = std::round(seconds / beat); n > 0; --n) {
      world.apply_force(box, Vec2(force, 0), Vec2(0, 0.5));
      world.step(beat);
    }
  };
  pushed(4, 2);  // friction holds up to 9.81 N
  CHECK(world.asleep(box));
  pushed(4, 1);
  CHECK(world.asleep(box));
  const std::uint64_t before = world.state_hash();
  planar::World copy;
  copy.load(world.save());
  CHECK(copy.state_hash() == before);
  pushed(12, 0.1);
  CHECK_FALSE(world.asleep(box));
  CHECK(world.motion(box).velocity.x() > 0.1);
  pushed(4, 3);
  CHECK(world.asleep(box));
  world.step(beat);
  CHECK_FALSE(world.asleep(box));
  // A body pulled by a small force in the air starts slowly, and is not at rest.
  planar::World air({.gravity = {0, 0}});
  const BodyId leaf = air.add({.mass = 1.0});
  for (int n = 0; n < 480; ++n) {
    air.apply_force(leaf, Vec2(0.01, 0), Vec2(0, 0));
    air.step(beat);
  }
  CHECK_FALSE(air.asleep(leaf));
  CHECK(near(air.motion(leaf).position.x(), 0.5 * 0.01 * 4, 1e-9));
}

TEST_CASE("in a plane of space what a wind and a spring hold still falls asleep, and wakes when one goes") {
  World world({.plane = WorldPlane::xy});
  world.add({.shape = {Plane{}}, .fixed = true});
  BodySettings settings{.shape = {Box{Vec3(0.5, 0.5, 0.5)}}, .mass = 2.0};
  settings.motion.pose.position = Vec3(0, 0.5, 0);
  const BodyId box = world.add(settings);
  settings.motion.pose.position = Vec3(0, 1.5, 0);
  const BodyId top = world.add(settings);
  const std::size_t wind = world.add_force(Wind{.velocity = Vec3(2, 0, 0), .linear = 1});
  world.add_force(Spring{.a = box, .anchor_b = Vec3(-1, 0.5, 0), .rest_length = 0.9, .stiffness = 30});
  pass(world, 3);
  CHECK(world.asleep(box));
  CHECK(world.asleep(top));
  World loaded;
  loaded.load(world.save());
  pass(world, 1);
  pass(loaded, 1);
  CHECK(world.asleep(box));
  CHECK(loaded.asleep(box));
  CHECK(world.state_hash() == loaded.state_hash());
  const Vec3 place = world.motion(box).pose.position;
  // A blow on the upper one wakes both; the wind and the spring still act on them.
  world.apply_impulse(top, Vec3(0, 1, 0), Vec3(0, 1.5, 0));
  world.step(beat);
  CHECK_FALSE(world.asleep(box));
  pass(world, 3);
  CHECK(world.asleep(box));
  CHECK(near(world.motion(box).pose.position, place, 1e-3));
  world.remove_force(wind);
  world.step(beat);
  CHECK_FALSE(world.asleep(box));
}
