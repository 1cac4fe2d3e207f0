#include <tweenfall/physics/executor.h>
#include <tweenfall/physics/world.h>

#include <algorithm>

#include "support.h"

using namespace tweenfall;

namespace {

ConvexHull pointed_hull() {
  const std::vector<Vec3> points{{0.4, -0.3, 0.3}, {-0.4, -0.3, 0.35}, {0, -0.3, -0.4}, {0.05, 0.45, 0}};
  return ConvexHull(points);
}

/// A heap of every kind of body, chains of every strength, and keyed bodies that stir it.
struct Mixed {
  World world;
  std::vector<BodyId> heap, led;

  explicit Mixed(bool far_first, std::size_t threads = 0) {
    if (far_first) add_far();
    world.add({.shape = {Box{{60, 1, 60}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
    test::Random random(29);
    for (int i = 0; i < 60; ++i) {
      BodySettings body{.mass = random.between(0.5, 3), .friction = random.unit(), .restitution = 0.5 * (i % 3)};
      body.shape = {solid(i % 6)};
      body.motion.pose.position = Vec3(random.between(-2, 2), 0.6 + 0.25 * i, random.between(-2, 2));
      body.motion.pose.rotation = random.rotation();
      body.motion.twist = {random.vector(1), random.vector(3)};
      heap.push_back(world.add(body));
      if (i % 10 < 4 && i % 10 > 0) join(i);
    }
    for (int i = 0; i < 2; ++i)
      led.push_back(world.add({.shape = {Box{{0.2, 0.3, 3}}},
                               .drive = Drive::keyed(),
                               .motion = {.pose = {.position = {i == 0 ? -3.0 : 3.0, 0.4, 0}}}}));
    if (threads > 0) world.set_executor(std::make_shared<ThreadPool>(threads));
  }

  static Solid solid(int kind) {
    switch (kind) {
      case 0:
        return Box{{0.3, 0.2, 0.4}};
      case 1:
        return Sphere{0.3};
      case 2:
        return Capsule{0.15, 0.3};
      case 3:
        return Hull{pointed_hull()};
      case 4:
        return Compound({Shape{Box{{0.4, 0.1, 0.1}}}, Shape{Sphere{0.2}, {.position = {0.4, 0.2, 0}}}});
      default:
        return Cylinder{0.25, 0.2};
    }
  }
  void join(int i) {
    const BodyId a = heap[static_cast<std::size_t>(i - 1)], b = heap[static_cast<std::size_t>(i)];
    const Pose at_a = world.motion(a).pose, at_b = world.motion(b).pose;
    const JointFrames held = joint_frames(at_a, at_b, 0.5 * (at_a.position + at_b.position));
    JointSettings joint{.a = a, .b = b, .frame_a = held.a, .frame_b = held.b};
    if (i % 3 == 0) joint.kind = HingeJoint{.limits = Limits{-1, 1}, .motor = Motor{.speed = 1, .max_force = 5}};
    if (i % 3 == 1) joint.kind = SpringJoint{.length = 0.5, .stiffness = 200, .damping = 2};
    world.add_joint(joint);
  }
  /// Islands that nothing above ever meets.
  std::vector<BodyId> add_far() {
    std::vector<BodyId> far;
    for (int i = 0; i < 40; ++i)
      far.push_back(world.add({.shape = {solid(i % 6)},
                               .restitution = 0.4,
                               .motion = {.pose = {.position = {300.0 + 0.3 * (i % 4), 1.0 + 0.7 * i, 0}}}}));
    return far;
  }
  void step(int n) {
    const double dt = 1.0 / 120, time = (n + 1) * dt;
    for (std::size_t i = 0; i < led.size(); ++i) {
      const double side = i == 0 ? -1 : 1;
      Motion target;
      target.pose.position = Vec3(side * (2 + std::cos(2 * time)), 0.4, 0);
      target.twist.linear = Vec3(-2 * side * std::sin(2 * time), 0, 0);
      world.set_target(led[i], target);
    }
    world.step(dt);
  }
};

/// Whether two heaps lie and move alike to the bit.
bool alike(const Mixed& a, const Mixed& b) {
  const auto same = [&](std::size_t i) {
    const Motion one = a.world.motion(a.heap[i]), other = b.world.motion(b.heap[i]);
    return one.pose.position == other.pose.position && one.pose.rotation.coeffs() == other.pose.rotation.coeffs() &&
           one.twist.linear == other.twist.linear && one.twist.angular == other.twist.angular;
  };
  for (std::size_t i = 0; i < a.heap.size(); ++i)
    if (!same(i)) return false;
  return true;
}

}  // namespace

TEST_CASE("a heap of all kinds that keyed bodies stir keeps its bits beside far islands that come and go") {
  Mixed alone(false), before(true), later(false);
  std::vector<BodyId> far;
  for (int n = 0; n < 480; ++n) {
    CAPTURE(n);
    if (n == 60) far = later.add_far();
    if (n == 240)
      for (const BodyId body : far) later.world.remove(body);
    for (Mixed* each : {&alone, &before, &later}) each->step(n);
    REQUIRE(alike(alone, before));
    REQUIRE(alike(alone, later));
  }
}

TEST_CASE("a heap of all kinds that keyed bodies stir goes on in the same bits after it was saved and loaded") {
  Mixed whole(false);
  for (int n = 0; n < 360; ++n) {
    if (n % 40 == 7) {
      CAPTURE(n);
      Mixed loaded = whole, on = whole;
      loaded.world = World();
      loaded.world.load(whole.world.save());
      for (int k = n; k < n + 60; ++k) {
        loaded.step(k);
        on.step(k);
      }
      REQUIRE(loaded.world.state_hash() == on.world.state_hash());
    }
    whole.step(n);
  }
}

TEST_CASE("a heap of all kinds that keyed bodies stir ends in the same bits by 1, 2, 3 and 8 threads") {
  Mixed alone(true);
  std::vector<Mixed> others;
  for (const std::size_t threads : {1, 2, 3, 8}) others.emplace_back(true, threads);
  for (int n = 0; n < 240; ++n) {
    CAPTURE(n);
    alone.step(n);
    for (Mixed& other : others) {
      if (n > 60 && &other == &others.back()) continue;  // eight threads on few processors take long
      other.step(n);
      REQUIRE(other.world.state_hash() == alone.world.state_hash());
    }
  }
}
