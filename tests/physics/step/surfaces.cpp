#include "contacts/combine.h"

#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

constexpr double gravity = 9.81;

BodySettings belt(double turned = 0) {
  BodySettings settings{.shape = {Box{{50, 0.5, 2}}}, .friction = 0.4, .fixed = true};
  settings.motion.pose.position = Vec3(0, -0.5, 0);
  settings.motion.pose.rotation = Quat(std::cos(0.5 * turned), 0, std::sin(0.5 * turned), 0);
  return settings;
}

BodySettings crate(const Vec3& place, double turned = 0) {
  BodySettings settings{.shape = {Box{{0.1, 0.1, 0.1}}}, .mass = 2.0, .friction = 0.4};
  settings.motion.pose.rotation = Quat(std::cos(0.5 * turned), 0, std::sin(0.5 * turned), 0);
  settings.motion.pose.position = settings.motion.pose.rotation * place;
  return settings;
}

/// What a belt does to a box that it carries along, or stops, by a change of its speed.
struct BeltRide {
  double slipped_for = 0, went = 0, relative_speed = 0;
};

BeltRide ride(World& world, BodyId on, BodyId box, const Vec3& along, double from, double to, double h) {
  world.set_surface_velocity(on, {.linear = Vec3(to, 0, 0)});
  const double start = world.motion(box).pose.position.dot(along);
  BeltRide result;
  const int steps = static_cast<int>(std::lround(1.0 / h));
  int riding = 0;
  for (int i = 1; i <= steps; ++i) {
    world.step(h);
    const double speed = world.twist(box).linear.dot(along);
    if (riding == 0 && std::abs(speed - to) < 1e-3 * std::abs(to - from)) {
      riding = 1;
      result.slipped_for = i * h;
      result.went = world.motion(box).pose.position.dot(along) - start;
    }
    // The instant within a step at which it began to ride is not known.
    if (riding > 0 && ++riding > 3) result.relative_speed = std::max(result.relative_speed, std::abs(speed - to));
  }
  return result;
}

}  // namespace

TEST_CASE("a belt takes a box along: it slips for 0.3823 s and 0.2867 m, rides, and stops and reverses likewise") {
  for (const double rate : {60.0, 240.0})
    for (const double turned : {0.0, 0.7})
      for (const bool keyed : {false, true})
        for (const int boxes : {1, 12}) {
          CAPTURE(rate);
          CAPTURE(turned);
          CAPTURE(boxes);
          const double h = 1 / rate;
          World world;
          BodySettings under = belt(turned);
          if (keyed) {
            under.fixed = false;
            under.drive = Drive::keyed();
          }
          const BodyId on = world.add(under);
          std::vector<BodyId> row;
          for (int i = 0; i < boxes; ++i) row.push_back(world.add(crate(Vec3(0.2 * i, 0.1, 0), turned)));
          for (int i = 0; i < 10; ++i) world.step(h);
          const Vec3 along = under.motion.pose.rotation * Vec3(1, 0, 0);
          const double slip_time = 1.5 / (0.4 * gravity), slip_length = 0.5 * 1.5 * slip_time;
          double before = 0;
          for (const double speed : {1.5, 0.0, -1.5}) {
            CAPTURE(speed);
            const BeltRide taken = ride(world, on, row.back(), along, before, speed, h);
            CHECK(std::abs(taken.slipped_for - slip_time) <= h + 1e-9);
            // From rest to the belt's speed or back, it moves as far as it slips.
            CHECK(std::abs(std::abs(taken.went) - slip_length) <= 1.5 * h);
            CHECK(taken.relative_speed <= 1e-4);
            CHECK(taken.went * (speed + before) > 0);
            before = speed;
          }
          CHECK(std::abs(world.motion(row[0]).pose.position.y() - 0.1) < 1e-3);
        }
}

