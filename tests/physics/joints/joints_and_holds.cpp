#include <doctest/doctest.h>

#include "physics/joints/joint_scene.h"

namespace tweenfall::jointed {

TEST_CASE("a drive carries what is welded to its body, with a limit and without") {
  for (const double most : {HUGE_VAL, 1e9}) {
    World world(awake);
    const Drive drive{.hz = 4, .zeta = 1, .max_force = most, .max_torque = most};
    const BodyId held = world.add({.shape = {Sphere{0.1}}, .mass = 2, .drive = drive});
    const BodyId hung = add_ball(world, Vec3(0, -1, 0), 0.1, 2);
    join(world, held, hung, Vec3(0, -0.5, 0), FixedJoint{});
    for (int i = 0; i < 240 * 3; ++i) world.step(1.0 / 240);
    // The drive is a spring on its own body's mass, and carries twice that.
    const double turning = 2 * pi * 4;
    CAPTURE(most);
    CHECK(world.motion(held).pose.position.y() == doctest::Approx(-2 * g / (turning * turning)).epsilon(1e-4));
  }
  World world(awake);
  const BodyId weak = world.add({.shape = {Sphere{0.1}}, .mass = 2, .drive = {.hz = 4, .max_force = 30}});
  const BodyId heavy = add_ball(world, Vec3(0, -1, 0), 0.1, 2);
  join(world, weak, heavy, Vec3(0, -0.5, 0), FixedJoint{});
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  const double before = world.twist(weak).linear.y();
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  // What it cannot carry falls with the rest of the weight.
  CHECK(world.twist(weak).linear.y() - before == doctest::Approx(-(g - 30 / 4.0)).epsilon(1e-6));
}

TEST_CASE("a stiff spring carries what a joint hangs on its body") {
  World world(awake);
  const BodyId upper = add_ball(world, Vec3(0, -1, 0), 0.1, 3);
  const BodyId lower = add_ball(world, Vec3(0, -2, 0), 0.1, 3);
  join(world, upper, lower, Vec3(0, -1.5, 0), BallJoint{});
  const double stiffness = 1e6;
  world.add_force(Spring{.a = upper, .rest_length = 1, .stiffness = stiffness, .damping = 100});
  for (int i = 0; i < 240 * 3; ++i) world.step(1.0 / 240);
  CHECK(world.motion(upper).pose.position.y() + 1 == doctest::Approx(-6 * g / stiffness).epsilon(1e-3));
}

TEST_CASE("a slack rope changes nothing of how a ball rolls to a stop") {
  const auto rolled = [](bool roped) {
    World world(awake);
    world.add({.shape = {Plane{}}, .friction = 0.8, .rolling_friction = 0.02, .fixed = true});
    const BodyId ball =
        world.add({.shape = {Sphere{0.2}},
                   .mass = 2,
                   .friction = 0.8,
                   .rolling_friction = 0.02,
                   .motion = {.pose = {.position = Vec3(0, 0.2, 0)}, .twist = {Vec3(2, 0, 0), Vec3(0, 0, -10)}}});
    if (roped) world.add_joint({.b = ball, .kind = DistanceJoint{{0, 100}}});
    for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
    return world.motion(ball).pose.position.x();
  };
  CHECK(rolled(true) == doctest::Approx(rolled(false)).epsilon(5e-4));
  CHECK(rolled(true) < 1.9);
}

}  // namespace tweenfall::jointed
