#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/scene.h"
#include "physics/step/methods.h"

using namespace tweenfall;
using test::Method;
using test::methods;
using test::near;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// By how many powers of two an error decreases when the step is halved.
double order_of(double coarse, double fine) {
  return std::log2(coarse / fine);
}

WorldSettings without_gravity(Integrator integrator) {
  WorldSettings settings;
  settings.integrator = integrator;
  settings.gravity = Vec3::Zero();
  settings.sleep_after = never;
  return settings;
}

/// A body of 2 kg on a spring of 32 N/m about the origin, released at 1 m: its position is cos 4 t.
double error_on_a_spring(Integrator integrator, int steps) {
  World world(without_gravity(integrator));
  BodySettings settings;
  settings.mass = 2;
  settings.motion.pose.position = Vec3(1, 0, 0);
  const BodyId body = world.add(settings);
  world.add_force(Spring{.a = body, .stiffness = 32});
  for (int i = 0; i < steps; ++i) world.step(1.0 / steps);
  return std::abs(world.motion(body).pose.position.x() - std::cos(4.0));
}

/// Around a sun of 4 pi^2 on an ellipse of eccentricity .3, for a year: it is back where it was.
double error_after_a_year(Integrator integrator, int steps) {
  World world(without_gravity(integrator));
  const double sun = 4 * test::pi * test::pi;
  BodySettings planet;
  planet.motion.pose.position = Vec3(0.7, 0, 0);
  planet.motion.twist.linear = Vec3(0, 2 * test::pi * std::sqrt(1.3 / 0.7), 0);
  const BodyId body = world.add(planet);
  world.add_force(Field([sun](double mass, const Vec3& place, const Vec3&, double) {
    return Vec3(-mass * sun / std::pow(place.norm(), 3) * place);
  }));
  for (int i = 0; i < steps; ++i) world.step(1.0 / steps);
  return (world.motion(body).pose.position - Vec3(0.7, 0, 0)).norm();
}

/// Two boxes that tumble, tied to each other and to one on a path off their centers, in a wind that changes and a
/// medium that slows them.
std::array<Motion, 2> tied(Integrator integrator, int steps) {
  WorldSettings world_settings;
  world_settings.integrator = integrator;
  world_settings.sleep_after = never;
  World world(world_settings);
  std::array<BodyId, 2> bodies;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1 : 1;
    BodySettings box;
    box.shape.solid = Box{Vec3(0.1, 0.2, 0.35)};
    box.mass = 2 + side;
    box.linear_damping = 0.2;
    box.angular_damping = 0.3;
    box.motion.pose.position = Vec3(side, 0.2 * side, 0.1);
    box.motion.twist = {Vec3(0, side, 0.3), Vec3(1, 2 * side, -0.5)};
    bodies[i] = world.add(box);
  }
  BodySettings hand;
  hand.drive = Drive::keyed();
  const auto hand_at = [](double time) {
    Motion motion;
    motion.pose.position = Vec3(0.3 * std::sin(3 * time), 2, 0);
    motion.twist.linear = Vec3(0.9 * std::cos(3 * time), 0, 0);
    return motion;
  };
  hand.motion = hand_at(0);
  const BodyId led = world.add(hand);
  world.ignore(bodies[0], bodies[1]);
  for (const BodyId body : bodies) world.ignore(body, led);
  const Vec3 corner(0.1, 0.2, -0.3), other(-0.1, 0.2, 0.3);
  world.add_force(Spring{bodies[0], bodies[1], corner, other, 0.5, 20, 0.4});
  world.add_force(Spring{bodies[0], led, other, Vec3(0, 0.1, 0), 1, 15, 0.2});
  world.add_force(Drag{.linear = 0.1, .quadratic = 0.05, .angular = 0.02});
  world.add_force(Field([](double mass, const Vec3& place, const Vec3& velocity, double time) {
    return Vec3(mass * std::sin(5 * time), 0.3 * place.x(), -0.2 * velocity.y());
  }));
  for (int i = 0; i < steps; ++i) {
    world.set_target(led, hand_at((i + 1.0) / steps));
    world.step(1.0 / steps);
  }
  return {world.motion(bodies[0]), world.motion(bodies[1])};
}

