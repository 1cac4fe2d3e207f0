#include "physics/scene.h"

using namespace tweenfall;
using test::near;

namespace {

BodySettings half_meter_ball(const Vec3& place) {
  BodySettings ball;
  ball.shape.solid = Sphere{0.5};
  ball.mass = 1;
  ball.motion.pose.position = place;
  return ball;
}

void run_for(World& world, double seconds, double rate = 240) {
  for (int i = 0; i < static_cast<int>(seconds * rate); ++i) world.step(1 / rate);
}

}  // namespace

TEST_CASE("a drive slower than the sleep speed keeps up with its target") {
  for (const double speed : {0.01, 0.001, 1e-5}) {
    World world({.gravity = Vec3::Zero()});
    BodySettings ball = half_meter_ball({0, 1, 0});
    ball.drive = {.hz = 4};
    ball.motion.twist.linear.x() = speed;
    const BodyId body = world.add(ball);
    for (int i = 1; i <= 2400; ++i) {
      Motion target;
      target.pose.position = Vec3(speed * i / 240, 1, 0);
      target.twist.linear.x() = speed;
      world.set_target(body, target);
      world.step(1.0 / 240);
      CHECK(near(world.motion(body).pose.position, target.pose.position, 1e-12));
    }
    // It sleeps once the target stays.
    for (int i = 0; i < 2400; ++i) {
      Motion target;
      target.pose.position = Vec3(10 * speed, 1, 0);
      world.set_target(body, target);
      world.step(1.0 / 240);
    }
    CHECK(world.asleep(body));
  }
}

TEST_CASE("what rides on a platform slower than the sleep speed stays on it") {
  for (const double speed : {0.01, 1e-4}) {
    World world;
    BodySettings platform;
    platform.shape.solid = Box{Vec3(1, 0.1, 1)};
    platform.drive = Drive::keyed();
    platform.motion.pose.position.y() = -0.1;
    const BodyId floor = world.add(platform);
    BodySettings box;
    box.shape.solid = Box{Vec3(0.2, 0.2, 0.2)};
    box.motion.pose.position.y() = 0.2;
    const BodyId body = world.add(box);
    run_for(world, 2);
    CHECK(world.asleep(body));
    const double start = world.motion(body).pose.position.x();
    for (int i = 1; i <= 1200; ++i) {
      Motion target = platform.motion;
      target.pose.position.x() = speed * i / 240;
      target.twist.linear.x() = speed;
      world.set_target(floor, target);
      world.step(1.0 / 240);
    }
    CHECK(near(world.motion(body).pose.position.x() - start, speed * 5, 0.02 * speed));
    CHECK(near(world.twist(body).linear.x(), speed, 1e-3 * speed));
  }
}

TEST_CASE("a field that sets in moves what rested, however gently") {
  for (const double pull : {5.0, 0.03}) {
    World world({.gravity = Vec3::Zero()});
    const BodyId body = world.add(half_meter_ball({0, 0, 0}));
    run_for(world, 2);
    CHECK(world.asleep(body));
    world.add_force(Field([pull](double mass, const Vec3&, const Vec3&, double time) {
      return time >= 4 ? Vec3(mass * pull, 0, 0) : Vec3(0, 0, 0);
    }));
    run_for(world, 4);
    CHECK(near(world.twist(body).linear.x(), 2 * pull, 0.01 * pull));
  }
}

TEST_CASE("a spring that begins to pull moves what rested") {
  for (const double stiffness : {10.0, 0.02}) {
    World world({.gravity = Vec3::Zero()});
    const BodyId body = world.add(half_meter_ball({0, 0, 0}));
    BodySettings hook = half_meter_ball({3, 0, 0});
    hook.drive = Drive::keyed();
    const BodyId end = world.add(hook);
    world.add_force(Spring{.a = body, .b = end, .rest_length = 3, .stiffness = stiffness});
    run_for(world, 2);
    CHECK(world.asleep(body));
    Motion away = hook.motion;
    SUBCASE("when its other end is put elsewhere") {
      away.pose.position.x() = 4;
      world.set_motion(end, away);
    }
    SUBCASE("when its other end is led away slowly") {
      for (int i = 1; i <= 24000; ++i) {
        away.pose.position.x() = 3 + 0.01 * i / 240.0;
        away.twist.linear.x() = 0.01;
        world.set_target(end, away);
        world.step(1.0 / 240);
      }
    }
    run_for(world, 1);
    const double x = world.motion(body).pose.position.x();
    CHECK(x > 0.2 * std::min(stiffness, 1.0) * 0.5);
  }
}

