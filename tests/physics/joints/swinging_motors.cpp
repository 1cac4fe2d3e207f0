#include "physics/scene.h"

using namespace tweenfall;
using test::near;

namespace {

/// 0.2 e^(-z w t) (cos v t + z w / v sin v t), v = w sqrt(1 - z^2).
double damped_swing(double w, double zeta, double t) {
  const double v = w * std::sqrt(1 - zeta * zeta);
  return 0.2 * std::exp(-zeta * w * t) * (std::cos(v * t) + zeta * w / v * std::sin(v * t));
}

/// A body on a joint to the world, or to a body of twenty times its mass, whose coordinate starts 0.2 away from where
/// its spring wants it.
void check_swing(const JointKind& kind, double start, double goal, int coordinate, double hz, double zeta, double dt) {
  CAPTURE(kind.index());
  CAPTURE(hz);
  CAPTURE(zeta);
  CAPTURE(dt);
  World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
  BodySettings ball{.shape = {Sphere{0.3}}, .mass = 2.0};
  if (std::holds_alternative<WheelJoint>(kind)) ball.motion.pose.position = Vec3(0, start, 0);
  const BodyId body = world.add(ball);
  const JointId joint = world.add_joint({.b = body, .kind = kind});
  const double w = 2 * test::pi * hz;
  double away = 0, swing = 0;
  const int steps = static_cast<int>(std::lround(10 / dt));
  for (int i = 1; i <= steps; ++i) {
    world.step(dt);
    const double off = world.reading(joint).position[static_cast<std::size_t>(coordinate)] - goal;
    away = std::max(away, std::abs(off - (start - goal) / 0.2 * damped_swing(w, zeta, i * dt)));
    if (i * dt > 8) swing = std::max(swing, std::abs(off));
  }
  CHECK(away < 0.05 * w * dt);
  if (zeta == 0) CHECK(near(swing, 0.2, 2e-3));
}

}  // namespace

TEST_CASE("motors and suspensions damped less than critically swing as the closed form says, and keep their swing") {
  for (const double hz : {0.5, 1.0, 2.0})
    for (const double zeta : {0.0, 0.02, 0.1})
      for (const double dt : {1.0 / 60, 1.0 / 240}) {
        const Motor motor{.position = 0.2, .hz = hz, .zeta = zeta};
        check_swing(HingeJoint{.motor = motor}, 0, 0.2, 0, hz, zeta, dt);
        check_swing(SliderJoint{.motor = motor}, 0, 0.2, 0, hz, zeta, dt);
        check_swing(WheelJoint{.hz = hz, .zeta = zeta}, 0.2, 0, 1, hz, zeta, dt);
        const SwingTwistJoint limb{.swing_y = test::pi,
                                   .swing_z = test::pi,
                                   .twist = {-3, 3},
                                   .toward = exp_map(Vec3(0.2, 0, 0)),
                                   .hz = hz,
                                   .zeta = zeta};
        check_swing(limb, 0, 0.2, 0, hz, zeta, dt);
      }
}

TEST_CASE("an undamped motor of a bar on a lever gains nothing in a hundred seconds") {
  for (const auto& one : {std::pair(20.0, 1.0 / 240), std::pair(7.0, 1.0 / 60), std::pair(5.0, 1.0 / 20)}) {
    const double hz = one.first, dt = one.second;
    CAPTURE(hz);
    World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
    BodySettings bar{.shape = {Box{{0.25, 0.05, 0.05}}}};
    bar.motion.pose.position.x() = 0.25;
    const BodyId body = world.add(bar);
    JointSettings hinge{.b = body, .kind = HingeJoint{.motor = Motor{.position = 0.5, .hz = hz, .zeta = 0}}};
    hinge.frame_b.position.x() = -0.25;
    hinge.frame_a.rotation = hinge.frame_b.rotation = exp_map(Vec3(0, -test::pi / 2, 0));
    const JointId joint = world.add_joint(hinge);
    double first = 0, last = 0;
    const int steps = static_cast<int>(std::lround(100 / dt));
    for (int i = 0; i < steps; ++i) {
      world.step(dt);
      const JointReading at = world.reading(joint);
      const double swing = std::hypot(at.position[0] - 0.5, at.rate[0] / (2 * test::pi * hz));
      if (i * dt < 2) first = std::max(first, swing);
      if (i * dt > 98) last = std::max(last, swing);
    }
    CHECK(last <= 1.001 * first);
  }
}
