#include "physics/scene.h"
#include "random.h"

using namespace tweenfall;
using test::near;

namespace {

/// Two bodies, or one and the world, on a spring that may pull at levers.
struct Sprung {
  World world{{.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()}};
  BodyId a, b;
  Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};
  double length = 0, stiffness = 0, damping = 0;

  [[nodiscard]] Vec3 place(const BodyId& body, const Vec3& arm) const {
    if (body == BodyId{}) return arm;
    const Pose pose = world.motion(body).pose;
    return pose.position + pose.rotation * arm;
  }
  [[nodiscard]] double energy() const {
    const double stretched = (place(b, arm_b) - place(a, arm_a)).norm() - length;
    return world.kinetic_energy() + 0.5 * stiffness * stretched * stretched;
  }
  /// About the origin, N m s.
  [[nodiscard]] Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const BodyId& body : {a, b}) {
      const Mat3 turn = world.motion(body).pose.rotation.toRotationMatrix();
      const MassProperties& mass = world.mass(body);
      sum += world.motion(body).pose.position.cross(mass.mass * world.twist(body).linear) +
             turn * mass.inertia * turn.transpose() * world.twist(body).angular;
    }
    return sum;
  }
  void tie(bool joint) {
    if (joint)
      world.add_joint({.a = a,
                       .b = b,
                       .frame_a = {.position = arm_a},
                       .frame_b = {.position = arm_b},
                       .kind = SpringJoint{.length = length, .stiffness = stiffness, .damping = damping}});
    else
      world.add_force(Spring{.a = b,
                             .b = a,
                             .anchor_a = arm_b,
                             .anchor_b = arm_a,
                             .rest_length = length,
                             .stiffness = stiffness,
                             .damping = damping});
  }
};

}  // namespace

TEST_CASE("springs on levers of any kind gain no energy, however stiff, and keep the momentum of what they join") {
  const Solid solids[] = {Sphere{0.3}, Box{{0.5, 0.1, 0.2}}, Capsule{0.05, 0.5}, Cylinder{0.2, 0.1}};
  const double steps[] = {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 960};
  test::Random random(8);
  const auto size = [&](double low, double high) { return low * std::pow(high / low, random.unit()); };
  for (int i = 0; i < 240; ++i) {
    CAPTURE(i);
    Sprung sprung;
    const double heavy = size(1, 1000), light = size(1, 1000), lever = size(0.1, 2), spin = size(0.1, 10);
    const double dt = steps[i % 5];
    const bool to_world = i % 4 == 0;
    sprung.stiffness = size(100, 1e7);
    sprung.length = i % 3 == 0 ? 0 : size(0.1, 2);
    sprung.arm_a = random.vector(lever);
    sprung.arm_b = random.vector(lever);
    BodySettings body{.shape = {solids[i % 7 % 4]}, .mass = heavy};
    body.motion.twist = {random.vector(1), random.vector(spin)};
    if (!to_world) sprung.a = sprung.world.add(body);
    body = {.shape = {solids[i % 11 % 4]}, .mass = light};
    body.motion = {.pose = {.position = random.vector(4)}, .twist = {random.vector(1), random.vector(spin)}};
    sprung.b = sprung.world.add(body);
    if (!to_world) sprung.world.ignore(sprung.a, sprung.b);
    sprung.tie(i % 2 == 0);
    const double before = sprung.energy();
    const Vec3 turning = to_world ? Vec3(0, 0, 0) : sprung.angular_momentum();
    double most = 0;
    for (int step = 0; step < 1.5 / dt; ++step) {
      sprung.world.step(dt);
      most = std::max(most, sprung.energy());
    }
    CHECK(most < 1.02 * before);
    if (to_world) continue;
    const double moved = std::sqrt(2 * before * (heavy + light));
    CHECK((sprung.angular_momentum() - turning).norm() < 1e-9 * (turning.norm() + 10 * moved));
  }
}

