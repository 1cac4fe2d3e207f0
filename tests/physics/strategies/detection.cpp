#include <array>
#include <cmath>
#include <limits>

#include "physics/strategies/ground.h"

using namespace tweenfall;
using test::near;

namespace {

/// How far a bullet of this speed, m/s, gets through a wall of 1 cm at x = 5, in steps of 1/60 s.
double reached_by(Detection collision, double speed) {
  World world(test::weightless(test::with(ContactSolver::iterative, Parting::soft, collision)));
  BodySettings wall = test::solid_at(Box{Vec3(0.005, 2, 2)}, Vec3(5, 0, 0));
  wall.fixed = true;
  world.add(wall);
  BodySettings bullet = test::solid_at(Sphere{0.01}, Vec3(0.123, 0, 0), 0.01);
  bullet.motion.twist.linear = Vec3(speed, 0, 0);
  const BodyId shot = world.add(bullet);
  double most = 0;
  for (int step = 0; step < 60; ++step) {
    world.step(1.0 / 60);
    most = std::max(most, world.motion(shot).pose.position.x());
  }
  return most;
}

/// Height of a ball of 0.1 m that is dropped from `height` above its rest and keeps e of its speed: closed form.
double bounced(double height, double e, double time) {
  double from = 0, up = 0, start = height;
  double flight = std::sqrt(2 * height / 9.81);
  while (time > from + flight) {
    from += flight;
    up = e * (up == 0 && start > 0 ? std::sqrt(2 * 9.81 * start) : up);
    start = 0;
    flight = 2 * up / 9.81;
  }
  const double t = time - from;
  return start + up * t - 0.5 * 9.81 * t * t;
}

}  // namespace

TEST_CASE("what is fast passes through a thin wall where overlap is looked for after the step, and stops elsewhere") {
  for (const double speed : {30.0, 300.0, 1000.0}) {
    CHECK(reached_by(Detection::discrete, speed) > 10);
    CHECK(reached_by(Detection::ahead, speed) < 5);
    CHECK(reached_by(Detection::time_of_impact, speed) < 5);
  }
}

TEST_CASE("a dropped ball bounces at the closed form's times by times of impact, however long the steps are") {
  for (const double dt : {1.0 / 7, 1.0 / 60, 1.0 / 240}) {
    CAPTURE(dt);
    World world(test::with(ContactSolver::sequential, Parting::half, Detection::time_of_impact));
    test::add_floor(world, 0.8);
    BodySettings ball = test::solid_at(Sphere{0.1}, Vec3(0, 2.1, 0));
    ball.restitution = 0.8;
    const BodyId dropped = world.add(ball);
    const int steps = static_cast<int>(2.5 / dt);
    for (int step = 1; step <= steps; ++step) {
      world.step(dt);
      REQUIRE(near(world.motion(dropped).pose.position.y() - 0.1, bounced(2, 0.8, step * dt), 2e-6));
    }
  }
}

TEST_CASE("a blow within a step is told with its impulse, also of bodies that have left each other at its end") {
  World world(test::with(ContactSolver::sequential, Parting::half, Detection::time_of_impact));
  test::add_floor(world, 1);
  BodySettings ball = test::solid_at(Sphere{0.1}, Vec3(0, 0.4, 0), 2);
  ball.restitution = 1;
  ball.motion.twist.linear = Vec3(0, -20, 0);
  world.add(ball);
  world.step(0.1);
  const double speed = std::sqrt(20.0 * 20 + 2 * 9.81 * 0.3);
  REQUIRE(world.contacts().size() == 1);
  CHECK(near(world.contacts()[0].impulse, 2 * 2 * speed, 1e-4));
  CHECK(near(world.contacts()[0].approach_speed, speed, 1e-5));
  CHECK(world.contacts()[0].began);
  world.step(0.1);
  CHECK(world.contacts().empty());
  CHECK(world.ended_contacts().size() == 1);
}

TEST_CASE("balls in a box keep their energy and momentum from impact to impact") {
  World world(test::weightless(test::with(ContactSolver::sequential, Parting::half, Detection::time_of_impact)));
  test::Random random(3);
  std::vector<BodyId> balls;
  for (int i = 0; i < 27; ++i) {
    const Vec3 place(i % 3, i / 3 % 3, i / 9);
    const double vx = random.between(-9, 9), vy = random.between(-9, 9), vz = random.between(-9, 9);
    BodySettings ball = test::solid_at(Sphere{0.3}, place, random.between(0.5, 2));
    ball.restitution = 1;
    ball.friction = 0;
    ball.motion.twist.linear = Vec3(vx, vy, vz);
    balls.push_back(world.add(ball));
  }
  Vec3 momentum = Vec3::Zero();
  for (const BodyId ball : balls) momentum += world.mass(ball).mass * world.twist(ball).linear;
  const double energy = world.kinetic_energy();
  std::size_t met = 0;
  for (int step = 0; step < 120; ++step) {
    world.step(1.0 / 30);
    met += world.contacts().size();
  }
  CHECK(met > 10);
  for (const BodyId ball : balls) momentum -= world.mass(ball).mass * world.twist(ball).linear;
  CHECK(momentum.norm() < 1e-11);
  CHECK(near(world.kinetic_energy() / energy, 1, 1e-9));
}