double apart(const std::array<Motion, 2>& a, const std::array<Motion, 2>& b) {
  double most = 0;
  for (std::size_t i = 0; i < 2; ++i)
    most = std::max({most, (a[i].pose.position - b[i].pose.position).norm(),
                     log_map(a[i].pose.rotation * b[i].pose.rotation.conjugate()).norm(),
                     (a[i].twist.linear - b[i].twist.linear).norm(), (a[i].twist.angular - b[i].twist.angular).norm()});
  return most;
}

}  // namespace

TEST_CASE("each integrator comes nearer to a swing on a spring by its order") {
  for (const Method& method : methods) {
    CAPTURE(method.name);
    const double coarse = error_on_a_spring(method.integrator, 200), fine = error_on_a_spring(method.integrator, 400);
    CAPTURE(coarse);
    CHECK(order_of(coarse, fine) == doctest::Approx(method.order).epsilon(0.04));
  }
}

TEST_CASE("each integrator brings a planet home after a year by its order") {
  for (const Method& method : methods) {
    CAPTURE(method.name);
    const int steps = method.order > 1 ? 1000 : 60000;
    const double coarse = error_after_a_year(method.integrator, steps);
    const double fine = error_after_a_year(method.integrator, 2 * steps);
    CAPTURE(coarse);
    CHECK(order_of(coarse, fine) > method.order - 0.15);
  }
  CHECK(error_after_a_year(Integrator::rk4, 1000) < 1e-7);
}

TEST_CASE("each integrator comes nearer to what tumbling, springs, drag, damping, a path and a wind make together") {
  const std::array<Motion, 2> limit = tied(Integrator::rk4, 6400);
  for (const Method& method : methods) {
    CAPTURE(method.name);
    const int steps = method.order > 3 ? 100 : 1600;
    const double coarse = apart(tied(method.integrator, steps), limit);
    const double fine = apart(tied(method.integrator, 2 * steps), limit);
    CAPTURE(coarse);
    // The default takes drag and damping implicitly, which never grows and is of first order.
    const double order = method.integrator == Integrator::exact_quadratic ? 1 : method.order;
    CHECK(order_of(coarse, fine) > order - 0.2);
  }
}

TEST_CASE("what falls through a medium by rk4 nears its last speed as the closed form says") {
  WorldSettings settings;
  settings.integrator = Integrator::rk4;
  World world(settings);
  BodySettings ball;
  ball.mass = 3;
  const BodyId body = world.add(ball);
  world.add_force(Drag{.quadratic = 0.6});
  for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
  const double last = std::sqrt(3 * 9.81 / 0.6);
  CHECK(std::abs(world.twist(body).linear.y() + last * std::tanh(9.81 * 2 / last)) < 1e-8);
  CHECK(std::abs(world.motion(body).pose.position.y() + last * last / 9.81 * std::log(std::cosh(9.81 * 2 / last))) <
        1e-7);
}

TEST_CASE("by every integrator a spring gives its two ends opposite momenta, whatever touches one of them") {
  for (const Method& method : methods) {
    CAPTURE(method.name);
    World world(without_gravity(method.integrator));
    BodySettings box;
    box.shape.solid = Box{Vec3(0.2, 0.1, 0.1)};
    box.restitution = 0.5;
    std::array<BodyId, 3> bodies;
    for (std::size_t i = 0; i < 3; ++i) {
      box.mass = 1.0 + static_cast<double>(i);
      box.motion.pose.position = Vec3(0.7 * static_cast<double>(i), 0.05 * static_cast<double>(i), 0);
      box.motion.twist.angular = Vec3(0, 0.2, 1);
      bodies[i] = world.add(box);
    }
    world.add_force(Spring{bodies[0], bodies[2], Vec3(0.1, 0.1, 0), Vec3(0, 0, 0.1), 0.3, 30, 0.1});
    bool touched = false;
    Vec3 momentum;
    for (int i = 0; i < 240; ++i) {
      world.step(1.0 / 240);
      touched = touched || !world.contacts().empty();
      momentum = Vec3::Zero();
      for (const BodyId body : bodies) momentum += world.mass(body).mass * world.twist(body).linear;
      REQUIRE(momentum.norm() < 1e-13);
    }
    CHECK(touched);
  }
}

