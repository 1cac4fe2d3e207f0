#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "physics/scene.h"

using namespace tweenfall;
using test::near;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Method {
  const char* name;
  Integrator integrator;
  double order;
};
constexpr std::array<Method, 6> methods{{{"exact-quadratic", Integrator::exact_quadratic, 2},
                                         {"semi-implicit-euler", Integrator::semi_implicit_euler, 1},
                                         {"explicit-euler", Integrator::explicit_euler, 1},
                                         {"midpoint", Integrator::midpoint, 2},
                                         {"trapezoid", Integrator::trapezoid, 2},
                                         {"rk4", Integrator::rk4, 4}}};

/// By how many powers of two an error falls when the step is halved.
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

/// A body of 2 kg on a spring of 32 N/m about the origin, let go at 1 m: its place is cos 4 t.
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

/// Around a sun of 4 pi^2 on an ellipse of eccentricity .3, for a year: it is where it was.
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
    // The usual one takes drag and damping implicitly, which never grows and is of first order.
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
