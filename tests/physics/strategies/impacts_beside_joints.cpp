#include <cmath>

#include "physics/strategies/ground.h"

using namespace tweenfall;
using test::near;

namespace {

/// What a world has beside a ball that bounces.
enum class Beside { nothing, pendulum, driven, stiff_spring, jointed_box };

struct Bouncing {
  World world;
  BodyId ball, other;
};

Bouncing bouncing(Beside beside, bool with_ball) {
  Bouncing scene{World(test::with(ContactSolver::iterative, Parting::half, Detection::time_of_impact)), {}, {}};
  World& world = scene.world;
  test::add_floor(world, 0);
  const double height = beside == Beside::jointed_box ? 0.2 : 5;
  BodySettings other = test::solid_at(Box{Vec3(0.2, 0.2, 0.2)}, Vec3(9, height, 0));
  if (beside == Beside::driven) other.drive = Drive{.hz = 2};
  scene.other = world.add(other);
  if (beside == Beside::driven)
    world.set_target(scene.other, {.pose = {.position = Vec3(9, 6, 0)}, .twist = {}, .scale_rate = Vec3::Zero()});
  if (beside == Beside::pendulum) {
    JointSettings joint{.b = scene.other};
    joint.frame_a.position = Vec3(8, 5, 0);
    joint.frame_b.position = Vec3(-1, 0, 0);
    world.add_joint(joint);
  }
  if (beside == Beside::stiff_spring)
    world.add_force(Spring{.a = scene.other, .anchor_b = Vec3(9, 5.1, 0), .stiffness = 1e6});
  if (beside == Beside::jointed_box) {
    const BodyId second = world.add(test::solid_at(Box{Vec3(0.2, 0.2, 0.2)}, Vec3(9.5, height, 0)));
    JointSettings joint{.a = scene.other, .b = second, .kind = FixedJoint{}};
    joint.frame_a.position = Vec3(0.25, 0, 0);
    joint.frame_b.position = Vec3(-0.25, 0, 0);
    world.add_joint(joint);
  }
  if (!with_ball) return scene;
  BodySettings ball = test::solid_at(Sphere{0.1}, Vec3(0, 2.1, 0));
  ball.restitution = 0.8;
  scene.ball = world.add(ball);
  return scene;
}

}  // namespace

TEST_CASE("a ball bounces at the closed form's times, whatever in the same world is solved as usual") {
  for (const Beside beside :
       {Beside::nothing, Beside::pendulum, Beside::driven, Beside::stiff_spring, Beside::jointed_box}) {
    CAPTURE(static_cast<int>(beside));
    Bouncing scene = bouncing(beside, true), alone = bouncing(beside, false);
    for (int n = 0; n < 60; ++n) {
      scene.world.step(1.0 / 60);
      alone.world.step(1.0 / 60);
      REQUIRE(scene.world.motion(scene.other).pose.position == alone.world.motion(alone.other).pose.position);
    }
    const double down = std::sqrt(4 / 9.81), up = 0.8 * 9.81 * down, since = 1 - down;
    CHECK(near(scene.world.motion(scene.ball).pose.position.y(), 0.1 + up * since - 0.5 * 9.81 * since * since, 2e-6));
  }
}

TEST_CASE("what stands beside impacts on joints is told with the load that it bears") {
  Bouncing scene = bouncing(Beside::jointed_box, true);
  double borne = 0;
  for (int n = 0; n < 80; ++n) {
    scene.world.step(1.0 / 60);
    if (n < 20) continue;
    for (const Contact& contact : scene.world.contacts())
      if (contact.a != scene.ball && contact.b != scene.ball) borne += contact.impulse;
  }
  CHECK(near(borne, 2 * 9.81, 0.01));
}
