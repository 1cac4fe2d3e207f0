#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

constexpr double without_end = std::numeric_limits<double>::infinity();

/// Of all bodies about the origin.
struct Momenta {
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};
  double size = 0;  ///< size of the terms of the angular one
};

Momenta momenta_of(const World& world) {
  Momenta sum;
  for (const BodyId body : world.bodies()) {
    const MassProperties& mass = world.mass(body);
    const Pose pose = world.motion(body).pose;
    const Twist twist = world.twist(body);
    const Vec3 center = pose.position + pose.rotation * mass.center;
    const Vec3 spin = pose.rotation * (mass.inertia * (pose.rotation.conjugate() * twist.angular));
    sum.linear += mass.mass * twist.linear;
    sum.angular += mass.mass * center.cross(twist.linear) + spin;
    sum.size += mass.mass * center.norm() * twist.linear.norm() + spin.norm();
  }
  return sum;
}

}  // namespace

TEST_CASE("a cloud that falls together keeps its momentum and its angular momentum to 1e-12, and gains no energy") {
  const ConvexHull wedge(
      std::vector<Vec3>{{0.3, 0.3, 0.3}, {-0.3, -0.3, 0.3}, {-0.3, 0.3, -0.3}, {0.3, -0.3, -0.3}, {0, 0.4, 0}});
  const Solid solids[] = {Box{Vec3(0.25, 0.2, 0.3)}, Sphere{0.3}, Capsule{0.2, 0.2}, Hull{wedge}};
  for (int kind = 0; kind < 5; ++kind)
    for (const int side : {2, 3, 4})
      for (const double restitution : {0.0, 0.5, 1.0})
        for (const double friction : {0.0, 0.5}) {
          World world({.gravity = Vec3::Zero(), .sleep_after = without_end});
          test::Random random(17);
          for (int i = 0; i < side * side * side; ++i) {
            BodySettings body;
            body.shape.solid = solids[kind == 4 ? i % 4 : kind];
            body.mass = 1 + i % 3;
            body.friction = friction;
            body.restitution = restitution;
            const int x = i % side, y = i / side % side, z = i / side / side;
            body.motion.pose.position = 1.2 * Vec3(x, y, z) - 0.6 * (side - 1) * Vec3::Ones();
            const Vec3 astray = random.vector(2), spin = random.vector(3);
            body.motion.twist = {-2 * body.motion.pose.position + astray, spin};
            world.add(body);
          }
          const Momenta start = momenta_of(world);
          const double energy = world.kinetic_energy();
          double worst = 0, worst_angular = 0, most = 0;
          for (int i = 0; i < 240; ++i) {
            world.step(1.0 / 240);
            const Momenta now = momenta_of(world);
            worst = std::max(worst, (now.linear - start.linear).norm() / start.linear.norm());
            worst_angular = std::max(worst_angular, (now.angular - start.angular).norm() / start.size);
            most = std::max(most, world.kinetic_energy() / energy);
          }
          CAPTURE(kind);
          CAPTURE(side);
          CAPTURE(restitution);
          CAPTURE(friction);
          CHECK(worst < 1e-12);
          CHECK(worst_angular < 1e-12);
          CHECK(most <= 1 + 1e-9);
        }
}

