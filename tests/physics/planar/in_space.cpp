#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// For a plane: the axis along which gravity pulls down, the one along the ground, and the one across.
struct Way {
  WorldPlane plane;
  Vec3 along, up, across;
};
const std::vector<Way> ways{{WorldPlane::xy, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()},
                            {WorldPlane::xz, Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY()},
                            {WorldPlane::yz, Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()}};

World world_in(const Way& way, double sleep_after = 0.5) {
  World world({.gravity = -9.81 * way.up, .sleep_after = sleep_after, .plane = way.plane});
  world.add({.shape = {Plane{way.up, 0}}, .fixed = true});
  return world;
}

BodySettings at(const Solid& solid, const Vec3& position) {
  BodySettings body{.shape = {solid}};
  body.motion.pose.position = position;
  return body;
}

}  // namespace

TEST_CASE("a world in a plane moves its bodies as the plane does and leaves it by no bit") {
  for (const Way& way : ways) {
    World world = world_in(way);
    BodySettings ball = at(Sphere{0.5}, 5.5 * way.up);
    ball.restitution = 0.8;
    const BodyId bouncing = world.add(ball);
    std::vector<BodyId> heap;
    for (int i = 0; i < 12; ++i) {
      BodySettings body = at(i % 3 == 0   ? Solid(Box{Vec3(0.3, 0.2, 0.2)})
                             : i % 3 == 1 ? Solid(Sphere{0.25})
                                          : Solid(Box{Vec3(0.2, 0.2, 0.2)}),
                             (3 + 0.1 * (i % 2)) * way.along + (0.5 + 0.6 * i) * way.up);
      body.motion.twist.angular = 2 * way.across;
      heap.push_back(world.add(body));
    }
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    // From the blow at sqrt(2 h / g) on, with 0.8 of its speed.
    const double fall = std::sqrt(10 / 9.81);
    for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
    const double after = 1.5 - fall;
    CHECK(near(world.motion(bouncing).pose.position.dot(way.up) - 0.5,
               0.8 * 9.81 * fall * after - 0.5 * 9.81 * after * after, 1e-9));
    for (const BodyId body : heap) {
      const Motion motion = world.motion(body);
      CHECK(motion.pose.position.dot(way.across) == 0);
      CHECK(motion.twist.linear.dot(way.across) == 0);
      CHECK(motion.pose.rotation.vec().cross(way.across) == Vec3::Zero());
      CHECK(motion.twist.angular.cross(way.across) == Vec3::Zero());
      CHECK(motion.pose.position.dot(way.up) > 0);
    }
    CHECK_FALSE(world.contacts().empty());
    for (int i = 0; i < 600; ++i) world.step(1.0 / 60);
    CHECK(world.asleep(heap.back()));
  }
}

TEST_CASE(
    "in a plane a ball of space rolls as a ball, by 5/7 g (sin - c/r cos), and a spin turns it as the right hand "
    "says") {
  const double tilt = 0.3;
  for (const Way& way : ways) {
    const double resistance = &way == &ways[0] ? 0 : 0.02;
    World world({.gravity = 9.81 * (std::sin(tilt) * way.along - std::cos(tilt) * way.up),
                 .sleep_after = std::numeric_limits<double>::infinity(),
                 .plane = way.plane});
    BodySettings ground{.shape = {Plane{way.up, 0}}, .friction = 1, .fixed = true};
    world.add(ground);
    BodySettings ball = at(Sphere{0.5}, 0.5 * way.up);
    ball.friction = 1;
    ball.rolling_friction = resistance;
    const BodyId body = world.add(ball);
    for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
    const Motion motion = world.motion(body);
    CHECK(near(motion.twist.linear.dot(way.along),
               5.0 / 7 * 9.81 * (std::sin(tilt) - resistance / 0.5 * std::cos(tilt)) * 2, 1e-2));
    // It rolls: at the ground v + w x r is 0.
    const Vec3 slip = motion.twist.linear + motion.twist.angular.cross(-0.5 * way.up);
    CHECK(slip.norm() < 1e-3);
  }
}

TEST_CASE("in a plane a keyed body of space is where it shall be, turns on and on, and leaves with its velocity") {
  const Way& way = ways[0];
  World world = world_in(way);
  BodySettings arm = at(Box{Vec3(1, 0.1, 0.1)}, Vec3(0, 3, 0));
  arm.drive = Drive::keyed();
  const BodyId body = world.add(arm);
  const BodyId box = world.add(at(Box{}, Vec3(1, 0.5, 0)));
  Motion target;
  for (int i = 1; i <= 240; ++i) {
    const double angle = 5 * i / 60.0;
    target.pose.position = Vec3(0, 3, 0);
    target.pose.rotation = Quat(std::cos(angle / 2), 0, 0, std::sin(angle / 2));
    target.twist.angular = Vec3(0, 0, 5);
    world.set_target(body, target);
    world.step(1.0 / 60);
    REQUIRE(world.motion(body).pose.rotation.coeffs() == target.pose.rotation.coeffs());
  }
  CHECK(world.motion(box).pose.position.y() < 0.51);
  world.set_drive(body, Drive::free());
  world.step(1e-3);
  CHECK(near(world.twist(body).angular, Vec3(0, 0, 5), 1e-12));
}

