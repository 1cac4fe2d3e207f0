#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

// Whatever rests beyond the one that is struck is not on anybody's path when the step begins.

TEST_CASE("a row of balls that stand apart passes on a blow within one step, however fast") {
  // Of two equal balls, the one that is struck leaves with (1 + e) / 2 of the speed, m/s.
  const double restitution = 0.5, last = std::pow(0.5 * (1 + restitution), 4);
  for (const double gap : {0.05, 0.2, 0.35})
    for (const double speed : {27.0, 60.0, 120.0}) {
      CAPTURE(gap);
      CAPTURE(speed);
      World world({.gravity = {0, 0, 0}, .sleep_after = std::numeric_limits<double>::infinity()});
      std::vector<BodyId> balls;
      for (int i = 0; i < 5; ++i)
        balls.push_back(world.add({.shape = {Sphere{0.5}},
                                   .mass = 1,
                                   .friction = 0,
                                   .restitution = restitution,
                                   .motion = {.pose = {.position = {i * (1 + gap), 0, 0}},
                                              .twist = {.linear = {i == 0 ? speed : 0, 0, 0}}}}));
      for (int step = 0; step < 20; ++step) world.step(1.0 / 60);
      CHECK(world.twist(balls.back()).linear.x() == doctest::Approx(last * speed).epsilon(1e-6));
      for (std::size_t i = 1; i < balls.size(); ++i)
        CHECK(world.motion(balls[i]).pose.position.x() > world.motion(balls[i - 1]).pose.position.x());
    }
}

TEST_CASE("what a heavy ball strikes does not fly through what rests behind it") {
  for (const double gap : {0.05, 0.2}) {
    CAPTURE(gap);
    World world({.gravity = {0, 0, 0}, .sleep_after = std::numeric_limits<double>::infinity()});
    std::vector<BodyId> balls;
    for (int i = 0; i < 5; ++i)
      balls.push_back(world.add(
          {.shape = {Sphere{0.5}},
           .mass = i == 0 ? 100 : 1,
           .friction = 0,
           .motion = {.pose = {.position = {i * (1 + gap), 0, 0}}, .twist = {.linear = {i == 0 ? 120.0 : 0, 0, 0}}}}));
    for (int step = 0; step < 20; ++step) {
      world.step(1.0 / 60);
      for (std::size_t i = 1; i < balls.size(); ++i)
        CHECK(world.motion(balls[i]).pose.position.x() - world.motion(balls[i - 1]).pose.position.x() > 0.99);
    }
    // All as one at restitution 0.
    for (const BodyId ball : balls)
      CHECK(world.twist(ball).linear.x() == doctest::Approx(120.0 * 100 / 104).epsilon(1e-4));
  }
}
