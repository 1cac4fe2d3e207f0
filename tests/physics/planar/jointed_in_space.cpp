#include <tweenfall/physics/world.h>

#include <cmath>
#include <limits>

#include "physics/saved_bytes.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double tick = 1.0 / 240, g_there = 9.81;
/// Along z, as the x axis of a hinge.
const Quat out_of_plane(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);

World upright_plane(WorldPlane plane = WorldPlane::xy) {
  const Vec3 down = plane == WorldPlane::xy ? Vec3(0, -g_there, 0) : Vec3(0, 0, -g_there);
  return World({.gravity = down, .sleep_after = std::numeric_limits<double>::infinity(), .plane = plane});
}

BodyId bob_at(World& world, const Vec3& place, double mass = 1) {
  BodySettings body{.shape = {Sphere{0.1}}, .mass = mass};
  body.motion.pose.position = place;
  return world.add(body);
}

void swing_on(World& world, double seconds) {
  for (double n = std::round(seconds / tick); n > 0; --n) world.step(tick);
}

/// Period of a physical pendulum of length l: a ball of radius 0.1, that swings by at most `amplitude`.
double period_of(double l, double amplitude) {
  const double square = l * l + 0.4 * 0.01, k = std::sin(amplitude / 2);
  // 2 pi sqrt(I / (m g l)) times 1 / agm(1, cos(a / 2))
  double a = 1, b = std::sqrt(1 - k * k);
  for (int n = 0; n < 30; ++n) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * pi * std::sqrt(square / (g_there * l)) / a;
}

}  // namespace

TEST_CASE("in a plane a bob on a ball joint is a physical pendulum, and on a rod and a rope keeps its distance") {
  for (const WorldPlane plane : {WorldPlane::xy, WorldPlane::yz}) {
    World world = upright_plane(plane);
    const Vec3 up = plane == WorldPlane::xy ? Vec3::UnitY() : Vec3::UnitZ();
    const Vec3 side = plane == WorldPlane::xy ? Vec3::UnitX() : Vec3::UnitY();
    const double amplitude = 1;
    const Vec3 start = std::sin(amplitude) * side - std::cos(amplitude) * up;
    const BodyId bob = bob_at(world, start);
    const JointId joint = world.add_joint({.b = bob, .frame_b = {.position = -start}});
    double crossed = 0, before = 0;
    int crossings = 0;
    while (crossings < 5 && world.time() < 20) {
      before = world.motion(bob).pose.position.dot(side);
      world.step(tick);
      const double now = world.motion(bob).pose.position.dot(side);
      if ((before > 0) == (now > 0)) continue;
      crossed = world.time() - tick * now / (now - before);
      ++crossings;
    }
    // A quarter of a period to the first crossing, and half a period to each later one.
    CHECK(near(crossed, 2.25 * period_of(1, amplitude), 2e-3));
    CHECK(world.reading(joint).gap < 1e-3);
    CHECK(world.motion(bob).pose.position.dot(up.cross(side)) == 0);
  }
  World world = upright_plane();
  const BodyId rod = bob_at(world, Vec3(1, 0, 0)), rope = bob_at(world, Vec3(5.5, 0, 0));
  const JointId held = world.add_joint({.b = rod, .kind = DistanceJoint{{1, 1}}});
  world.add_joint({.b = rope, .frame_a = {.position = Vec3(5, 0, 0)}, .kind = DistanceJoint{{0, 1}}});
  swing_on(world, 0.25);
  // A slack rope does not affect its bob.
  CHECK(near(world.twist(rope).linear, Vec3(0, -g_there * 0.25, 0), 1e-9));
  swing_on(world, 2);
  CHECK(near(world.motion(rod).pose.position.norm(), 1, 2e-3));
  CHECK((world.motion(rope).pose.position - Vec3(5, 0, 0)).norm() < 1.002);
  CHECK(world.reading(held).coordinates == 1);
  CHECK(near(world.reading(held).position[0], world.motion(rod).pose.position.norm(), 1e-12));
}

TEST_CASE("in a plane a hinge's limits stop it, its motor reaches its speed, and its angle counts whole turns") {
  for (const double sign : {1.0, -1.0}) {
    const Quat axis = sign > 0 ? out_of_plane : Quat(std::sqrt(0.5), 0, std::sqrt(0.5), 0);
    REQUIRE(near(axis * Vec3(1, 0, 0), Vec3(0, 0, sign), 1e-12));
    World world(
        {.gravity = {0, 0, 0}, .sleep_after = std::numeric_limits<double>::infinity(), .plane = WorldPlane::xy});
    const BodyId arm = world.add({.shape = {Box{Vec3(0.5, 0.05, 0.05)}}, .mass = 2.0});
    const JointId joint = world.add_joint({.b = arm,
                                           .frame_a = {.rotation = axis},
                                           .frame_b = {.rotation = axis},
                                           .kind = HingeJoint{{}, Motor{.speed = 3, .max_force = 5}}});
    swing_on(world, 4);
    CHECK(near(world.twist(arm).angular, Vec3(0, 0, 3 * sign), 1e-6));
    const double turned = world.reading(joint).position[0];
    CHECK(turned > 11);
    CHECK(turned < 12);
    // From here on it may turn back, by at most to -0.5 rad.
    world.set_joint(joint, HingeJoint{Limits{-0.5, 20}, Motor{.speed = -8, .max_force = 50}});
    swing_on(world, 4);
    CHECK(near(world.reading(joint).position[0], -0.5, 5e-3));
    CHECK(std::abs(world.twist(arm).angular.z()) < 1e-2);
  }
}