TEST_CASE(
    "what joints alone hold together keeps its momentum and its angular momentum to 1e-12, ropes and motors too") {
  HingeJoint driven;
  driven.motor = Motor{.speed = 5, .max_force = 3};
  const JointKind kinds[] = {BallJoint{},      HingeJoint{}, SliderJoint{},
                             UniversalJoint{}, driven,       DistanceJoint{{0, 0.3}}};
  for (const JointKind& kind : kinds) {
    World world({.gravity = Vec3::Zero(), .sleep_after = without_end});
    test::Random random(3);
    BodyId last;
    for (int i = 0; i < 5; ++i) {
      BodySettings body;
      body.shape.solid = Box{Vec3(0.3, 0.1 + 0.02 * i, 0.08)};
      body.mass = 1 + i % 3;
      body.motion.pose.position.x() = 0.7 * i;
      const Vec3 astray = random.vector(3), spin = random.vector(15);
      body.motion.twist = {astray, spin};
      const BodyId next = world.add(body);
      if (i > 0)
        world.add_joint({.a = last,
                         .b = next,
                         .frame_a = {.position = Vec3(0.35, 0, 0)},
                         .frame_b = {.position = Vec3(-0.35, 0, 0)},
                         .kind = kind});
      last = next;
    }
    const Momenta start = momenta_of(world);
    for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
    const Momenta end = momenta_of(world);
    CAPTURE(kind.index());
    CHECK((end.linear - start.linear).norm() < 1e-12 * start.linear.norm());
    CHECK((end.angular - start.angular).norm() < 1e-12 * start.size);
  }
}

TEST_CASE("bodies that meet in free fall turn about where gravity takes them") {
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::semi_implicit_euler}) {
    World world({.integrator = integrator, .sleep_after = without_end});
    for (int i = 0; i < 5; ++i) {
      BodySettings body;
      body.shape.solid = Box{Vec3(0.3, 0.1, 0.2)};
      body.mass = 1 + i;
      body.motion.pose.position = Vec3(0.55 * i, 100 + 0.15 * i, 0.02 * i);
      body.motion.twist = {Vec3(-2.0 * i, 0.5, 0), Vec3(0, 1, 2 - i)};
      world.add(body);
    }
    const auto middle = [&] {
      Vec3 sum = Vec3::Zero();
      double mass = 0;
      for (const BodyId body : world.bodies()) {
        sum += world.mass(body).mass * world.motion(body).pose.position;
        mass += world.mass(body).mass;
      }
      return Vec3(sum / mass);
    };
    const auto about_middle = [&] {
      const Momenta all = momenta_of(world);
      return Vec3(all.angular - middle().cross(all.linear));
    };
    const Vec3 start = middle(), velocity = momenta_of(world).linear / 15, spun = about_middle();
    for (int i = 0; i < 120; ++i) world.step(1.0 / 120);
    const double fallen = integrator == Integrator::exact_quadratic ? 0.5 * 9.81 : 0.5 * 9.81 * (1 + 1.0 / 120);
    CHECK((middle() - (start + velocity - Vec3(0, fallen, 0))).norm() < 1e-10);
    CHECK((about_middle() - spun).norm() < 1e-10 * spun.norm());
  }
}

TEST_CASE("what led bodies pinch moves as their reactions tell, also where it is kept from getting too fast") {
  constexpr double speed = 0.8;  // m/s, of each of the two
  for (const Solid& solid : {Solid{Box{{0.25, 0.25, 0.25}}}, Solid{Capsule{0.2, 0.25}}})
    for (const double friction : {0.0, 0.5})
      for (const double rate : {60.0, 240.0}) {
        CAPTURE(kind_name(solid));
        CAPTURE(friction);
        CAPTURE(rate);
        World world({.gravity = {0, 0, 0}, .sleep_after = std::numeric_limits<double>::infinity()});
        constexpr double far = 1.6, near = 0.5;  // m
        std::vector<BodyId> jaws, pinched;
        for (const double side : {-1.0, 1.0})
          jaws.push_back(world.add({.shape = {Box{{0.5, 1, 1}}},
                                    .friction = friction,
                                    .drive = Drive::keyed(),
                                    .motion = {.pose = {.position = {side * far, 0, 0}}}}));
        for (const double place : {-0.59, 0.01, 0.61})
          pinched.push_back(world.add({.shape = {solid},
                                       .mass = 1,
                                       .friction = friction,
                                       .motion = {.pose = {.position = {place, 0.003, 0.002},
                                                           .rotation = Quat(1, 0.03, 0.05, 0.06).normalized()}}}));
        double pressed = 0;
        for (int step = 1; step < 1.7 * rate; ++step) {
          const double way = std::max(near, far - speed * step / rate);
          for (std::size_t i = 0; i < jaws.size(); ++i) {
            const double side = i == 0 ? -1 : 1;
            world.set_target(jaws[i], {{.position = {side * way, 0, 0}}, {.linear = {-side * speed, 0, 0}}});
          }
          world.step(1 / rate);
          Vec3 sum = world.reaction(jaws[0]) + world.reaction(jaws[1]);
          for (const BodyId body : pinched) sum += world.twist(body).linear;
          pressed = std::max(pressed, world.reaction(jaws[0]).norm());
          CHECK(sum.norm() < 1e-13 * (100 + pressed));
        }
        CHECK(pressed > 1000);
      }
}

