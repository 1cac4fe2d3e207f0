#include <tweenfall/physics/particles.h>

#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <limits>
#include <set>

#include "curves/counted_allocations.h"
#include "physics/step/methods.h"
#include "processor_time.h"
#include "support.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

void run(Particles& particles, double seconds, int steps, const World* world = nullptr) {
  for (int i = 0; i < steps; ++i) {
    if (world)
      particles.step(seconds / steps, *world);
    else
      particles.step(seconds / steps);
  }
}

World with_floor(double restitution, double friction) {
  World world;
  BodySettings floor;
  floor.shape.solid = Plane{};
  floor.fixed = true;
  floor.restitution = restitution;
  floor.friction = friction;
  world.add(floor);
  return world;
}

}  // namespace

TEST_CASE("a particle is where the lecture's table of the projectile says, second after second") {
  Particles particles({.gravity = Vec3(0, -1, 0)});
  particles.emit(Vec3(0, 0, 0), Vec3(3, 4, 0));
  const double heights[] = {3.5, 6, 7.5, 8, 7.5, 6, 3.5, 0};
  for (int second = 1; second <= 8; ++second) {
    particles.step(1);
    CHECK(near(particles.position(0), Vec3(3.0 * second, heights[second - 1], 0), 1e-13));
  }
}

TEST_CASE("each integrator of particles comes nearer to a planet's year by its order") {
  const auto off = [](Integrator integrator, int steps) {
    Particles particles({.gravity = Vec3(0, 0, 0), .integrator = integrator});
    particles.emit(Vec3(0.7, 0, 0), Vec3(0, 2 * pi * std::sqrt(1.3 / 0.7), 0));
    particles.add_force(Attractor{.acceleration = 4 * pi * pi});
    run(particles, 0.25, steps);
    // The ellipse of a = 1, e = 0.3 a quarter year later: E - e sin E = pi / 2.
    double anomaly = pi / 2;
    for (int i = 0; i < 50; ++i) anomaly = pi / 2 + 0.3 * std::sin(anomaly);
    return (particles.position(0) - Vec3(std::cos(anomaly) - 0.3, std::sqrt(0.91) * std::sin(anomaly), 0)).norm();
  };
  for (const test::Method& method : test::methods) {
    CAPTURE(std::string(method.name));
    const double order = std::log2(off(method.integrator, 400) / off(method.integrator, 800));
    CHECK(std::abs(order - method.order) < 0.15);
  }
}

TEST_CASE("drag, winds and formulas do to particles what they do to bodies") {
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::rk4, Integrator::verlet,
                                      Integrator::backward_euler, Integrator::implicit_trapezoid}) {
    WorldSettings settings;
    settings.integrator = integrator;
    World world(settings);
    BodySettings ball;
    ball.shape.solid = Sphere{0.1};
    ball.mass = 0.2;
    ball.motion.twist.linear = Vec3(4, 5, 0);
    const BodyId body = world.add(ball);
    Particles particles({.integrator = integrator, .mass = 0.2, .radius = 0.1});
    particles.emit(Vec3(0, 0, 0), Vec3(4, 5, 0));
    const Strength ramp = keyed_curve<double>({{0, 0, Ease::smooth()}, {1, 1}});
    const std::pair<Force, Strength> forces[] = {
        {Drag{.linear = 0.05, .quadratic = 0.01}, 1},
        {Wind{.velocity = Vec3(0, 0, 3), .linear = 0.1, .coefficient = 0.5}, ramp},
        {Vortex{.at = Vec3(1, 0, 0), .acceleration = 3, .inward = 0.4, .softening = 0.2}, 1},
        {ForceFormula({"sin(3*t)", "-0.1*y", "mass"}), 1}};
    for (const auto& [force, strength] : forces) {
      world.add_force(force, {{}, strength});
      particles.add_force(force, strength);
    }
    for (int i = 0; i < 60; ++i) {
      world.step(1.0 / 60);
      particles.step(1.0 / 60);
    }
    // At the end of a step, formulas and vortices are evaluated with what each knows of it.
    CHECK(near(particles.position(0), world.motion(body).pose.position, 1e-9));
    CHECK(near(particles.velocity(0), world.twist(body).linear, 1e-9));
  }
}

