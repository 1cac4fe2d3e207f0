#include <array>
#include <cmath>
#include <optional>

#include "physics/strategies/ground.h"

using namespace tweenfall;
using test::near;

namespace {

using Own = std::optional<Detection>;

constexpr std::array<Detection, 3> detections{Detection::discrete, Detection::ahead, Detection::time_of_impact};

BodySettings bullet(double z, Own own) {
  BodySettings settings = test::solid_at(Sphere{0.01}, Vec3(0.123, 0, z), 0.01);
  settings.motion.twist.linear = Vec3(300, 0, 0);
  settings.collision = own;
  return settings;
}

BodySettings wall(double z, Own own) {
  BodySettings settings = test::solid_at(Box{Vec3(0.005, 2, 0.4)}, Vec3(5, 0, z));
  settings.fixed = true;
  settings.collision = own;
  return settings;
}

/// A ball that is dropped from 2 m above its rest, and keeps 0.8 of its speed.
BodySettings dropped(double x, Own own) {
  BodySettings settings = test::solid_at(Sphere{0.1}, Vec3(x, 2.1, 0));
  settings.restitution = 0.8;
  settings.collision = own;
  return settings;
}

double height_of_second_apex() {
  return 0.1 + 2 * 0.64;
}

/// Time of the apex after the first rebound, s.
double time_of_second_apex() {
  const double down = std::sqrt(4 / 9.81);
  return down + 0.8 * down;
}

}  // namespace

TEST_CASE("each of two fast twins is found as it says, in one world and whatever that says") {
  for (const Detection of_world : detections) {
    CAPTURE(static_cast<int>(of_world));
    World world(test::weightless(test::with(ContactSolver::iterative, Parting::soft, of_world)));
    world.add(wall(0, {}));
    const BodyId late = world.add(bullet(-0.2, Detection::discrete)),
                 careful = world.add(bullet(0.2, Detection::time_of_impact));
    for (int step = 0; step < 30; ++step) {
      world.step(1.0 / 60);
      REQUIRE(world.motion(careful).pose.position.x() < 4.985 + 1e-6);
    }
    CHECK(near(world.motion(careful).pose.position.x(), 4.985, 1e-6));
    CHECK(near(world.motion(late).pose.position.x(), 0.123 + 300 * 0.5, 1e-9));
  }
}

TEST_CASE("of two bodies that say different things the more careful is believed, be it the faster one or the wall") {
  const auto passes = [](Detection of_world, Own of_bullet, Own of_wall) {
    World world(test::weightless(test::with(ContactSolver::iterative, Parting::soft, of_world)));
    world.add(wall(0, of_wall));
    const BodyId shot = world.add(bullet(0, of_bullet));
    for (int step = 0; step < 6; ++step) world.step(1.0 / 60);
    return world.motion(shot).pose.position.x() > 5;
  };
  for (const Detection of_world : detections)
    for (const Detection other : detections) {
      CAPTURE(static_cast<int>(of_world));
      CAPTURE(static_cast<int>(other));
      const bool late = other == Detection::discrete;
      CHECK(passes(of_world, Detection::discrete, other) == late);
      CHECK(passes(of_world, other, Detection::discrete) == late);
      CHECK(passes(of_world, {}, other) == late);
      CHECK(passes(of_world, other, {}) == late);
    }
}

TEST_CASE("only the ball that is watched to the time of its impact bounces as the closed form says") {
  for (const double dt : {1.0 / 7, 1.0 / 31, 1.0 / 60}) {
    CAPTURE(dt);
    WorldSettings settings = test::with(ContactSolver::iterative);
    settings.collision = Detection::discrete;
    World world(settings);
    test::add_floor(world, 0.8);
    const BodyId careful = world.add(dropped(0, Detection::time_of_impact)),
                 ahead = world.add(dropped(1, Detection::ahead)), late = world.add(dropped(2, {}));
    // The last step ends at the apex, where an error of the time does not count.
    const int steps = static_cast<int>(time_of_second_apex() / dt);
    for (int step = 0; step < steps; ++step) world.step(dt);
    world.step(time_of_second_apex() - steps * dt);
    const auto error = [&](BodyId ball) {
      return std::abs(world.motion(ball).pose.position.y() - height_of_second_apex());
    };
    CHECK(error(careful) < 2e-6);
    CHECK(error(ahead) > 1e-4);
    CHECK(error(late) > 1e-4);
  }
}