TEST_CASE("a ball on a lever swings by the square root of k (1/m + r^2/I), and keeps its swing and its energy") {
  for (const bool joint : {true, false})
    for (const double hz : {1.0, 5.0, 20.0})
      for (const double dt : {1.0 / 60, 1.0 / 240}) {
        CAPTURE(joint);
        CAPTURE(hz);
        CAPTURE(dt);
        Sprung sprung;
        sprung.b = sprung.world.add({.shape = {Sphere{0.2}}, .mass = 3.0});
        sprung.arm_b = Vec3(0, 0.3, 0);
        sprung.arm_a = Vec3(-1.001, 0.3, 0);
        sprung.length = 1;
        const double moment = 0.4 * 3 * 0.2 * 0.2, w = 2 * test::pi * hz;
        sprung.stiffness = w * w / (1 / 3.0 + 0.3 * 0.3 / moment);
        sprung.tie(joint);
        const double before = sprung.energy();
        double away = 0;
        const int steps = static_cast<int>(std::lround(10 / dt));
        for (int i = 1; i <= steps; ++i) {
          sprung.world.step(dt);
          const double stretched = (sprung.place(sprung.b, sprung.arm_b) - sprung.arm_a).norm() - 1;
          if (i * dt * hz < 10) away = std::max(away, std::abs(stretched - 0.001 * std::cos(w * i * dt)));
        }
        CHECK(away < 2e-4);
        CHECK(near(sprung.energy(), before, 0.02 * before));
      }
}

TEST_CASE("a spring as short as rounding holds a weight where one of no length does") {
  for (const bool joint : {true, false})
    for (const double length : {0.0, 1e-17, 1e-9, 1e-7, 1e-4})
      for (const double dt : {1.0 / 60, 0.25}) {
        CAPTURE(joint);
        CAPTURE(length);
        CAPTURE(dt);
        Sprung sprung;
        sprung.world = World({.gravity = Vec3(0, -10, 0), .sleep_after = std::numeric_limits<double>::infinity()});
        BodySettings weight{.shape = {Box{{0.1, 0.1, 0.1}}}, .mass = 1.0};
        weight.motion.pose.position.y() = -0.1 - length;  // m g / k
        sprung.b = sprung.world.add(weight);
        sprung.stiffness = 100;
        sprung.length = length;
        sprung.damping = 2;
        sprung.tie(joint);
        for (double t = 0; t < 5; t += dt) sprung.world.step(dt);
        CHECK((sprung.place(sprung.b, Vec3(0, 0, 0)) - Vec3(0, -0.1 - length, 0)).norm() < 1e-6);
      }
}

TEST_CASE("what hangs on a light hook between two stiff springs hangs where their stretches say") {
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const auto& [hook, weight, stiffness] :
         {std::tuple(0.01, 100.0, 1e7), std::tuple(0.1, 1000.0, 1e7), std::tuple(0.001, 1000.0, 1e6)}) {
      CAPTURE(dt);
      World world({.gravity = Vec3(0, -10, 0), .sleep_after = std::numeric_limits<double>::infinity()});
      const double above = (hook + weight) * 10 / stiffness, below = weight * 10 / stiffness;
      BodySettings body{.shape = {Sphere{0.01}}, .mass = hook};
      body.motion.pose.position.y() = -1 - above;
      const BodyId upper = world.add(body);
      body = {.shape = {Sphere{0.1}}, .mass = weight};
      body.motion.pose.position.y() = -2 - above - below;
      const BodyId lower = world.add(body);
      world.add_joint({.b = upper, .kind = SpringJoint{.length = 1, .stiffness = stiffness, .damping = 100}});
      world.add_joint(
          {.a = upper, .b = lower, .kind = SpringJoint{.length = 1, .stiffness = stiffness, .damping = 100}});
      for (double t = 0; t < 2; t += dt) world.step(dt);
      const double stretched = -world.motion(lower).pose.position.y() - 2;
      CHECK(near(stretched, above + below, 0.02 * (above + below)));
    }
}

TEST_CASE("a body that a damper of almost nothing holds turns as one that flies freely") {
  for (const double spin : {30.0, 60.0}) {
    CAPTURE(spin);
    World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
    BodySettings box{.shape = {Box{{0.1, 0.2, 0.4}}}, .mass = 1.0};
    box.motion.twist.angular = spin * Vec3(0.3, 0.9, 0.2).normalized();
    const BodyId held = world.add(box);
    box.motion.pose.position.x() = 10;
    const BodyId flying = world.add(box);
    world.add_joint({.b = held, .kind = SpringJoint{.stiffness = 0, .damping = 1e-12}});
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    CHECK(world.motion(held).pose.rotation.angularDistance(world.motion(flying).pose.rotation) < 5e-3);
  }
}