TEST_CASE("the surface of a turning table spins up what stands on its middle, alone and in a stack") {
  for (const int boxes : {1, 10}) {
    CAPTURE(boxes);
    World world;
    BodySettings table = belt();
    table.surface_velocity.angular = Vec3(0, 2, 0);
    CHECK(world.surface_velocity(world.add(table)).angular.y() == 2);
    std::vector<BodyId> stack;
    for (int i = 0; i < boxes; ++i) stack.push_back(world.add(crate(Vec3(0, 0.1 + 0.2 * i, 0))));
    for (int i = 0; i < 480; ++i) world.step(1.0 / 240);
    for (const BodyId box : stack) {
      CHECK(world.twist(box).angular.y() == doctest::Approx(2).epsilon(1e-3));
      CHECK(world.motion(box).pose.position.x() == doctest::Approx(0).epsilon(1e-3));
    }
  }
}

TEST_CASE("a slow belt lets nothing sleep on it, one that stops does, and one that starts wakes it") {
  World world;
  const BodyId on = world.add(belt()), box = world.add(crate({0, 0.1, 0}));
  world.set_surface_velocity(on, {.linear = Vec3(0.005, 0, 0)});
  for (int i = 0; i < 480; ++i) world.step(1.0 / 240);
  CHECK(world.motion(box).pose.position.x() == doctest::Approx(0.01).epsilon(0.01));
  world.set_surface_velocity(on, {});
  for (int i = 0; i < 480; ++i) world.step(1.0 / 240);
  CHECK(world.asleep(box));
  world.set_surface_velocity(on, {.linear = Vec3(0, 0, 1)});
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  CHECK(world.twist(box).linear.z() == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("a ball that bounces on a belt comes to its speed, keeps its bounce, and its energy is the belt's") {
  World world;
  BodySettings moving = belt();
  moving.surface_velocity.linear.x() = 3;
  world.add(moving);
  BodySettings ball{.shape = {Sphere{0.1}}, .friction = 0.4, .restitution = 0.8};
  ball.motion.pose.position = Vec3(0, 1.1, 0);
  const BodyId body = world.add(ball);
  double highest = 0;
  bool rises = false, rose = false;
  for (int i = 0; i < 240 * 8; ++i) {
    world.step(1.0 / 240);
    const double speed = world.twist(body).linear.y();
    if (rises && speed < 0 && !rose) {
      rose = true;
      highest = world.motion(body).pose.position.y();
    }
    rises = speed > 0;
  }
  CHECK(highest == doctest::Approx(0.1 + 0.64).epsilon(0.01));
  // Two sevenths of a ball's speed are its own, the rest is spin, until its whole surface moves with the belt.
  const Twist twist = world.twist(body);
  CHECK(twist.linear.x() + 0.1 * twist.angular.z() == doctest::Approx(3).epsilon(1e-3));
  CHECK(twist.linear.x() == doctest::Approx(3 * 2.0 / 7).epsilon(0.01));
}

TEST_CASE("resistance to spinning stops a ball, and a box without friction, after w I / (s m g) seconds") {
  for (const bool ball : {true, false}) {
    CAPTURE(ball);
    World world({.sleep_after = std::numeric_limits<double>::infinity()});
    world.add({.shape = {Plane{}}, .friction = ball ? 0.5 : 0, .fixed = true});
    BodySettings settings{.shape = {Box{{0.2, 0.2, 0.2}}}, .mass = 3.0};
    if (ball) settings.shape.solid = Sphere{0.2};
    settings.spinning_friction = 0.01;
    settings.motion.pose.position.y() = 0.2;
    settings.motion.twist.angular.y() = 10;
    const BodyId body = world.add(settings);
    const double slowing = 0.01 * 3 * gravity / world.mass(body).inertia(1, 1), h = 1.0 / 240;
    double stopped = 0;
    for (int i = 1; i <= 1200; ++i) {
      world.step(h);
      const double spin = world.twist(body).angular.y();
      CHECK(std::abs(spin - std::max(0.0, 10 - slowing * i * h)) < 2 * slowing * h);
      CHECK(spin > -1e-9);
      if (stopped == 0 && spin < 1e-6) stopped = i * h;
    }
    CHECK(std::abs(stopped - 10 / slowing) <= 2 * h);
    CHECK(world.twist(body).linear.norm() < 1e-9);
  }
}

TEST_CASE("resistance to spinning leaves rolling alone, and acts in a heap of many contacts as in one") {
  World world({.sleep_after = std::numeric_limits<double>::infinity()});
  world.add({.shape = {Plane{}}, .fixed = true});
  std::vector<BodyId> balls;
  for (int i = 0; i < 12; ++i) {
    BodySettings ball{.shape = {Sphere{0.2}}, .friction = 0, .spinning_friction = 0.02};
    ball.motion.pose.position = Vec3(0.4 * i, 0.2, 0);
    ball.motion.twist.angular.y() = 5;
    balls.push_back(world.add(ball));
  }
  BodySettings roller{.shape = {Sphere{0.2}}, .spinning_friction = 0.02};
  roller.motion.pose.position = Vec3(0, 0.2, 5);
  roller.motion.twist = {Vec3(1, 0, 0), Vec3(0, 0, -5)};
  const BodyId rolls = world.add(roller);
  roller.spinning_friction = 0;
  roller.motion.pose.position.z() = 8;
  const BodyId twin = world.add(roller);
  for (int i = 0; i < 720; ++i) world.step(1.0 / 240);
  for (const BodyId ball : balls) CHECK(std::abs(world.twist(ball).angular.y()) < 1e-6);
  CHECK(world.twist(rolls).linear.x() == doctest::Approx(1).epsilon(1e-4));
  CHECK(world.twist(rolls).linear.x() == doctest::Approx(world.twist(twin).linear.x()).epsilon(1e-12));
}

TEST_CASE("of two bodies' rules to combine the stronger holds, in the stated order") {
  using enum Combine;
  const std::vector<Combine> rules = {usual, geometric_mean, average, minimum, multiply, maximum};
  const double a = 0.2, b = 0.8;
  const std::vector<double> frictions = {0.4, 0.4, 0.5, 0.2, 0.16, 0.8}, restitutions = {0.8, 0.4, 0.5, 0.2, 0.16, 0.8};
  for (std::size_t i = 0; i < rules.size(); ++i)
    for (std::size_t k = 0; k < rules.size(); ++k) {
      CHECK(contacts::combined_friction(a, rules[i], b, rules[k]) == doctest::Approx(frictions[std::max(i, k)]));
      CHECK(contacts::combined_restitution(a, rules[i], b, rules[k]) == doctest::Approx(restitutions[std::max(i, k)]));
    }
  // As a sliding box feels it, and a bouncing ball.
  for (std::size_t i = 0; i < rules.size(); ++i) {
    CAPTURE(i);
    World world;
    world.add({.shape = {Plane{}}, .friction = a, .restitution = a, .fixed = true});
    BodySettings box{.shape = {Box{{0.2, 0.1, 0.2}}}, .friction = b, .friction_combine = rules[i]};
    box.motion.pose.position.y() = 0.1;
    box.motion.twist.linear.x() = 5;
    BodySettings ball{.shape = {Sphere{0.1}}, .friction = 0, .restitution = b, .restitution_combine = rules[i]};
    ball.motion.pose.position = Vec3(0, 0.1, 5);
    ball.motion.twist.linear.y() = -4;
    const BodyId slides = world.add(box), bounces = world.add(ball);
    world.step(1.0 / 240);
    CHECK(world.twist(bounces).linear.y() == doctest::Approx(4 * restitutions[i] - gravity / 240).epsilon(0.01));
    for (int n = 1; n < 120; ++n) world.step(1.0 / 240);
    CHECK(world.twist(slides).linear.x() ==
          doctest::Approx(std::max(0.0, 5 - frictions[i] * gravity * 0.5)).epsilon(1e-3));
  }
}

TEST_CASE("surfaces that are none are refused") {
  World world;
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(world.add({.spinning_friction = -1}), std::invalid_argument);
  CHECK_THROWS_AS(world.add({.spinning_friction = none}), std::invalid_argument);
  CHECK_THROWS_AS(world.add({.friction_combine = static_cast<Combine>(77)}), std::invalid_argument);
  CHECK_THROWS_AS(world.add({.surface_velocity = {.linear = Vec3(0, none, 0)}}), std::invalid_argument);
  const BodyId body = world.add({});
  CHECK_THROWS_AS(world.set_surface_velocity(body, {.angular = Vec3(1e31, 0, 0)}), std::invalid_argument);
  world.remove(body);
  CHECK_THROWS_AS(world.set_surface_velocity(body, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)world.surface_velocity(body), std::invalid_argument);
}