TEST_CASE("a particle bounces off a plane when the closed form says, as often as there are bounces in the time") {
  const World world = with_floor(0, 0);
  for (const int steps : {7, 60, 240}) {
    Particles particles({.restitution = 0.8, .friction = 0});
    particles.emit(Vec3(0, 2, 0), Vec3(1.5, 0, 0));
    run(particles, 2, steps, &world);
    // Falls for sqrt(2 h / g), then flies for 2 v e^n / g each time.
    const double first = std::sqrt(4 / 9.81), speed = 9.81 * first;
    double begun = first, up = 0.8 * speed;
    while (begun + 2 * up / 9.81 < 2) {
      begun += 2 * up / 9.81;
      up *= 0.8;
    }
    const double since = 2 - begun;
    CHECK(near(particles.position(0), Vec3(3, up * since - 0.5 * 9.81 * since * since, 0), 1e-8));
    CHECK(near(particles.velocity(0), Vec3(1.5, up - 9.81 * since, 0), 1e-8));
  }
}

TEST_CASE("a particle that wind presses into a corner comes to rest on the ground and at the wall") {
  World world = with_floor(0, 0);
  BodySettings wall;
  wall.shape.solid = Box{Vec3(1, 1, 1)};
  wall.fixed = true;
  wall.motion.pose.position = Vec3(5, 1, 0);
  world.add(wall);
  Particles particles({.radius = 0.01});
  particles.add_force(Wind{.velocity = Vec3(1, 0, 0), .linear = 1e-3});
  for (int i = 0; i < 5; ++i) particles.emit(Vec3(3.5 + 0.05 * i, 0.5 + 0.1 * i, 0.2 * i), Vec3(0.2 * i, -0.5 * i, 0));
  for (int step = 0; step < 360; ++step) {
    particles.step(1.0 / 60, world);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      REQUIRE(particles.y()[i] > 0.01 - 1e-9);
      REQUIRE(particles.x()[i] < 3.99 + 1e-8);
    }
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    CHECK(near(particles.x()[i], 3.99, 1e-9));
    CHECK(near(particles.y()[i], 0.01, 1e-9));
    CHECK(particles.velocity(i).norm() < 1e-9);
  }
}

TEST_CASE("friction takes mu (1 + e) v of what slides, and a particle at rest on a slope stays below atan mu alone") {
  World world = with_floor(0.5, 0.2);
  Particles particles({.gravity = Vec3(0, 0, 0), .restitution = 0.5, .friction = 0.2});
  particles.emit(Vec3(0, 1, 0), Vec3(4, -2, 3));
  run(particles, 1, 3, &world);
  // 5 m/s along, less 0.2 * 1.5 * 2.
  CHECK(near(particles.velocity(0), Vec3(4 * 0.88, 1, 3 * 0.88), 1e-12));
  for (const double slope : {0.15, 0.25}) {
    Particles lying(
        {.gravity = 9.81 * Vec3(std::sin(std::atan(slope)), -std::cos(std::atan(slope)), 0), .friction = 0.2});
    lying.emit(Vec3(0, 0, 0), Vec3(0, 0, 0));
    run(lying, 1, 60, &world);
    const double pull = std::max(0.0, 9.81 * (std::sin(std::atan(slope)) - 0.2 * std::cos(std::atan(slope))));
    CHECK(near(lying.position(0), Vec3(0.5 * pull, 0, 0), 1e-4));
    CHECK(near(lying.velocity(0).x(), pull, 1e-4));
  }
}

TEST_CASE("particles keep out of boxes, balls and hulls, and a body that moves throws them") {
  World world;
  WorldSettings still;
  still.gravity = Vec3(0, 0, 0);
  world = World(still);
  BodySettings body;
  body.fixed = true;
  body.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
  world.add(body);
  body.shape.solid = Sphere{0.5};
  body.motion.pose.position = Vec3(3, 0, 0);
  world.add(body);
  for (const double radius : {0.0, 0.05}) {
    CAPTURE(radius);
    Particles particles({.gravity = Vec3(0, 0, 0), .radius = radius, .restitution = 1, .friction = 0});
    particles.emit(Vec3(0.1, 2, 0.2), Vec3(0, -10, 0));
    particles.emit(Vec3(3 + 0.5 * std::sqrt(0.5) + radius * std::sqrt(0.5), 2, 0), Vec3(0, -10, 0));
    run(particles, 0.4, 3, &world);
    CHECK(near(particles.velocity(0), Vec3(0, 10, 0), 1e-9));
    CHECK(near(particles.position(0).y(), 0.5 + radius + 4 - (1.5 - radius), 1e-8));
    // It bounces at 45 degrees and leaves at a right angle.
    CHECK(near(particles.velocity(1), Vec3(10, 0, 0), 1e-7));
  }
  BodySettings bat;
  bat.drive = Drive::keyed();
  bat.shape.solid = Box{Vec3(0.1, 1, 1)};
  bat.motion.pose.position = Vec3(-5, 0, 0);
  bat.motion.twist.linear = Vec3(3, 0, 0);
  const BodyId moving = world.add(bat);
  Particles thrown({.gravity = Vec3(0, 0, 0), .restitution = 1, .friction = 0});
  thrown.emit(Vec3(-4.5, 0, 0), Vec3(-1, 0, 0));
  for (int i = 1; i <= 30; ++i) {
    Motion target = bat.motion;
    target.pose.position.x() += 3 * i / 60.0;
    world.set_target(moving, target);
    world.step(1.0 / 60);
    thrown.step(1.0 / 60, world);
  }
  // 2 u - v
  CHECK(near(thrown.velocity(0), Vec3(7, 0, 0), 1e-9));
}