namespace {

/// A body of 2 kg on a spring of 32 N/m about the origin: position and velocity along x after so many steps, from 1 m.
std::array<double, 2> swung(Integrator integrator, double dt, int steps) {
  World world(without_gravity(integrator));
  BodySettings settings;
  settings.mass = 2;
  settings.motion.pose.position = Vec3(1, 0, 0);
  const BodyId body = world.add(settings);
  world.add_force(Spring{.a = body, .stiffness = 32});
  for (int i = 0; i < steps; ++i) world.step(dt);
  return {world.motion(body).pose.position.x(), world.twist(body).linear.x()};
}

/// J, of that body.
double swing_energy(const std::array<double, 2>& state) {
  return 16 * state[0] * state[0] + state[1] * state[1];
}

/// A top of equal moments 2 kg m^2 and 1 about its own y, without torque: it turns about its momentum at L / 2, and
/// about its own y by the rest.
double top_error(Integrator integrator, int steps) {
  World world(without_gravity(integrator));
  BodySettings settings;
  settings.shape.solid = Cylinder{1, std::sqrt(3.5)};
  settings.mass = 1;
  settings.motion.twist.angular = Vec3(0.4, 2, -0.7);
  const BodyId body = world.add(settings);
  const Mat3 inertia = world.mass(body).inertia;
  const Vec3 momentum = inertia * settings.motion.twist.angular;
  for (int i = 0; i < steps; ++i) world.step(1.0 / steps);
  const Quat exact = exp_map(momentum / inertia(0, 0)) * exp_map(Vec3(0, 2 - momentum.y() / inertia(0, 0), 0));
  return log_map(world.motion(body).pose.rotation * exact.conjugate()).norm();
}

}  // namespace

TEST_CASE("on a spring explicit Euler gains (1 + h^2 w^2) a step, backward Euler loses it, and others neither") {
  const double dt = 0.01, share = 1 + dt * dt * 16, start = 16;
  for (const int steps : {1, 10, 1000}) {
    CAPTURE(steps);
    const double grown = std::pow(share, steps);
    CHECK(near(swing_energy(swung(Integrator::explicit_euler, dt, steps)) / start / grown, 1, 1e-12));
    CHECK(near(swing_energy(swung(Integrator::backward_euler, dt, steps)) / start * grown, 1, 1e-12));
    CHECK(near(swing_energy(swung(Integrator::implicit_trapezoid, dt, steps)) / start, 1, 1e-12));
    // What they keep instead is given in closed form: Hairer, Lubich and Wanner, Geometric Numerical Integration.
    const std::array<double, 2> verlet = swung(Integrator::verlet, dt, steps);
    CHECK(near(swing_energy(verlet) - 16 * verlet[0] * verlet[0] * 4 * dt * dt, start * (1 - 4 * dt * dt), 1e-11));
    const std::array<double, 2> euler = swung(Integrator::semi_implicit_euler, dt, steps);
    CHECK(near(swing_energy(euler) - 16 * dt * euler[0] * euler[1], start, 1e-11));
  }
}

