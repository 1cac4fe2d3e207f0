#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

struct Yard {
  World world;
  std::vector<BodyId> stack;

  explicit Yard(int far_columns) {
    const BodyId floor =
        world.add({.shape = {Box{{500, 1, 500}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
    static_cast<void>(floor);
    for (int i = 0; i < 8; ++i)
      stack.push_back(world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
                                 .restitution = 0.2,
                                 .motion = {.pose = {.position = {0.04 * (i % 3), 0.55 + 1.1 * i, 0}}}}));
    for (int column = 0; column < far_columns; ++column)
      for (int i = 0; i < 5; ++i)
        world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
                   .restitution = 0.2,
                   .motion = {.pose = {.position = {20.0 + 3 * column, 0.55 + 1.1 * i, 0.1 * column}}}});
  }
};

}  // namespace

TEST_CASE("what an island does depends on no other: far columns leave a stack's bits as they are") {
  Yard alone(0), crowded(30);
  for (int step = 0; step < 240; ++step) {
    alone.world.step(1.0 / 120);
    crowded.world.step(1.0 / 120);
    for (std::size_t i = 0; i < alone.stack.size(); ++i) {
      CAPTURE(step);
      CAPTURE(i);
      const Motion one = alone.world.motion(alone.stack[i]);
      const Motion other = crowded.world.motion(crowded.stack[i]);
      REQUIRE(one.pose.position == other.pose.position);
      REQUIRE(one.pose.rotation.coeffs() == other.pose.rotation.coeffs());
      REQUIRE(one.twist.linear == other.twist.linear);
      REQUIRE(one.twist.angular == other.twist.angular);
    }
  }
}

TEST_CASE("an island in which something bounces leaves nothing to one in which nothing does") {
  /// A floor, and on it a row of balls that bounce and a pile of boxes that do not.
  struct Two {
    World world;
    std::vector<BodyId> pile;
    Two(bool with_balls, double speed) {
      world.add({.shape = {Box{{500, 1, 500}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
      for (int i = 0; i < 5; ++i) {
        BodySettings ball{.shape = {Sphere{0.5}}, .restitution = 0.8};
        ball.motion.pose.position = Vec3(40 + i, 0.6, 0);
        ball.motion.twist.linear.y() = -speed;
        if (with_balls) world.add(ball);
      }
      for (int i = 0; i < 24; ++i)
        pile.push_back(world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
                                  .motion = {.pose = {.position = {0.1 * (i % 3), 0.5 + 1.0 * i, 0.05 * (i % 4)}}}}));
    }
  };
  // In which part of a step they hit the floor depends on how fast they fall.
  for (double speed = 1; speed < 3; speed += 0.04) {
    CAPTURE(speed);
    Two alone(false, speed), both(true, speed);
    for (int step = 0; step < 16; ++step) {
      CAPTURE(step);
      alone.world.step(1.0 / 120);
      both.world.step(1.0 / 120);
      for (std::size_t i = 0; i < alone.pile.size(); ++i) {
        CAPTURE(i);
        const Motion one = alone.world.motion(alone.pile[i]), other = both.world.motion(both.pile[i]);
        REQUIRE(one.pose.position == other.pose.position);
        REQUIRE(one.twist.linear == other.twist.linear);
        REQUIRE(one.twist.angular == other.twist.angular);
      }
    }
  }
}

TEST_CASE("what a small island does depends on none of those that are solved beside it") {
  // Few bodies each: resting, sliding, rolling, spinning, bouncing, pushed.
  struct Field {
    World world;
    std::vector<BodyId> bodies;
    std::size_t first;

    explicit Field(int before, int after) {
      world.add({.shape = {Box{{500, 1, 500}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
      for (int group = 0; group < before; ++group) add(1 + 7 * group, 10.0 + 6 * group);
      first = bodies.size();
      for (int group = 0; group < 12; ++group) add(group, -10.0 - 6 * group);
      for (int group = 0; group < after; ++group) add(5 + group, 400.0 - 6 * group);
    }
    void add(int kind, double x) {
      const Solid solids[] = {Sphere{0.25}, Box{Vec3(0.25, 0.2, 0.3)}, Capsule{0.15, 0.2}, Cylinder{0.2, 0.3}};
      for (int i = 0; i <= kind % 3; ++i) {
        BodySettings body;
        body.shape.solid = solids[(kind + i) % 4];
        body.restitution = kind % 4 == 1 ? 0.6 : 0;
        body.motion.pose.position = Vec3(x + 0.05 * i, 0.21 + 0.5 * i + (kind % 5 == 4 ? 1 : 0), 0.03 * i);
        body.motion.twist.linear = Vec3(kind % 2, 0, 0.5 * (kind % 3));
        body.motion.twist.angular = Vec3(0, kind % 7 == 6 ? 20 : 0, 0);
        bodies.push_back(world.add(body));
      }
    }
  };
  Field alone(0, 0), crowded(40, 25);
  for (int step = 0; step < 240; ++step) {
    CAPTURE(step);
    alone.world.step(1.0 / 120);
    crowded.world.step(1.0 / 120);
    for (std::size_t i = 0; i < alone.bodies.size(); ++i) {
      CAPTURE(i);
      const Motion one = alone.world.motion(alone.bodies[i]);
      const Motion other = crowded.world.motion(crowded.bodies[crowded.first + i]);
      REQUIRE(one.pose.position == other.pose.position);
      REQUIRE(one.pose.rotation.coeffs() == other.pose.rotation.coeffs());
      REQUIRE(one.twist.linear == other.twist.linear);
      REQUIRE(one.twist.angular == other.twist.angular);
    }
  }
}

TEST_CASE("what tumbles and bounces a little goes the same way by itself and beside others of its kind") {
  constexpr int each = 8;
  struct Drops {
    World world;
    std::vector<BodyId> bodies;

    Drops(int from, int to) {
      world.add({.shape = {Box{{5000, 1, 500}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
      for (int group = from; group < to; ++group) {
        test::Random random(static_cast<unsigned>(100 + group));
        for (int i = 0; i < each; ++i) {
          BodySettings body{.restitution = 0.1};
          if (i % 2 == 0)
            body.shape.solid = Box{Vec3(0.25, 0.2, 0.3)};
          else
            body.shape.solid = Capsule{0.15, 0.2};
          const Vec3 aside = random.vector(0.1), velocity = random.vector(2), spin = random.vector(6);
          body.motion.pose.position = Vec3(20.0 * group + 0.3 * (i % 3), 0.7 + 0.6 * i, 0.3 * (i % 2)) + aside;
          body.motion.pose.rotation = random.rotation();
          body.motion.twist = {velocity, spin};
          bodies.push_back(world.add(body));
        }
      }
    }
  };
  constexpr int groups = 40;
  Drops all(0, groups);
  for (int step = 0; step < 150; ++step) all.world.step(1.0 / 60);
  for (int group = 0; group < groups; ++group) {
    CAPTURE(group);
    Drops one(group, group + 1);
    for (int step = 0; step < 150; ++step) one.world.step(1.0 / 60);
    for (std::size_t i = 0; i < one.bodies.size(); ++i) {
      const Motion its = one.world.motion(one.bodies[i]);
      const Motion beside = all.world.motion(all.bodies[each * static_cast<std::size_t>(group) + i]);
      CHECK(its.pose.position == beside.pose.position);
      CHECK(its.pose.rotation.coeffs() == beside.pose.rotation.coeffs());
      CHECK(its.twist.angular == beside.twist.angular);
    }
  }
}