TEST_CASE("a world in a plane is copied, saved and loaded to the same bits") {
  World world = world_in(ways[1]);
  std::vector<BodyId> bodies;
  for (int i = 0; i < 10; ++i)
    bodies.push_back(world.add(at(Box{Vec3(0.3, 0.3, 0.3)}, Vec3(0.05 * i, 0, 0.4 + 0.7 * i))));
  world.ignore(bodies[2], bodies[3]);
  for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
  World copy = world, loaded;
  loaded.load(world.save());
  for (World* one : {&world, &copy, &loaded}) {
    one->remove(bodies[4]);
    one->apply_impulse(bodies[7], Vec3(100, 0, 0), one->motion(bodies[7]).pose.position);
    for (int i = 0; i < 90; ++i) one->step(1.0 / 60);
  }
  CHECK(copy.state_hash() == world.state_hash());
  CHECK(loaded.state_hash() == world.state_hash());
  std::vector<std::byte> saved = world.save();
  CHECK(loaded.save() == saved);
}

TEST_CASE("what does not lie in a world's plane is refused in words") {
  using doctest::Contains;
  World world = world_in(ways[0]);
  const auto check = [&](const BodySettings& body, const char* words) {
    CHECK_THROWS_WITH_AS(world.add(body), Contains(words), std::invalid_argument);
  };
  check(at(Sphere{}, Vec3(0, 0, 1)), "the body does not lie in the world's plane, xy");
  BodySettings tilted = at(Box{}, Vec3(0, 0, 0));
  tilted.motion.pose.rotation = Quat(0.8, 0.6, 0, 0);
  check(tilted, "tilted out of the world's plane");
  tilted.motion = {};
  tilted.motion.twist.linear = Vec3(0, 0, 1);
  check(tilted, "moves out of the world's plane");
  tilted.motion.twist = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  check(tilted, "turns out of the world's plane");
  tilted.motion = {};
  tilted.shape.offset.rotation = Quat(0.8, 0.6, 0, 0);
  check(tilted, "a box cannot be cut by the world's plane");
  check(at(TaperedCapsule{}, Vec3(0, 0, 0)), "in a plane a body cannot be a tapered capsule");
  BodySettings floor{.shape = {Plane{Vec3(0, 0, 1), 0}}, .fixed = true};
  check(floor, "a plane cannot be cut");
  BodySettings sticky = at(Sphere{}, Vec3(0, 0, 0));
  sticky.spinning_friction = 0.1;
  check(sticky, "in a plane nothing spins about the normal of a contact: there is no spinning friction");
  CHECK_THROWS_WITH_AS(World({.plane = WorldPlane::xz}), Contains("gravity must lie in the world's plane, xz"),
                       std::invalid_argument);
  const BodyId a = world.add({}), b = world.add({});
  const auto refused = [&](const JointSettings& joint, const char* words) {
    CHECK_THROWS_WITH_AS(world.add_joint(joint), Contains(words), std::invalid_argument);
  };
  refused({.a = a, .b = b, .kind = UniversalJoint{}},
          "in a plane joints can only be balls, hinges, sliders, welds, distances, springs, pulleys, gears and wheels");
  refused({.a = a, .b = b, .kind = WheelJoint{}}, "in a plane the axis of a wheel must be perpendicular to it");
  refused({.a = a, .b = b, .kind = GearJoint{}}, "in a plane the axes of a gear must be perpendicular to it");
  refused({.a = a, .b = b, .kind = PulleyJoint{.pulley_b = Vec3(0, 1, 1)}}, "in a plane both pulleys must lie in it");
  const Quat upright(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);
  refused({.a = a, .b = b, .frame_a = {.rotation = upright}, .frame_b = {.rotation = upright}, .kind = SliderJoint{}},
          "in a plane the axis of a slider must lie in it");
  refused({.a = a, .b = b, .frame_a = {.rotation = upright}, .kind = SliderJoint{}}, "a slider must not tilt");
  refused({.a = a, .b = b, .kind = HingeJoint{}}, "in a plane the axis of a hinge must be perpendicular to it");
  refused({.a = a, .b = b, .frame_a = {.position = Vec3(0, 0, 1)}}, "in a plane the points of a joint must lie in it");
  refused({.a = a, .b = b, .frame_b = {.rotation = Quat(0.8, 0.6, 0, 0)}, .kind = FixedJoint{}}, "must not tilt");
}

TEST_CASE("a hull in a plane is the polygon that the plane cuts out of it") {
  World world = world_in(ways[0], std::numeric_limits<double>::infinity());
  std::vector<Vec3> points;
  for (const double z : {-0.4, 0.4})
    for (const Vec2& p : {Vec2(-0.6, -0.2), Vec2(0.6, -0.2), Vec2(0, 0.4)}) points.emplace_back(p.x(), p.y(), z);
  const BodyId wedge = world.add(at(Hull{ConvexHull(points)}, Vec3(0, 1, 0)));
  for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
  CHECK(near(world.motion(wedge).pose.position, Vec3(0, 0.2, 0), 5e-3));
}

TEST_CASE(
    "what leaves a plane takes its contacts along, they are told to have ended once, and what is left can be kept") {
  for (const Way& way : ways) {
    World world = world_in(way);
    const BodyId ball = world.add(at(Sphere{0.5}, 0.5 * way.up)),
                 box = world.add(at(Box{Vec3(0.5, 0.5, 0.5)}, 3 * way.along + 0.5 * way.up));
    for (int i = 0; i < 20; ++i) world.step(1.0 / 60);
    REQUIRE(world.contacts().size() == 2);
    world.remove(ball);
    REQUIRE(world.contacts().size() == 1);
    CHECK(world.contacts()[0].b == box);
    World again;
    again.load(world.save());
    for (World* one : {&world, &again}) {
      one->step(1.0 / 60);
      REQUIRE(one->ended_contacts().size() == 1);
      CHECK(one->ended_contacts()[0].b == ball);
      CHECK(one->contacts().size() == 1);
      one->step(1.0 / 60);
      CHECK(one->ended_contacts().empty());
    }
    CHECK(again.state_hash() == world.state_hash());
  }
}