TEST_CASE("a cradle hands its blow on to the last ball by times of impact") {
  World world(test::weightless(test::with(ContactSolver::sequential, Parting::half, Detection::time_of_impact)));
  std::vector<BodyId> balls;
  for (int i = 0; i < 5; ++i) {
    BodySettings ball = test::solid_at(Sphere{0.5}, Vec3(i == 0 ? -0.37 : i * 1.001, 0, 0));
    ball.restitution = 1;
    ball.friction = 0;
    if (i == 0) ball.motion.twist.linear = Vec3(3, 0, 0);
    balls.push_back(world.add(ball));
  }
  for (int step = 0; step < 60; ++step) world.step(1.0 / 60);
  for (std::size_t i = 0; i < 5; ++i) CHECK(near(world.twist(balls[i]).linear.x(), i == 4 ? 3 : 0, 1e-9));
}

TEST_CASE("a keyed bat meets a ball at its own speed within the step, and ends on its target") {
  World world(test::weightless(test::with(ContactSolver::sequential, Parting::half, Detection::time_of_impact)));
  BodySettings bat = test::solid_at(Box{Vec3(0.1, 1, 1)}, Vec3(0, 0, 0));
  bat.drive = Drive::keyed();
  const BodyId keyed = world.add(bat);
  BodySettings ball = test::solid_at(Sphere{0.1}, Vec3(0.45, 0, 0));
  ball.restitution = 0.5;
  const BodyId struck = world.add(ball);
  const double dt = 0.1, speed = 5;
  Motion target;
  target.pose.position = Vec3(speed * dt, 0, 0);
  target.twist.linear = Vec3(speed, 0, 0);
  world.set_motion(keyed, {.pose = {}, .twist = target.twist});
  world.set_target(keyed, target);
  world.step(dt);
  CHECK(world.motion(keyed).pose.position == target.pose.position);
  // It is hit after 0.25 m, at 0.05 s, and leaves at (1 + e) of the bat's speed.
  CHECK(near(world.twist(struck).linear.x(), 1.5 * speed, 1e-9));
  CHECK(near(world.motion(struck).pose.position.x(), 0.45 + 1.5 * speed * 0.05, 1e-5));
}

TEST_CASE("every choice of strategies keeps whatever is thrown together finite, and it comes to rest") {
  for (const ContactSolver solver :
       {ContactSolver::iterative, ContactSolver::sequential, ContactSolver::shock, ContactSolver::lcp})
    for (const Parting separation :
         {Parting::soft, Parting::half, Parting::by_mass, Parting::positional_impulse, Parting::closest_point})
      for (const Detection collision : {Detection::ahead, Detection::discrete, Detection::time_of_impact}) {
        CAPTURE(static_cast<int>(solver));
        CAPTURE(static_cast<int>(separation));
        CAPTURE(static_cast<int>(collision));
        World world(test::with(solver, separation, collision));
        test::add_floor(world);
        test::Random random(5);
        const std::array<Solid, 4> solids{Sphere{0.3}, Box{Vec3(0.2, 0.3, 0.25)}, Capsule{0.15, 0.2},
                                          Cylinder{0.3, 0.2}};
        for (int i = 0; i < 10; ++i) {
          const double x = random.between(-0.4, 0.4), y = random.between(0.3, 2), z = random.between(-0.4, 0.4);
          BodySettings body = test::solid_at(solids[static_cast<std::size_t>(i % 4)], Vec3(x, y, z), 1 + i % 3);
          body.restitution = 0.2;
          body.motion.twist.angular = Vec3(random.between(-5, 5), 0, 1);
          world.add(body);
        }
        for (int step = 0; step < 180; ++step) world.step(1.0 / 60);
        double fastest = 0;
        for (const BodyId body : world.bodies()) fastest = std::max(fastest, world.twist(body).linear.norm());
        CHECK(fastest < 20);
      }
}

TEST_CASE("a world that goes by strategies steps on with the same bits after it was loaded") {
  for (const Detection collision : {Detection::ahead, Detection::discrete, Detection::time_of_impact}) {
    World world(test::with(ContactSolver::lcp, Parting::by_mass, collision));
    test::add_floor(world);
    test::add_stack(world, 4);
    BodySettings ball = test::solid_at(Sphere{0.3}, Vec3(-3, 2, 0.1));
    ball.motion.twist.linear = Vec3(6, 1, 0);
    ball.restitution = 0.5;
    world.add(ball);
    for (int i = 0; i < 40; ++i) world.step(1.0 / 60);
    World loaded;
    loaded.load(world.save());
    for (int i = 0; i < 40; ++i) {
      world.step(1.0 / 60);
      loaded.step(1.0 / 60);
      REQUIRE(world.state_hash() == loaded.state_hash());
    }
  }
}