TEST_CASE("backward Euler and the implicit trapezoid are their closed forms on springs of any stiffness") {
  for (const double stiffness : {1.0, 32.0, 1e5, 1e9, 1e14}) {
    CAPTURE(stiffness);
    const double dt = 0.02, damping = 3, mass = 2;
    std::array<double, 2> backward{1, 5}, trapezoid{1, 5};
    std::array<World, 2> worlds{World(without_gravity(Integrator::backward_euler)),
                                World(without_gravity(Integrator::implicit_trapezoid))};
    std::array<BodyId, 2> bodies;
    for (std::size_t i = 0; i < 2; ++i) {
      BodySettings settings;
      settings.mass = mass;
      settings.motion.pose.position = Vec3(1, 0, 0);
      settings.motion.twist.linear = Vec3(5, 0, 0);
      bodies[i] = worlds[i].add(settings);
      worlds[i].add_force(Spring{.a = bodies[i], .stiffness = stiffness, .damping = damping});
    }
    for (int step = 0; step < 5; ++step) {
      const double pull = dt * stiffness / mass, slowing = dt * damping / mass;
      backward[1] = (backward[1] - pull * backward[0]) / (1 + slowing + dt * pull);
      backward[0] += dt * backward[1];
      const double before = trapezoid[1];
      trapezoid[1] = ((1 - 0.5 * slowing - 0.25 * dt * pull) * before - pull * trapezoid[0]) /
                     (1 + 0.5 * slowing + 0.25 * dt * pull);
      trapezoid[0] += 0.5 * dt * (before + trapezoid[1]);
      const double fast = std::sqrt(stiffness / mass);
      for (World& world : worlds) world.step(dt);
      CHECK(near(worlds[0].motion(bodies[0]).pose.position.x(), backward[0], 1e-12));
      CHECK(near(worlds[0].twist(bodies[0]).linear.x(), backward[1], 1e-12 * (1 + fast)));
      CHECK(near(worlds[1].motion(bodies[1]).pose.position.x(), trapezoid[0], 1e-11));
      CHECK(near(worlds[1].twist(bodies[1]).linear.x(), trapezoid[1], 1e-11 * (1 + fast)));
    }
  }
}

TEST_CASE("a chain of balls on stiff springs hangs still by backward Euler, each stretched by what hangs below it") {
  WorldSettings settings;
  settings.integrator = Integrator::backward_euler;
  settings.sleep_after = never;
  World world(settings);
  const int count = 8;
  const double stiffness = 1e6;
  std::vector<BodyId> balls;
  for (int i = 0; i < count; ++i) {
    BodySettings ball;
    ball.shape.solid = Sphere{0.05};
    ball.mass = 1;
    ball.motion.pose.position = Vec3(0.1 * (i + 1), 0, 0);
    balls.push_back(world.add(ball));
    Spring spring{.a = balls.back(), .rest_length = 0.1, .stiffness = stiffness, .damping = 100};
    if (i > 0) spring.b = balls[static_cast<std::size_t>(i) - 1];
    world.add_force(spring);
    if (i > 0) world.ignore(balls.back(), spring.b);
  }
  world.add_force(Drag{.linear = 2});
  for (int i = 0; i < 1200; ++i) world.step(1.0 / 60);
  double hung = 0;
  for (int i = 0; i < count; ++i) {
    hung -= 0.1 + (count - i) * 9.81 / stiffness;
    CHECK(near(world.motion(balls[static_cast<std::size_t>(i)]).pose.position.y(), hung, 1e-7));
    CHECK(world.twist(balls[static_cast<std::size_t>(i)]).linear.norm() < 1e-5);
  }
}

TEST_CASE("a top without torque turns as its closed form, nearer by each integrator's order") {
  for (const Method& method : methods) {
    // These two turn bodies by methods of their own.
    if (method.integrator == Integrator::exact_quadratic || method.integrator == Integrator::semi_implicit_euler)
      continue;
    CAPTURE(method.name);
    const double coarse = top_error(method.integrator, 40), fine = top_error(method.integrator, 80);
    CAPTURE(coarse);
    CHECK(coarse < 0.1);
    CHECK(order_of(coarse, fine) > method.order - 0.1);
  }
}