TEST_CASE("in a plane a weld holds bodies as they were, and a joint breaks that bears more than it may") {
  World world = upright_plane();
  world.add({.shape = {Plane{}}, .fixed = true});
  BodySettings half{.shape = {Box{Vec3(0.3, 0.1, 0.1)}}, .mass = 1.0};
  half.motion.pose = {Vec3(0, 1, 0), Quat(std::cos(0.2), 0, 0, std::sin(0.2)), Vec3(1, 1, 1)};
  const BodyId a = world.add(half);
  half.motion.pose = {Vec3(0.5, 1.2, 0), Quat(std::cos(0.7), 0, 0, std::sin(0.7)), Vec3(1, 1, 1)};
  const BodyId b = world.add(half);
  const Vec3 point(0.25, 1.1, 0);
  const auto on = [&](BodyId body) {
    const Pose pose = world.motion(body).pose;
    return Pose{pose.rotation.conjugate() * (point - pose.position), pose.rotation.conjugate(), Vec3(1, 1, 1)};
  };
  world.add_joint({.a = a, .b = b, .frame_a = on(a), .frame_b = on(b), .kind = FixedJoint{}});
  const auto angle_between = [&] {
    const Quat q = world.motion(a).pose.rotation.conjugate() * world.motion(b).pose.rotation;
    return 2 * std::atan2(q.z(), q.w());
  };
  CHECK(near(angle_between(), 1.0, 1e-9));
  swing_on(world, 2);
  CHECK(near(angle_between(), 1.0, 2e-2));
  CHECK(world.motion(b).pose.position.y() < 1);

  World hung = upright_plane();
  const BodyId light = bob_at(hung, Vec3(0, -1, 0)), heavy = bob_at(hung, Vec3(3, -1, 0), 10);
  const auto rope_to = [&](BodyId bob, double x) {
    return hung.add_joint(
        {.b = bob, .frame_a = {.position = Vec3(x, 0, 0)}, .kind = DistanceJoint{{0, 1}}, .break_force = 50});
  };
  const JointId holds = rope_to(light, 0), breaks = rope_to(heavy, 3);
  swing_on(hung, 0.5);
  CHECK(hung.contains(holds));
  CHECK(near(hung.reading(holds).force, Vec3(0, g_there, 0), 0.05));
  CHECK_FALSE(hung.contains(breaks));
  CHECK(near(hung.motion(light).pose.position, Vec3(0, -1, 0), 1e-3));
  CHECK(hung.motion(heavy).pose.position.y() < -2);
}

TEST_CASE("in a plane what is jointed goes on in the same bits after copies and saving, also when joints come and go") {
  World world = upright_plane();
  world.add({.shape = {Plane{Vec3(0, 1, 0), -3}}, .fixed = true});
  std::vector<BodyId> chain;
  std::vector<JointId> links;
  for (int i = 0; i < 6; ++i) {
    chain.push_back(bob_at(world, Vec3(0.4 * (i + 1), 0, 0)));
    links.push_back(world.add_joint({.a = i > 0 ? chain[static_cast<std::size_t>(i) - 1] : BodyId{},
                                     .b = chain.back(),
                                     .frame_a = {.position = i > 0 ? Vec3(0.2, 0, 0) : Vec3(0.2, 0, 0)},
                                     .frame_b = {.position = Vec3(-0.2, 0, 0)}}));
  }
  World relay = world;
  for (int n = 0; n < 240; ++n) {
    for (World* const one : {&world, &relay}) {
      if (n == 60) one->remove_joint(links[3]);
      if (n == 61) one->add_joint({.a = chain[0], .b = chain[5], .kind = DistanceJoint{{0, 3}}});
      if (n == 90) one->remove(chain[1]);
      one->step(tick);
    }
    World next;
    next.load(relay.save());
    relay = next;
    REQUIRE(relay.state_hash() == world.state_hash());
  }
  CHECK(relay.save() == world.save());
  CHECK_FALSE(world.contains(links[1]));
  CHECK(world.motion(chain[3]).pose.position.y() < -1);
}

TEST_CASE("saved planes with joints whose bytes were changed are refused or go on") {
  World world = upright_plane();
  const BodyId first = bob_at(world, Vec3(0.5, 0, 0)), second = bob_at(world, Vec3(1, 0, 0));
  world.add_joint({.b = first, .frame_b = {.position = Vec3(-0.5, 0, 0)}});
  world.add_joint({.a = first,
                   .b = second,
                   .frame_a = {.rotation = out_of_plane},
                   .frame_b = {.position = Vec3(-0.5, 0, 0), .rotation = out_of_plane},
                   .kind = HingeJoint{Limits{-1, 1}}});
  world.add_force(Drag{.linear = 0.1});
  swing_on(world, 0.1);
  const std::vector<std::byte> good = world.save();
  Random random(11);
  int taken = 0;
  for (int n = 0; n < 2000; ++n) {
    std::vector<std::byte> bad = good;
    const auto at = header + static_cast<std::size_t>(random.unit() * static_cast<double>(bad.size() - header - 8));
    put(bad, at, n % 3 == 0 ? ~std::uint64_t{0} : n % 3 == 1 ? 1 : 0x7ff8000000000000u, n % 2 == 0 ? 4 : 8);
    seal(bad);
    World other;
    try {
      other.load(bad);
      other.step(tick);
      ++taken;
    } catch (const std::exception&) {
    }
  }
  CHECK(taken > 0);
  CHECK(taken < 2000);
}