TEST_CASE("emitters let go when the integral of their rate says, from where their curve is, with its velocity") {
  Emitter emitter;
  emitter.rate = keyed_curve<double>({{0, 0, Ease::linear()}, {2, 100}});
  emitter.position = keyed_curve<Vec3>({{0, Vec3(0, 0, 0), Ease::linear()}, {2, Vec3(8, 2, 0), Ease::linear()}});
  emitter.velocity = Curve<Vec3>(Vec3(0, 3, 0));
  emitter.rotation = Curve<Quat>(exp_map(Vec3(pi / 2, 0, 0)));
  for (const int steps : {1, 7, 120}) {
    Particles particles({.gravity = Vec3(0, 0, 0)});
    particles.add(emitter);
    run(particles, 2, steps);
    // 25 t^2 of them: particle k leaves at sqrt(k) / 5.
    REQUIRE(particles.size() == 100);
    for (std::size_t i = 0; i < 100; ++i) {
      const double at = std::sqrt(static_cast<double>(i + 1)) / 5;
      CHECK(near(particles.born()[i], at, 1e-9));
      CHECK(near(particles.velocity(i), Vec3(4, 1, 3), 1e-9));
      CHECK(near(particles.position(i), Vec3(8, 2, 3 * (2 - at)), 1e-8));
    }
    CHECK(near(particles.momentum(), 0.1 * Vec3(4, 1, 3), 1e-9));
  }
}

TEST_CASE("a rate by a formula goes on for hours, by its integral, and a jump of time of any length ends") {
  Particles rain({.gravity = {0, 0, 0}, .life = 1});
  rain.add({.rate = expression_curve(Expression("2+cos(t/100)"))});
  Particles whole = rain;
  for (const double time : {100.0, 599.0, 601.0, 1800.0, 5000.0}) {
    while (rain.time() < time) rain.step(std::min(7.3, time - rain.time()));
    CHECK(std::abs(static_cast<double>(rain.emitted()) + 0.5 - 2 * time - 100 * std::sin(time / 100)) < 0.51);
  }
  whole.step(5000);
  CHECK(whole.emitted() == rain.emitted());
  whole.step(1e300);
  CHECK(std::isfinite(whole.time()));
  // One that starts late starts at zero, and one whose formula turns negative stops for that stretch.
  Particles late({.gravity = {0, 0, 0}, .life = 1});
  late.step(1500);
  late.add({.rate = expression_curve(Expression("1"))});
  late.add({.rate = expression_curve(Expression("700-t"))});
  late.step(10);
  CHECK(late.emitted() == 10);
}

TEST_CASE("a stream has rate times life of particles, each dies at its age, and what chance there is comes of a seed") {
  Emitter emitter;
  emitter.rate = Curve<double>(250.0);
  emitter.velocity = Curve<Vec3>(Vec3(0, 4, 0));
  emitter.spread = pi / 6;
  emitter.speed_spread = 0.25;
  emitter.size = 0.3;
  const ParticleSettings settings{.gravity = Vec3(0, 0, 0), .life = 0.5, .seed = 42};
  Particles particles(settings), split(settings), other({.gravity = Vec3(0, 0, 0), .life = 0.5, .seed = 43});
  for (Particles* each : {&particles, &split, &other}) each->add(emitter);
  run(particles, 2.001, 100);
  run(split, 2.001, 37);
  run(other, 2.001, 100);
  CHECK(particles.emitted() == 500);
  CHECK(particles.size() == 125);
  REQUIRE(split.size() == 125);
  double apart = 0;
  std::set<std::uint64_t> numbers;
  Vec3 mean(0, 0, 0);
  for (std::size_t i = 0; i < 125; ++i) {
    CHECK(particles.numbers()[i] == split.numbers()[i]);
    CHECK(near(particles.position(i), split.position(i), 1e-9));
    apart = std::max(apart, (particles.velocity(i) - other.velocity(i)).norm());
    numbers.insert(particles.numbers()[i]);
    const Vec3 velocity = particles.velocity(i);
    CHECK(velocity.normalized().y() >= std::cos(pi / 6) - 1e-12);
    CHECK(std::abs(velocity.norm() - 4) <= 1 + 1e-12);
    CHECK((particles.position(i) - (2.001 - particles.born()[i]) * velocity).norm() <= 0.3 + 1e-9);
    mean += velocity / 125;
  }
  CHECK(numbers.size() == 125);
  CHECK(apart > 0.1);
  // The mean of the heights of a cone is half of 1 plus its edge's.
  CHECK(near(mean.y(), 2 * (1 + std::cos(pi / 6)), 0.05));
  Particles copy = particles;
  run(particles, 1, 60);
  run(copy, 1, 60);
  for (std::size_t i = 0; i < copy.size(); ++i) CHECK(particles.position(i) == copy.position(i));
}