TEST_CASE("what is told of blows in the air, and of joints, adds up to how each body moved") {
  for (const int count : {2, 3, 6})
    for (const bool joined : {false, true})
      for (const double restitution : {0.0, 0.5, 1.0}) {
        if (joined && count == 2) continue;  // they never meet
        CAPTURE(count);
        CAPTURE(joined);
        CAPTURE(restitution);
        constexpr double dt = 1.0 / 60;
        std::size_t all = 0, unexplained_ones = 0;
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
          World world({.gravity = Vec3::Zero(), .sleep_after = without_end});
          test::Random random(seed);
          std::vector<BodyId> bodies;
          for (int i = 0; i < count; ++i) {
            BodySettings body{.mass = random.between(0.3, 4), .friction = 0.6, .restitution = restitution};
            if (i % 3 == 0) body.shape.solid = Box{Vec3(0.3, 0.15, 0.2)};
            if (i % 3 == 1) body.shape.solid = Capsule{0.15, 0.2};
            if (i % 3 == 2) body.shape.solid = Sphere{0.25};
            const double angle = i * 2 * test::pi / count;
            body.motion.pose = {.position = Vec3(std::cos(angle), std::sin(angle), 0.1 * i),
                                .rotation = random.rotation()};
            body.motion.twist = {-2 * body.motion.pose.position + random.vector(0.3), random.vector(3)};
            bodies.push_back(world.add(body));
          }
          if (joined) {
            const JointFrames held = joint_frames(world.motion(bodies[0]).pose, world.motion(bodies[1]).pose, {});
            world.add_joint({.a = bodies[0], .b = bodies[1], .frame_a = held.a, .frame_b = held.b});
          }
          for (int step = 0; step < 90; ++step) {
            std::vector<Vec3> unexplained(bodies.size());
            std::vector<double> size(bodies.size(), 0);
            for (std::size_t i = 0; i < bodies.size(); ++i)
              unexplained[i] = -world.mass(bodies[i]).mass * world.twist(bodies[i]).linear;
            world.step(dt);
            for (std::size_t i = 0; i < bodies.size(); ++i)
              unexplained[i] += world.mass(bodies[i]).mass * world.twist(bodies[i]).linear;
            const auto told = [&](BodyId a, BodyId b, const Vec3& on_b) {
              unexplained[a.index] += on_b;
              unexplained[b.index] -= on_b;
              size[a.index] += on_b.norm();
              size[b.index] += on_b.norm();
            };
            for (const Contact& contact : world.contacts()) {
              told(contact.a, contact.b, contact.total_impulse);
              CHECK(contact.impulse >= 0);
            }
            for (const JointId joint : world.joints())
              told(world.joint(joint).a, world.joint(joint).b, dt * world.reading(joint).force);
            for (std::size_t i = 0; i < bodies.size(); ++i) {
              all += size[i] > 0 ? 1 : 0;
              unexplained_ones += unexplained[i].norm() > 1e-9 * (size[i] + 1e-3) ? 1 : 0;
            }
          }
        }
        // Bodies that nearly touch a struck one may get a little of what it loses, of which no contact is told.
        REQUIRE(all > 20);
        CHECK(static_cast<double>(unexplained_ones) <= (count == 2 ? 0 : 0.08) * static_cast<double>(all));
      }
}