TEST_CASE("what is found late hands its momentum on to what is found ahead, and stands on it") {
  WorldSettings settings = test::weightless(test::with(ContactSolver::iterative));
  World world(settings);
  BodySettings block = test::solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0, 0, 0), 3);
  const BodyId first = world.add(block);
  block.motion.pose.position.x() = 1;
  const BodyId second = world.add(block);
  BodySettings ball = test::solid_at(Sphere{0.2}, Vec3(-2.03, 0, 0), 2);
  ball.motion.twist.linear = Vec3(6, 0, 0);
  ball.collision = Detection::discrete;
  const BodyId thrown = world.add(ball);
  for (int step = 0; step < 60; ++step) world.step(1.0 / 60);
  // 2 kg at 6 m/s, then 8 kg.
  for (const BodyId body : {first, second, thrown}) CHECK(near(world.twist(body).linear, Vec3(1.5, 0, 0), 1e-9));

  World ground(test::with(ContactSolver::iterative));
  test::add_floor(ground);
  const std::vector<BodyId> stack = test::add_stack(ground, 2);
  BodySettings top = test::solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0, 2.5, 0));
  top.collision = Detection::discrete;
  const BodyId upper = ground.add(top);
  for (int step = 0; step < 300; ++step) ground.step(1.0 / 60);
  CHECK(near(ground.motion(stack[1]).pose.position, Vec3(0, 1.5, 0), 5e-3));
  CHECK(near(ground.motion(upper).pose.position, Vec3(0, 2.5, 0), 5e-3));
}

TEST_CASE(
    "a body that asks for what the step does anyway changes no bit, and the last that asks for more is let go of") {
  const auto played = [](Own own, bool visited) {
    World world;
    test::add_floor(world);
    for (int i = 0; i < 4; ++i) {
      BodySettings box = test::solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0.1 * i, 0.5 + 1.1 * i, 0));
      box.collision = own;
      world.add(box);
    }
    if (visited) world.remove(world.add(bullet(9, Detection::time_of_impact)));
    for (int step = 0; step < 120; ++step) world.step(1.0 / 60);
    std::vector<Motion> motions;
    for (const BodyId body : world.bodies()) motions.push_back(world.motion(body));
    return motions;
  };
  const std::vector<Motion> plain = played({}, false), same = played(Detection::ahead, false), alone = played({}, true);
  REQUIRE(plain.size() == same.size());
  REQUIRE(plain.size() == alone.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CHECK(plain[i].pose.position == same[i].pose.position);
    CHECK(plain[i].pose.position == alone[i].pose.position);
    CHECK(plain[i].pose.rotation.coeffs() == alone[i].pose.rotation.coeffs());
  }
}

