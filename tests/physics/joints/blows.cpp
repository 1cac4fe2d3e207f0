#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

JointSettings ball_between(const World& world, BodyId a, BodyId b, const Vec3& at) {
  JointSettings joint;
  joint.a = a;
  joint.b = b;
  joint.kind = BallJoint{};
  const auto local = [&](BodyId body) -> Vec3 {
    const Pose& pose = world.motion(body).pose;
    return pose.rotation.conjugate() * (at - pose.position);
  };
  joint.frame_a.position = local(a);
  joint.frame_b.position = local(b);
  return joint;
}

}  // namespace

TEST_CASE("two jointed bodies that fall on the ground and tumble gain no energy by it") {
  double worst = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    test::Random random(seed);
    World world;
    world.add({.shape = {Plane{}}, .friction = 0.5, .fixed = true});
    std::array<BodyId, 2> bodies;
    for (int i = 0; i < 2; ++i) {
      BodySettings body;
      if (i == 0)
        body.shape.solid = Box{Vec3(random.between(0.1, 0.4), random.between(0.1, 0.4), random.between(0.1, 0.4))};
      else
        body.shape.solid = Sphere{random.between(0.1, 0.4)};
      body.mass = random.between(0.5, 4);
      body.friction = random.between(0, 0.8);
      body.motion.pose.position = Vec3(random.between(-0.3, 0.3), 1 + 1.5 * i, random.between(-0.3, 0.3));
      body.motion.pose.rotation = random.rotation();
      body.motion.twist.linear = random.vector(2);
      body.motion.twist.angular = random.vector(6);
      bodies[static_cast<std::size_t>(i)] = world.add(body);
    }
    const Vec3 middle = 0.5 * (world.motion(bodies[0]).pose.position + world.motion(bodies[1]).pose.position);
    world.add_joint(ball_between(world, bodies[0], bodies[1], middle));
    const auto energy_of = [&] {
      double sum = world.kinetic_energy();
      for (const BodyId body : bodies) sum += world.mass(body).mass * 9.81 * world.motion(body).pose.position.y();
      return sum;
    };
    const double start = energy_of();
    double energy = start;
    for (int i = 0; i < 180; ++i) {
      world.step(1.0 / 60);
      worst = std::max(worst, (energy_of() - energy) / start);
      energy = energy_of();
    }
  }
  MESSAGE("gain in a step: ", worst, " of the energy at most");
  CHECK(worst < 0.03);
}

TEST_CASE("a splinter hinged between the ground and what is a thousand times as heavy gives a figure no energy") {
  test::Random random(4);
  double most = 0;
  for (int scene = 0; scene < 60; ++scene) {
    World world;
    world.add({.shape = {Plane{}}, .friction = 0.6, .restitution = 1, .fixed = true});
    const Solid solids[] = {Box{Vec3(0.02, 0.03, 0.01)}, Cylinder{0.08, 0.07}, Sphere{0.07}};
    const double masses[] = {0.002, 3, 0.6};
    std::vector<BodyId> bodies;
    for (int i = 0; i < 3; ++i) {
      BodySettings body{.shape = {solids[i]}, .mass = masses[i], .friction = 0.6, .restitution = 1};
      body.motion.pose = {Vec3(0.6 * i, 1.5, 0), random.rotation()};
      body.motion.twist = {random.vector(3) - Vec3(0, 4, 0), random.vector(6)};
      bodies.push_back(world.add(body));
    }
    for (std::size_t i = 1; i < 3; ++i) {
      const Vec3 middle(0.6 * static_cast<double>(i) - 0.3, 1.5, 0);
      const JointFrames frames = joint_frames(world.motion(bodies[i - 1]).pose, world.motion(bodies[i]).pose, middle,
                                              random.vector(1) + Vec3(0, 0, 1.5));
      JointSettings joint{.a = bodies[i - 1], .b = bodies[i], .frame_a = frames.a, .frame_b = frames.b};
      if (i == 1) joint.kind = HingeJoint{.limits = Limits{-0.9, 0.07}};
      world.add_joint(joint);
    }
    const double start = world.kinetic_energy() + world.potential_energy();
    for (int i = 0; i < 360; ++i) {
      world.step(1.0 / 120);
      most = std::max(most, (world.kinetic_energy() + world.potential_energy()) / start);
    }
  }
  MESSAGE("most energy: " << most << " of that at the start");
  CHECK(most < 1.02);
}

TEST_CASE("a figure with a light part that starts in the ground slides on as fast as it came") {
  World world;
  world.add({.shape = {Plane{}}, .friction = 0, .fixed = true});
  const auto box = [&](double half, double mass, const Vec3& at) {
    BodySettings body;
    body.shape.solid = Box{Vec3(half, half, half)};
    body.mass = mass;
    body.friction = 0;
    body.motion.pose.position = at;
    body.motion.twist.linear = Vec3(1, 0, 0);
    return world.add(body);
  };
  const BodyId big = box(0.5, 1, {0, 0.4, 0}), small = box(0.2, 0.05, {0.8, 0.4, 0});
  world.add_joint(ball_between(world, big, small, {0.55, 0.4, 0}));
  for (int i = 0; i < 180; ++i) world.step(1.0 / 60);
  CHECK(world.motion(big).pose.position.x() > 2.9);
  CHECK(world.motion(big).twist.linear.x() > 0.9);
}