TEST_CASE("many particles under formulas move as each would alone, to the last bit, and a step takes no memory") {
  const ForceFormula formulas[] = {
      ForceFormula({"-mass*sin(3*x + t)", "mass*cos(2*y)*exp(-0.1*z^2)", "floor(x) - 0.1*vz*abs(y)^1.5"}),
      ForceFormula({"1/x", "log(y)", "z^z*step(0.02, t)"}), ForceFormula::potential("mass*(x^2*y + abs(z - x)*t)")};
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::rk4, Integrator::backward_euler}) {
    const ParticleSettings settings{.integrator = integrator, .mass = 0.3};
    Particles together(settings);
    std::vector<Particles> alone;
    for (int i = 0; i < 300; ++i) {
      const Vec3 place(0.03 * (i % 37) - 0.5, 0.1 * (i % 11), 0.7 - 0.01 * i), velocity(0.1 * (i % 5), -0.2, 0.3);
      together.emit(place, velocity);
      alone.emplace_back(settings).emit(place, velocity);
    }
    for (const ForceFormula& formula : formulas) {
      together.add_force(formula, 0.7);
      for (Particles& one : alone) one.add_force(formula, 0.7);
    }
    run(together, 0.05, 3);
    for (Particles& one : alone) run(one, 0.05, 3);
    REQUIRE(together.size() == alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      REQUIRE(together.position(i) == alone[i].position(0));
      REQUIRE(together.velocity(i) == alone[i].velocity(0));
    }
    const std::size_t before = test::allocations();
    together.step(1.0 / 60);
    CHECK(test::allocations() == before);
  }
}

TEST_CASE("once there are as many particles as there may be, what stays out takes no time") {
  Emitter emitter;
  emitter.rate = Curve<double>(1e9);
  Particles particles({.life = std::numeric_limits<double>::infinity(), .most = 20000});
  particles.add(emitter);
  Particles alone({.life = std::numeric_limits<double>::infinity()});
  for (int i = 0; i < 20000; ++i) alone.emit(Vec3(0, 0, 0), Vec3(0, 0, 0));
  const double begin = test::processor_seconds();
  run(alone, 1, 2000);
  const double flown = test::processor_seconds();
  run(particles, 1, 2000);
  CHECK(particles.size() == 20000);
  CHECK(particles.emitted() - particles.left_out() == 20000);
  CHECK(std::abs(static_cast<double>(particles.emitted()) - 1e9) < 10);
  CHECK(test::processor_seconds() - flown < 4 * (flown - begin));
}

TEST_CASE("of too many particles those that would be more stay out, and what cannot be is refused") {
  Emitter emitter;
  emitter.rate = Curve<double>(1e8);
  Particles particles({.most = 1000});
  particles.add(emitter);
  particles.step(1);
  CHECK(particles.size() == 1000);
  CHECK(particles.emitted() == 100000000);
  CHECK(particles.left_out() == 100000000 - 1000);
  const double none = std::nan("");
  CHECK_THROWS_AS(Particles({.mass = 0}), std::invalid_argument);
  CHECK_THROWS_AS(Particles({.restitution = 2}), std::invalid_argument);
  CHECK_THROWS_AS(Particles({.life = none}), std::invalid_argument);
  CHECK_THROWS_AS(particles.emit(Vec3(none, 0, 0), Vec3(0, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS(particles.step(none), std::invalid_argument);
  CHECK_THROWS_AS(particles.add_force(Spring{}), std::invalid_argument);
  CHECK_THROWS_AS(particles.add_force(Buoyancy{}), std::invalid_argument);
  emitter.rate = keyed_curve<double>({{0, 1, Ease::linear()}, {1, -1}});
  CHECK_THROWS_AS(particles.add(emitter), std::invalid_argument);
  // A particle beyond all bounds is gone.
  Particles lost({.gravity = Vec3(0, 0, 0)});
  lost.add_force(ForceFormula({"1e30*x^9", "0", "0"}));
  lost.emit(Vec3(1e3, 0, 0), Vec3(0, 0, 0));
  run(lost, 1, 10);
  CHECK(lost.size() == 0);
}
