#include "physics/scene.h"

using namespace tweenfall;

TEST_CASE("a keyed bar that turns by more than a right angle in a step hits what its tip passes") {
  for (const double angle : {1.0, 2.0, 3.0}) {
    World world({.gravity = Vec3::Zero()});
    BodySettings bar;
    bar.shape.solid = Box{Vec3(2, 0.1, 0.1)};
    bar.drive = Drive::keyed();
    const BodyId keyed = world.add(bar);
    BodySettings ball;
    ball.shape.solid = Sphere{0.1};
    // Halfway along the arc, out of the bounds of both ends.
    ball.motion.pose.position = 1.9 * Vec3(std::cos(angle / 2), std::sin(angle / 2), 0);
    const BodyId body = world.add(ball);
    Motion target;
    target.pose.rotation = Quat(Eigen::AngleAxisd(angle, Vec3(0, 0, 1)));
    target.twist.angular = Vec3(0, 0, angle * 60);
    world.set_target(keyed, target);
    world.step(1.0 / 60);
    CAPTURE(angle);
    CHECK(!world.contacts().empty());
    CHECK(world.twist(body).linear.norm() > 1);
  }
}

TEST_CASE("a drive of any stiffness is stopped by a wall between it and its target") {
  for (const double hz : {4.0, 60.0, 1000.0, 1e6})
    for (const double rate : {60.0, 240.0}) {
      World world({.gravity = Vec3::Zero()});
      BodySettings wall;
      wall.shape.solid = Box{Vec3(0.01, 1, 1)};
      wall.fixed = true;
      world.add(wall);
      BodySettings ball;
      ball.shape.solid = Sphere{0.05};
      ball.motion.pose.position = Vec3(-1, 0, 0);
      ball.drive = {.hz = hz};
      const BodyId body = world.add(ball);
      CAPTURE(hz);
      CAPTURE(rate);
      for (int i = 0; i < static_cast<int>(2 * rate); ++i) {
        Motion target;
        target.pose.position = Vec3(1, 0, 0);
        world.set_target(body, target);
        world.step(1 / rate);

        REQUIRE(world.motion(body).pose.position.x() < -0.05);
      }
      CHECK(world.motion(body).pose.position.x() > -0.07);
    }
}
