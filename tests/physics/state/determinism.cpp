#include "physics/scene.h"

using namespace tweenfall;

namespace {

/// A heap of all solids, pushed about by a keyed box.
struct Heap {
  World world;
  BodyId pusher;
  std::vector<BodyId> bodies;
  int steps = 0;

  Heap() {
    world.add({.shape = {Plane{}}, .fixed = true});
    test::Random random(5);
    const Solid solids[] = {Sphere{0.25}, Box{Vec3(0.25, 0.2, 0.3)}, Capsule{0.15, 0.2}};
    for (int i = 0; i < 30; ++i) {
      BodySettings body;
      body.shape.solid = solids[i % 3];
      body.restitution = 0.1 * (i % 4);
      body.motion.pose.position = random.vector(0.5) + Vec3(0, 1 + 0.4 * i, 0);
      body.motion.pose.rotation = random.rotation();
      bodies.push_back(world.add(body));
    }
    BodySettings box;
    box.shape.solid = Box{Vec3(0.2, 0.5, 2)};
    box.drive = Drive::keyed();
    box.motion.pose.position = Vec3(-3, 0.5, 0);
    pusher = world.add(box);
  }
  void step() {
    ++steps;
    Motion target;
    target.pose.position = Vec3(-3 + 2 * steps / 120.0, 0.5, 0);
    target.twist.linear = Vec3(2, 0, 0);
    world.set_target(pusher, target);
    if (steps == 60) world.set_drive(bodies[3], Drive::keyed());
    if (steps == 90) world.set_drive(bodies[3], Drive::free());
    if (steps == 100) world.remove(bodies[7]);
    if (steps == 110) bodies[7] = world.add({.shape = {Sphere{0.2}}});
    world.step(1.0 / 120);
  }
};

}  // namespace

TEST_CASE("two runs and a copy stepped on end in the same bits") {
  Heap first, second;
  World copy;
  Heap third;
  for (int i = 0; i < 200; ++i) {
    first.step();
    second.step();
    CHECK(first.world.state_hash() == second.world.state_hash());
    if (i >= 150) {
      if (i == 150)
        third = first;
      else
        third.step();
      copy = third.world;  // every step, onto the same storage
      CHECK(copy.state_hash() == first.world.state_hash());
    }
  }
  for (const BodyId body : first.bodies) {
    CHECK(first.world.motion(body).pose.position.allFinite());
    CHECK(first.world.motion(body).pose.position.y() > 0.05);
  }
}

TEST_CASE("bodies a million times as heavy, or beside others far away, go the same ways to the bit") {
  const auto places = [](double mass, bool far) {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    for (int i = 0; far && i < 3; ++i)
      world.add({.shape = {Box{}}, .motion = {.pose = {.position = Vec3(500, i, 20)}}});
    const Solid solids[] = {Sphere{0.3}, Box{Vec3(0.3, 0.2, 0.3)}, Capsule{0.2, 0.2}, Cone{0.3, 0.3}};
    std::vector<BodyId> bodies;
    for (int i = 0; i < 9; ++i) {
      BodySettings body;
      body.shape.solid = solids[i % 4];
      body.mass = mass * (1 + i % 3);
      body.restitution = 0.2;
      body.motion.pose.position = Vec3(0.1 * (i % 2), 0.5 + 0.7 * i, 0.05 * (i % 3));
      bodies.push_back(world.add(body));
      if (i % 4 == 3)
        world.add_joint({.a = bodies[bodies.size() - 2],
                         .b = bodies.back(),
                         .frame_a = {.position = Vec3(0, 0.35, 0)},
                         .frame_b = {.position = Vec3(-0.1, -0.35, 0)}});
    }
    for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
    std::vector<Vec3> ends;
    for (const BodyId body : bodies) ends.push_back(world.motion(body).pose.position);
    return ends;
  };
  const std::vector<Vec3> usual = places(1, false);
  // Scaling by powers of two rounds no number of a mass differently.
  CHECK(places(1048576, false) == usual);
  CHECK(places(1.0 / 1048576, false) == usual);
  CHECK(places(1, true) == usual);
}

TEST_CASE("the handle of a removed body is refused, and is not taken for its successor") {
  World world;
  const BodyId first = world.add({});
  world.remove(first);
  CHECK(!world.contains(first));
  CHECK_THROWS_AS((void)world.motion(first), std::invalid_argument);
  const BodyId second = world.add({});
  CHECK(second.index == first.index);
  CHECK(second != first);
  CHECK(world.bodies().size() == 1);
}

TEST_CASE("a body whose support is removed falls") {
  World world;
  BodySettings box;
  box.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
  box.fixed = true;
  const BodyId support = world.add(box);
  box.fixed = false;
  box.motion.pose.position = Vec3(0, 1, 0);
  const BodyId body = world.add(box);
  for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
  CHECK(world.asleep(body));
  world.remove(support);
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  CHECK(world.motion(body).pose.position.y() < -3);
}

TEST_CASE("what no body can be is refused with the number in the text") {
  World world;
  CHECK_THROWS_WITH_AS(world.add({.friction = -1}), "friction must lie in 0 to 1e30, but is -1", std::invalid_argument);
  CHECK_THROWS_AS(world.add({.restitution = 1.5}), std::invalid_argument);
  CHECK_THROWS_AS(world.add({.shape = {Plane{}}}), std::invalid_argument);
  CHECK_THROWS_AS(world.step(0), std::invalid_argument);
  CHECK_THROWS_AS(world.step(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}