TEST_CASE("bodies far from one that is found in its own way keep their bits, awake or asleep, whatever moves them") {
  enum class Far { none, careful, late };
  const auto played = [](Far far, Integrator integrator) {
    World world({.integrator = integrator});
    test::add_floor(world, 0.5);
    std::vector<BodyId> watched = test::add_stack(world, 5);
    // Thrown along a floor, thrown at a wall, and hung on a spring.
    for (int i = 0; i < 6; ++i) {
      BodySettings ball = test::solid_at(Sphere{0.2}, Vec3(4 + 2 * i, 1 + 0.3 * i, 3));
      ball.motion.twist.linear = Vec3(3, 0, 20 * (i % 2));
      ball.restitution = 0.5;
      watched.push_back(world.add(ball));
    }
    BodySettings barrier = test::solid_at(Box{Vec3(20, 4, 0.05)}, Vec3(0, 4, 8));
    barrier.fixed = true;
    world.add(barrier);
    const BodyId hung = world.add(test::solid_at(Box{Vec3(0.3, 0.3, 0.3)}, Vec3(-8, 3, 0)));
    world.add_force(Spring{.a = hung, .anchor_b = Vec3(-8, 5, 0), .rest_length = 1, .stiffness = 200, .damping = 3});
    watched.push_back(hung);
    if (far != Far::none) {
      const Own own = far == Far::careful ? Detection::time_of_impact : Detection::discrete;
      BodySettings shot = bullet(1000, own);
      shot.motion.pose.position.y() = 1;
      world.add(shot);
      world.add(wall(1000, {}));
      BodySettings bouncing = dropped(1000, own);
      world.add(bouncing);
    }
    std::vector<Motion> motions;
    for (int step = 0; step < 300; ++step) {
      world.step(1.0 / 60);
      for (const BodyId body : watched) motions.push_back(world.motion(body));
    }
    return motions;
  };
  for (const Integrator integrator : {Integrator{}, Integrator::rk4}) {
    const std::vector<Motion> alone = played(Far::none, integrator);
    for (const Far far : {Far::careful, Far::late}) {
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(static_cast<int>(far));
      const std::vector<Motion> beside = played(far, integrator);
      REQUIRE(beside.size() == alone.size());
      for (std::size_t i = 0; i < alone.size(); ++i) {
        CAPTURE(i);
        REQUIRE(beside[i].pose.position == alone[i].pose.position);
        REQUIRE(beside[i].pose.rotation.coeffs() == alone[i].pose.rotation.coeffs());
        REQUIRE(beside[i].twist.linear == alone[i].twist.linear);
        REQUIRE(beside[i].twist.angular == alone[i].twist.angular);
      }
    }
  }
}

TEST_CASE("collisions of bodies are hashed, and a world with them steps on with the same bits after it was loaded") {
  const auto made = [](Own own) {
    World world(test::with(ContactSolver::iterative));
    test::add_floor(world, 0.8);
    world.add(dropped(0, own));
    world.add(dropped(0.15, Detection::discrete));
    return world;
  };
  CHECK(made(Detection::time_of_impact).state_hash() != made(Detection::discrete).state_hash());
  CHECK(made(Detection::ahead).state_hash() != made({}).state_hash());
  World world = made(Detection::time_of_impact);
  for (int step = 0; step < 25; ++step) world.step(1.0 / 60);
  World loaded;
  loaded.load(world.save());
  for (int step = 0; step < 60; ++step) {
    world.step(1.0 / 60);
    loaded.step(1.0 / 60);
    REQUIRE(world.state_hash() == loaded.state_hash());
  }
}

TEST_CASE("a collision of its own is refused where it would mean nothing") {
  BodySettings sensor = test::solid_at(Sphere{0.1}, Vec3(0, 0, 0));
  sensor.sensor = true;
  sensor.collision = Detection::ahead;
  World world;
  CHECK_THROWS_WITH(world.add(sensor),
                    "a sensor takes no collision of its own: it notices what overlaps it at the end of a step");
  BodySettings unknown = test::solid_at(Sphere{0.1}, Vec3(0, 0, 0));
  unknown.collision = static_cast<Detection>(3);
  CHECK_THROWS_WITH(world.add(unknown), "there is no such collision detection");
  WorldSettings plane;
  plane.plane = WorldPlane::xy;
  World flat(plane);
  BodySettings ball = test::solid_at(Sphere{0.1}, Vec3(0, 0, 0));
  ball.collision = Detection::discrete;
  CHECK_THROWS_WITH(flat.add(ball), "in a plane there is one collision detection: a body takes none of its own");
}