TEST_CASE("what is far away changes no bit of what backward Euler does") {
  std::array<std::uint64_t, 2> hashes{};
  for (const bool more : {false, true}) {
    World world(without_gravity(Integrator::backward_euler));
    std::array<BodyId, 2> pair;
    for (std::size_t i = 0; i < 2; ++i) {
      BodySettings box;
      box.shape.solid = Box{Vec3(0.1, 0.2, 0.3)};
      box.motion.pose.position = Vec3(static_cast<double>(i), 0, 0);
      box.motion.twist.angular = Vec3(1, 2, 3);
      pair[i] = world.add(box);
    }
    world.add_force(Spring{pair[0], pair[1], Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), 0.5, 1e6, 3});
    if (more) {
      BodySettings ball;
      ball.motion.pose.position = Vec3(100, 0, 0);
      const BodyId far = world.add(ball);
      world.add_force(Spring{.a = far, .anchor_b = Vec3(100, 1, 0), .rest_length = 0.2, .stiffness = 1e5});
    }
    for (int i = 0; i < 30; ++i) world.step(0.01);
    for (const BodyId body : pair)
      for (const double part : {world.motion(body).pose.position.x(), world.twist(body).linear.y(),
                                world.twist(body).angular.z(), world.motion(body).pose.rotation.w()})
        hashes[more ? 1 : 0] = hashes[more ? 1 : 0] * 31 + std::bit_cast<std::uint64_t>(part);
  }
  CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("balls bounce and boxes rest by rk4 as they do by the usual integrator") {
  std::array<double, 2> bounced{}, rested{};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    WorldSettings settings;
    settings.integrator = i == 0 ? Integrator::exact_quadratic : Integrator::rk4;
    World world(settings);
    BodySettings floor;
    floor.shape.solid = Plane{};
    floor.fixed = true;
    world.add(floor);
    BodySettings ball;
    ball.shape.solid = Sphere{0.1};
    ball.restitution = 0.8;
    ball.motion.pose.position = Vec3(0, 2.1, 0);
    const BodyId bouncing = world.add(ball);
    BodySettings box;
    box.shape.solid = Box{Vec3(0.2, 0.2, 0.2)};
    box.motion.pose.position = Vec3(3, 0.2, 0);
    const BodyId resting = world.add(box);
    for (int step = 0; step < 120; ++step) world.step(1.0 / 60);
    bounced[i] = world.motion(bouncing).pose.position.y();
    rested[i] = world.motion(resting).pose.position.y();
  }
  CHECK(near(bounced[0], bounced[1], 1e-9));
  CHECK(near(rested[0], rested[1], 1e-9));
}

TEST_CASE("a world that goes by rk4 goes on with the same bits after it was loaded") {
  World world({.integrator = Integrator::rk4});
  BodySettings box;
  box.shape.solid = Box{Vec3(0.1, 0.2, 0.3)};
  box.motion.twist.angular = Vec3(1, 2, 3);
  const BodyId body = world.add(box);
  world.add_force(Spring{.a = body, .anchor_a = Vec3(0.1, 0, 0), .stiffness = 100});
  for (int i = 0; i < 20; ++i) world.step(0.01);
  World loaded;
  loaded.load(world.save());
  for (int i = 0; i < 20; ++i) {
    world.step(0.01);
    loaded.step(0.01);
    REQUIRE(world.state_hash() == loaded.state_hash());
  }
}

TEST_CASE("what an explicit integrator cannot follow stays finite, or the step says so") {
  for (const Method& method : methods)
    for (const double damping : {10.0, 1e4, 1e9})
      for (const double spin : {0.0, 400.0, 1e6}) {
        CAPTURE(method.name);
        CAPTURE(damping);
        CAPTURE(spin);
        World world({.integrator = method.integrator});
        BodySettings box;
        box.shape.solid = Box{Vec3(0.1, 0.2, 0.3)};
        box.linear_damping = box.angular_damping = damping;
        box.motion.twist = {Vec3(1, 0, 0), Vec3(spin, 0.1 * spin, 0)};
        const BodyId body = world.add(box);
        world.add_force(Spring{.a = body, .anchor_a = Vec3(0.1, 0, 0), .stiffness = 1e9});
        try {
          for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
          CHECK(world.motion(body).pose.position.norm() < 1e30);
        } catch (const NotFinite& fault) {
          CHECK(fault.body == body);
        }
      }
}