TEST_CASE("what lies on a smooth floor is moved by the gentlest pull, and on a rough one falls asleep under it") {
  for (const double friction : {0.0, 0.5})
    for (const bool spring : {false, true}) {
      CAPTURE(friction);
      CAPTURE(spring);
      World world;
      world.add({.shape = {Plane{}}, .friction = friction, .fixed = true});
      BodySettings box;
      box.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
      box.density = 1;
      box.friction = friction;
      box.motion.pose.position = Vec3(0, 0.5, 0);
      const BodyId body = world.add(box);
      BodySettings hook = box;
      hook.drive = Drive::keyed();
      hook.motion.pose.position = Vec3(9, 0.5, 0);
      const BodyId end = world.add(hook);
      if (spring)
        world.add_force(Spring{.a = body, .b = end, .rest_length = 9 - 0.2, .stiffness = 0.2});
      else
        world.add_force(Push{.body = body, .force = {0.04, 0, 0}});
      run_for(world, 3);
      const double x = world.motion(body).pose.position.x();
      CHECK(world.asleep(body) == (friction > 0));
      if (friction > 0)
        CHECK(std::abs(x) < 1e-4);
      else
        CHECK(x == doctest::Approx(spring ? 0.2 * (1 - std::cos(std::sqrt(0.2) * 3)) : 0.04 * 9 / 2).epsilon(0.01));
    }
}

TEST_CASE("a sleeper wakes when something is put into it or its support is taken away") {
  World world;
  world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId body = world.add(half_meter_ball({0, 0.5, 0}));
  run_for(world, 2);
  REQUIRE(world.asleep(body));
  BodySettings wall;
  wall.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
  wall.motion.pose.position = Vec3(5, 0.5, 0);
  SUBCASE("a fixed body added") {
    wall.fixed = true;
    wall.motion.pose.position.x() = 0.9;
    world.add(wall);
  }
  SUBCASE("a keyed body added") {
    wall.drive = Drive::keyed();
    wall.motion.pose.position.x() = 0.9;
    world.add(wall);
  }
  SUBCASE("a fixed body moved") {
    wall.fixed = true;
    const BodyId other = world.add(wall);
    run_for(world, 1);
    REQUIRE(world.asleep(body));
    wall.motion.pose.position.x() = 0.9;
    world.set_motion(other, wall.motion);
  }
  world.step(1.0 / 240);
  CHECK(!world.asleep(body));
  run_for(world, 4);
  CHECK(world.motion(body).pose.position.x() < -0.099);
  CHECK(world.asleep(body));
}

TEST_CASE("bodies that overlap part at the push-out speed at most, and only then sleep") {
  for (const double rate : {240.0, 60.0})
    for (const double apart : {0.01, 0.4, 0.9, -1.0}) {
      World world({.gravity = apart < 0 ? Vec3(0, -9.81, 0) : Vec3(0, 0, 0)});
      BodyId first, second;
      if (apart < 0) {
        first = world.add({.shape = {Plane{}}, .fixed = true});
        BodySettings crate;
        crate.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
        second = world.add(crate);
      } else {
        first = world.add(half_meter_ball({0, 0, 0}));
        second = world.add(half_meter_ball({0, apart, 0}));
      }
      CAPTURE(apart);
      CAPTURE(rate);
      const auto gap = [&] {
        const double distance =
            world.motion(second).pose.position.y() - (apart < 0 ? 0 : world.motion(first).pose.position.y());
        return distance - (apart < 0 ? 0.5 : 1);
      };
      double before = gap(), fastest = 0;
      for (int i = 0; i < static_cast<int>(6 * rate); ++i) {
        world.step(1 / rate);
        fastest = std::max(fastest, (gap() - before) * rate);
        before = gap();
        if (world.asleep(second)) CHECK(gap() > -1.5e-3);
      }
      CHECK(fastest <= 0.5 + 1e-9);
      CHECK(world.asleep(second));
      CHECK(std::abs(gap()) < 1.5e-3);
    }
}
