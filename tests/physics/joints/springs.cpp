#include "physics/scene.h"

using namespace tweenfall;
using test::near;

TEST_CASE("a spring of any stiffness, damped or not, in steps of any length never swings wider than at the start") {
  for (const double stiffness : {0.0, 1.0, 1e3, 1e6, 1e9, 1e12})
    for (const double damping : {0.0, 1.0, 1e6, 1e12})
      for (const double rest : {0.0, 0.5, 2.0})
        for (const double dt : {1e-6, 1.0 / 240, 1.0 / 60, 0.5, 10.0}) {
          World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
          BodySettings ball;
          ball.shape.solid = Sphere{0.1};
          ball.mass = 1;
          ball.motion.pose.position = Vec3(1, 0, 0);
          const BodyId body = world.add(ball);
          world.add_force(Spring{.a = body, .rest_length = rest, .stiffness = stiffness, .damping = damping});
          CAPTURE(stiffness);
          CAPTURE(damping);
          CAPTURE(rest);
          CAPTURE(dt);
          double most = 0;
          for (int i = 0; i < 200; ++i) {
            world.step(dt);
            most = std::max(most, std::abs(world.motion(body).pose.position.norm() - rest));
          }
          CHECK(most <= std::abs(1 - rest) * 1.01 + 1e-9);
        }
}

TEST_CASE("a weight hangs from a stiff spring by m g / k below its rest length") {
  for (const double stiffness : {1e5, 1e6, 1e8}) {
    World world;
    BodySettings ball;
    ball.shape.solid = Sphere{0.1};
    ball.mass = 2;
    ball.motion.pose.position = Vec3(0, -1, 0);
    const BodyId body = world.add(ball);
    world.add_force(Spring{.a = body, .rest_length = 1, .stiffness = stiffness});
    for (int i = 0; i < 480; ++i) world.step(1.0 / 60);
    CHECK(near(world.motion(body).pose.position, Vec3(0, -1 - 2 * 9.81 / stiffness, 0), 1e-9));
  }
}

TEST_CASE("a pendulum on a stiff spring swings as on a rod, and a chain of springs hangs") {
  World world;
  BodySettings ball;
  ball.shape.solid = Sphere{0.05};
  ball.mass = 1;
  ball.motion.pose.position = Vec3(1, 0, 0);
  const BodyId body = world.add(ball);
  world.add_force(Spring{.a = body, .rest_length = 1, .stiffness = 1e7});
  double lowest = 0;
  for (int i = 0; i < 240 * 3; ++i) {
    world.step(1.0 / 240);
    lowest = std::min(lowest, world.motion(body).pose.position.y());
    CHECK(std::abs(world.motion(body).pose.position.norm() - 1) < 1e-3);
  }
  CHECK(lowest < -0.999);

  World chain;
  std::vector<BodyId> links;
  for (int i = 0; i < 10; ++i) {
    ball.motion.pose.position = Vec3(0, -0.5 * (i + 1), 0);
    links.push_back(chain.add(ball));
    Spring spring{.a = links.back(), .rest_length = 0.5, .stiffness = 1e6};
    if (i > 0) spring.b = links[static_cast<std::size_t>(i) - 1];
    chain.add_force(spring);
  }
  for (int i = 0; i < 600; ++i) chain.step(1.0 / 60);
  CHECK(near(chain.motion(links.back()).pose.position, Vec3(0, -5 - 55 * 9.81 / 1e6, 0), 5e-3));
}

TEST_CASE("a stiff spring on a corner keeps momentum between two bodies that it joins") {
  World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
  BodySettings box;
  box.shape.solid = Box{Vec3(0.2, 0.1, 0.1)};
  box.mass = 1;
  const BodyId a = world.add(box);
  box.mass = 3;
  box.motion.pose.position = Vec3(2, 0, 0);
  box.motion.twist = {Vec3(0, 1, 0), Vec3(1, 2, 3)};
  const BodyId b = world.add(box);
  world.add_force(Spring{.a = a,
                         .b = b,
                         .anchor_a = Vec3(0.2, 0.1, 0.1),
                         .anchor_b = Vec3(-0.2, 0.1, 0),
                         .rest_length = 1,
                         .stiffness = 1e9,
                         .damping = 10});
  const double energy = world.kinetic_energy() + 0.5 * 1e9 * 0.65 * 0.65;
  for (int i = 0; i < 600; ++i) {
    world.step(1.0 / 60);
    CHECK(near(Vec3(world.twist(a).linear + 3 * world.twist(b).linear), Vec3(0, 3, 0), 1e-6));
    CHECK(world.kinetic_energy() <= energy);
  }
  CHECK(world.kinetic_energy() < 100);
}

TEST_CASE("a stretched spring joint, however stiff, keeps the momentum of bodies that it spins too fast to follow") {
  for (const double stiffness : {1e5, 1e6, 1e8})
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
      World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
      BodySettings ball;
      ball.shape.solid = Sphere{0.2};
      ball.mass = 600;
      ball.motion.twist = {Vec3(0, 1, 0), Vec3(1, 2, 3)};
      const BodyId a = world.add(ball);
      ball.mass = 100;
      ball.motion.pose.position = Vec3(4, 0, 0);
      ball.motion.twist = {Vec3(0, 0, -2), Vec3::Zero()};
      const BodyId b = world.add(ball);
      world.add_joint({.a = a,
                       .b = b,
                       .frame_b = {.position = Vec3(0.03, 0.19, 0)},
                       .kind = SpringJoint{.length = 0.1, .stiffness = stiffness, .damping = 80}});
      CAPTURE(stiffness);
      CAPTURE(dt);
      for (int i = 0; i < 30; ++i) {
        world.step(dt);
        const Vec3 of_a = 600 * world.twist(a).linear, of_b = 100 * world.twist(b).linear;
        CHECK((of_a + of_b - Vec3(0, 600, -200)).norm() <= 1e-12 * (of_a.norm() + of_b.norm() + 800));
      }
    }
}

TEST_CASE("what swings on an undamped spring joint keeps its swing and its time, alone and between two") {
  for (const double other : {0.0, 20.0})  // kg at the other end; 0: the world
    for (const double hz : {0.5, 1.0, 2.0})
      for (const double dt : {1.0 / 60, 1.0 / 240}) {
        CAPTURE(other);
        CAPTURE(hz);
        CAPTURE(dt);
        World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
        BodySettings ball{.shape = {Sphere{0.1}}, .mass = 1.0};
        ball.motion.pose.position = Vec3(1.2, 0, 0);
        const BodyId body = world.add(ball);
        BodyId end;
        if (other > 0) end = world.add({.shape = {Sphere{0.1}}, .mass = other});
        const double mass = other > 0 ? other / (1 + other) : 1, w = 2 * test::pi * hz;
        const JointId spring =
            world.add_joint({.a = end, .b = body, .kind = SpringJoint{.length = 1, .stiffness = mass * w * w}});
        double swing = 0, away = 0, most = 0;
        const int steps = static_cast<int>(std::lround(10 / dt));
        for (int i = 1; i <= steps; ++i) {
          world.step(dt);
          const JointReading reading = world.reading(spring);
          const double x = reading.position[0] - 1, v = reading.rate[0];
          away = std::max(away, std::abs(x - 0.2 * std::cos(w * i * dt)));
          most = std::max(most, (w * w * x * x + v * v) / (w * w * 0.04));
          if (i * dt > 8) swing = std::max(swing, std::abs(x));
        }
        CHECK(near(swing, 0.2, 2e-3));
        CHECK(away < 0.05 * w * dt);
        CHECK(most < 1 + 0.2 * w * dt);
      }
}
