#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <limits>

#include "physics/scene.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

constexpr double for_ever = std::numeric_limits<double>::infinity();
constexpr double free_fall = 9.81;

WorldSettings by(Integrator integrator, const Vec3& gravity = Vec3(0, 0, 0)) {
  WorldSettings settings;
  settings.integrator = integrator;
  settings.gravity = gravity;
  settings.sleep_after = for_ever;
  return settings;
}

BodySettings ball(double mass, const Vec3& place, const Vec3& velocity = Vec3(0, 0, 0)) {
  BodySettings settings;
  settings.shape.solid = Sphere{0.1};
  settings.mass = mass;
  settings.motion.pose.position = place;
  settings.motion.twist.linear = velocity;
  return settings;
}

void run(World& world, double seconds, int steps) {
  for (int i = 0; i < steps; ++i) world.step(seconds / steps);
}

}  // namespace

TEST_CASE("a projectile under linear drag follows v0 exp(-c t / m)") {
  World world(by(Integrator::rk4, Vec3(0, -free_fall, 0)));
  const BodyId body = world.add(ball(2, Vec3(0, 0, 0), Vec3(12, 9, 0)));
  world.add_force(Drag{.linear = 0.8});
  run(world, 1.5, 360);
  const double rate = 0.4, decay = std::exp(-rate * 1.5), fall = free_fall / rate;
  CHECK(near(world.motion(body).pose.position,
             Vec3(12 / rate * (1 - decay), (9 + fall) / rate * (1 - decay) - fall * 1.5, 0), 1e-10));
  CHECK(near(world.twist(body).linear, Vec3(12 * decay, (9 + fall) * decay - fall, 0), 1e-10));
}

TEST_CASE("what falls through air by its coefficient follows v tanh(g t / v) to its terminal velocity") {
  const double quadratic = 0.5 * 1.2041 * 0.47 * pi * 0.01, terminal = std::sqrt(0.05 * free_fall / quadratic);
  World world(by(Integrator::rk4, Vec3(0, -free_fall, 0)));
  const BodyId body = world.add(ball(0.05, Vec3(0, 0, 0)));
  world.add_force(Wind{.coefficient = 0.47});
  run(world, 1, 240);
  CHECK(near(world.twist(body).linear.y(), -terminal * std::tanh(free_fall / terminal), 1e-9));
  // The default integrator ends at it, too.
  World usual(by(Integrator::exact_quadratic, Vec3(0, -free_fall, 0)));
  const BodyId other = usual.add(ball(0.05, Vec3(0, 0, 0)));
  usual.add_force(Wind{.coefficient = 0.47});
  run(usual, 20, 1200);
  CHECK(near(usual.twist(other).linear.y(), -terminal, 1e-9));
}

TEST_CASE("a wind takes along what is in it, and what drifts with it drifts evenly") {
  for (const Integrator integrator :
       {Integrator::exact_quadratic, Integrator::semi_implicit_euler, Integrator::rk4, Integrator::backward_euler}) {
    World world(by(integrator));
    const Vec3 wind(3, 0, -1);
    const BodyId along = world.add(ball(1, Vec3(0, 0, 0), wind)), still = world.add(ball(1, Vec3(0, 5, 0)));
    world.add_force(Wind{.velocity = wind, .linear = 2, .quadratic = 0.5});
    run(world, 2, 120);
    CHECK(near(world.motion(along).pose.position, Vec3(6, 0, -2), 1e-12));
    CHECK(near(world.twist(along).linear, wind, 1e-12));
    CHECK((world.twist(still).linear - wind).norm() < 0.05);
  }
}

TEST_CASE("a wind pushes a plate by the area that it turns to it") {
  World world(by(Integrator::rk4));
  BodySettings plate = ball(1e6, Vec3(0, 0, 0));
  plate.shape.solid = Box{Vec3(0.5, 0.5, 0.01)};
  const BodyId across = world.add(plate);
  plate.motion.pose.position = Vec3(0, 5, 0);
  plate.motion.pose.rotation = exp_map(Vec3(0, pi / 3, 0));
  const BodyId turned = world.add(plate);
  world.add_force(Wind{.velocity = Vec3(0, 0, 10), .coefficient = 1.28, .density = 1.25});
  world.step(1);
  CHECK(near(world.twist(across).linear.z() * 1e6, 80, 1e-4));
  CHECK(near(world.twist(turned).linear.z() * 1e6, 80 * (std::cos(pi / 3) + 0.02 * std::sin(pi / 3)), 1e-4));
}

TEST_CASE("a damper brings two to one speed by exp(-c t (1/m1 + 1/m2)), however strong it is") {
  World world(by(Integrator::rk4));
  const BodyId a = world.add(ball(1, Vec3(0, 0, 0), Vec3(2, 0, 0))), b = world.add(ball(3, Vec3(4, 0, 0)));
  world.add_force(Damper{.a = a, .b = b, .damping = 1.5});
  run(world, 0.7, 168);
  CHECK(near(world.twist(a).linear.x() - world.twist(b).linear.x(), 2 * std::exp(-1.5 * 0.7 * 4 / 3), 1e-9));
  CHECK(near(world.twist(a).linear.x() + 3 * world.twist(b).linear.x(), 2, 1e-13));
  World strong(by(Integrator::exact_quadratic));
  const BodyId c = strong.add(ball(1, Vec3(0, 0, 0), Vec3(2, 0, 0))), d = strong.add(ball(3, Vec3(4, 0, 0)));
  strong.add_force(Damper{.a = c, .b = d, .damping = 1e7});
  run(strong, 0.1, 6);
  CHECK(near(strong.twist(c).linear, Vec3(0.5, 0, 0), 1e-6));
  CHECK(near(strong.twist(d).linear, Vec3(0.5, 0, 0), 1e-6));
}

TEST_CASE("an attractor leads a planet around Kepler's ellipse and home after its year") {
  World world(by(Integrator::rk4));
  const double sun = 4 * pi * pi;
  const BodyId body = world.add(ball(3, Vec3(0.7, 0, 0), Vec3(0, 2 * pi * std::sqrt(1.3 / 0.7), 0)));
  const std::size_t force = world.add_force(Attractor{.acceleration = sun});
  const auto energy = [&] { return world.kinetic_energy() + world.potential_energy(force).value(); };
  // -G M m / 2 a
  CHECK(near(energy(), -0.5 * sun * 3, 1e-12));
  run(world, 1, 2000);
  CHECK(near(world.motion(body).pose.position, Vec3(0.7, 0, 0), 1e-7));
  CHECK(near(energy(), -0.5 * sun * 3, 1e-9));
}

TEST_CASE("two attractors that draw each other turn about their middle in 2 pi sqrt(d^3 / (a1 + a2))") {
  for (const Integrator integrator : {Integrator::rk4, Integrator::implicit_trapezoid}) {
    World world(by(integrator));
    // Speeds about the common center at a distance of 2 m: each its share of sqrt((1 + 3) / 2).
    const double speed = std::sqrt(2.0);
    const BodyId a = world.add(ball(1, Vec3(-1.5, 0, 0), Vec3(0, -0.75 * speed, 0)));
    const BodyId b = world.add(ball(3, Vec3(0.5, 0, 0), Vec3(0, 0.25 * speed, 0)));
    world.ignore(a, b);
    world.add_force(Attractor{.of = a, .acceleration = 1}, {.bodies = {b}});
    world.add_force(Attractor{.of = b, .acceleration = 3}, {.bodies = {a}});
    run(world, 2 * pi * std::sqrt(8.0 / 4), 2000);
    CHECK(near(world.motion(a).pose.position, Vec3(-1.5, 0, 0), 1e-4));
    const Vec3 momentum = world.twist(a).linear + 3 * world.twist(b).linear;
    CHECK(momentum.norm() < 1e-12);
  }
}

TEST_CASE("of every power an attractor's force is how its energy falls") {
  for (const double power : {-1.0, 0.0, 0.5, 1.0, 2.0, 3.0, 6.0})
    for (const double softening : {0.0, 0.3}) {
      CAPTURE(power);
      World world(by(Integrator::explicit_euler));
      const BodyId body = world.add(ball(2, Vec3(0, 0, 0)));
      const std::size_t force =
          world.add_force(Attractor{.at = Vec3(1, 2, -2), .acceleration = 5, .power = power, .softening = softening});
      const auto energy_at = [&](double x) {
        Motion motion;
        motion.pose.position = Vec3(x, 0, 0);
        world.set_motion(body, motion);
        return world.potential_energy(force).value();
      };
      const double falls = (energy_at(-1e-5) - energy_at(1e-5)) / 2e-5;
      energy_at(0);
      world.step(1e-3);
      const double r = std::sqrt(9 + softening * softening);
      CHECK(near(world.twist(body).linear.x() * 2 / 1e-3, 2 * 5 / std::pow(r, power + 1), 1e-12));
      CHECK(near(falls, 10 / std::pow(r, power + 1), 1e-8));
    }
}

TEST_CASE("a vortex drives around its axis and inward, and has no energy") {
  World world(by(Integrator::explicit_euler));
  const BodyId body = world.add(ball(2, Vec3(3, 7, 0)));
  const std::size_t force = world.add_force(Vortex{.at = Vec3(1, 0, 0), .acceleration = 6, .inward = 0.5});
  CHECK_FALSE(world.potential_energy(force));
  world.step(0.01);
  // 6 / 2 at 2 m from the axis; counterclockwise about y is toward -z from x.
  CHECK(near(world.twist(body).linear, Vec3(-0.5 * 3 * 0.01, 0, -3 * 0.01), 1e-12));
}

TEST_CASE("forces that cancel leave a body where it is to the bit, and a couple only turns it") {
  World world(by(Integrator::exact_quadratic));
  BodySettings box = ball(2, Vec3(1, 2, 3));
  box.shape.solid = Box{Vec3(0.2, 0.3, 0.4)};
  const BodyId still = world.add(box);
  box.motion.pose.position = Vec3(9, 2, 3);
  const BodyId turning = world.add(box);
  const Vec3 force(7, -3, 2), at(0.2, 0.1, -0.3);
  world.add_force(Push{.body = still, .force = force, .at = at});
  world.add_force(Push{.body = still, .force = -force, .at = at});
  // r x f twice: 2 * 0.3 * 5 N m about z, at I = m (w^2 + h^2) / 3.
  world.add_force(Push{.body = turning, .force = Vec3(-5, 0, 0), .at = Vec3(0, 0.3, 0), .turns = true});
  world.add_force(Push{.body = turning, .force = Vec3(5, 0, 0), .at = Vec3(0, -0.3, 0), .turns = true});
  run(world, 1, 60);
  CHECK(world.motion(still).pose.position == Vec3(1, 2, 3));
  CHECK(world.motion(still).pose.rotation.coeffs() == Quat(1, 0, 0, 0).coeffs());
  CHECK(world.twist(still).linear == Vec3(0, 0, 0));
  CHECK(world.twist(still).angular == Vec3(0, 0, 0));
  const double spin = 3 / (2.0 * (0.04 + 0.09) / 3);
  CHECK(near(world.motion(turning).pose.position, Vec3(9, 2, 3), 1e-14));
  CHECK(near(world.twist(turning).angular, Vec3(0, 0, spin), 1e-12));
  CHECK(near(world.motion(turning).pose.rotation, exp_map(Vec3(0, 0, 0.5 * spin)), 1e-9));
}

TEST_CASE("a push off the center turns a body by r x f and moves it as if it were at the center") {
  World world(by(Integrator::rk4));
  BodySettings rod = ball(3, Vec3(0, 0, 0));
  rod.shape.solid = Box{Vec3(1, 0.05, 0.05)};
  const BodyId body = world.add(rod);
  const std::size_t push = world.add_force(Push{.body = body, .force = Vec3(0, 6, 0), .at = Vec3(1, 0, 0)});
  CHECK(world.potential_energy(push).value() == 0);
  run(world, 0.2, 400);
  CHECK(near(world.twist(body).linear, Vec3(0, 0.4, 0), 1e-12));
  // The work of the force along the path of its point became kinetic energy.
  CHECK(near(world.kinetic_energy() + world.potential_energy(push).value(), 0, 1e-10));
  CHECK(world.twist(body).angular.z() > 0.9 * 6 * 0.2 / 1.0025);
}

TEST_CASE("formulas are forces, and of a potential the force is how it falls") {
  World world(by(Integrator::rk4)), same(by(Integrator::rk4)), spring(by(Integrator::rk4));
  const BodySettings start = ball(2, Vec3(1, 0.5, -0.2), Vec3(0, 1, 0));
  const BodyId a = world.add(start), b = same.add(start), c = spring.add(start);
  const std::size_t force = world.add_force(ForceFormula({"-k*x", "-k*y + 0*vx", "-k*z"}, {{"k", 18.0}}));
  const std::size_t potential = same.add_force(ForceFormula::potential("k/2*(x^2 + y^2 + z^2)", {{"k", 18.0}}));
  spring.add_force(Spring{.a = c, .stiffness = 18});
  CHECK_FALSE(world.potential_energy(force));
  CHECK(near(same.potential_energy(potential).value(), 9 * (1 + 0.25 + 0.04), 1e-13));
  for (World* each : {&world, &same, &spring}) run(*each, 2, 480);
  CHECK(near(world.motion(a).pose.position, spring.motion(c).pose.position, 1e-12));
  CHECK(near(same.motion(b).pose.position, spring.motion(c).pose.position, 1e-12));
  CHECK(near(same.kinetic_energy() + same.potential_energy(), 9 * 1.29 + 1, 1e-8));
  CHECK(ForceFormula({"t", "0", "0"}).reads_time());
  CHECK_FALSE(ForceFormula({"tau*x", "mass", "0"}).reads_time());
  // Without a value, the force is 0.
  CHECK(ForceFormula({"1/x", "log(x)", "vx"}).force(1, Vec3(0, 0, 0), Vec3(2, 0, 0), 0) == Vec3(0, 0, 2));
  CHECK_THROWS_AS(ForceFormula({"w", "0", "0"}), ExpressionError);
  CHECK_THROWS_AS(static_cast<void>(ForceFormula::potential("vx")), ExpressionError);
}

TEST_CASE("a strength is keyed or a formula, and its integral is the momentum that it gives") {
  using Keys = std::vector<Key<double>>;
  const auto speed_after = [](const Strength& strength, double seconds, int steps, Integrator integrator) {
    World world(by(integrator));
    const BodyId body = world.add(ball(2, Vec3(0, 0, 0)));
    world.add_force(Push{.body = body, .force = Vec3(6, 0, 0)}, {{}, strength});
    run(world, seconds, steps);
    return world.twist(body).linear.x();
  };
  const Strength ramp = keyed_curve<double>(Keys{{0, 0, Ease::linear()}, {1, 2}});
  const Strength jump = keyed_curve<double>(Keys{{0, 1, Ease::hold()}, {0.5, -3, Ease::hold()}, {2, 0}});
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::rk4, Integrator::verlet}) {
    CHECK(near(speed_after(ramp, 1, 240, integrator), 3, 1e-12));
    CHECK(near(speed_after(jump, 1, 240, integrator), 3 * (0.5 - 1.5), 1e-12));
  }
  CHECK(near(speed_after(Strength::formula("sin(pi*t)"), 1, 240, Integrator::rk4), 3 * 2 / pi, 1e-9));
  // For an ease that is no cubic: as the curve itself has it.
  const Curve<double> elastic = keyed_curve<double>(Keys{{0, 0, *Ease::named("elastic-out")}, {1, 2}});
  const Strength fitted = elastic;
  for (int i = -10; i <= 110; ++i) CHECK(near(fitted.at(0.01 * i), elastic.value(0.01 * i), 4e-9));
  CHECK(Strength(keyed_curve<double>(Keys{{1, 4}})).at(2) == 4);
  CHECK(jump.at(3) == 0);
  CHECK(jump.at(2, Side::in) == -3);
  CHECK(Strength(Curve<double>(4.0)) == Strength(4));
  CHECK(Strength::formula("1/t").at(0) == 0);
  CHECK_THROWS_AS(Strength{Curve<double>([](double, Side) { return Sample<double>{}; }, 0, 1)}, std::invalid_argument);
  CHECK_THROWS_AS(Strength{std::nan("")}, std::invalid_argument);
}

TEST_CASE("a force may be limited to some bodies, and negative strengths pull back what pushes but not what resists") {
  World world(by(Integrator::exact_quadratic));
  const BodyId a = world.add(ball(1, Vec3(0, 0, 0), Vec3(1, 0, 0))),
               b = world.add(ball(1, Vec3(0, 2, 0), Vec3(1, 0, 0)));
  world.add_force(Drag{.linear = 1}, {.bodies = {b}});
  const std::size_t back = world.add_force(Drag{.linear = 1}, {{}, -1});
  run(world, 0.5, 30);
  CHECK(world.twist(a).linear == Vec3(1, 0, 0));
  CHECK(world.twist(b).linear.x() < 0.7);
  world.set_strength(back, 1);
  world.step(0.1);
  CHECK(world.twist(a).linear.x() < 0.95);
  CHECK_THROWS_AS(world.set_strength(99, 1), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(world.potential_energy(99)), std::invalid_argument);
}

TEST_CASE("forces that cannot be are refused in words") {
  World world;
  const BodyId body = world.add(ball(1, Vec3(0, 0, 0)));
  const double none = std::nan("");
  const Force bad[] = {Wind{.velocity = Vec3(none, 0, 0)},
                       Wind{.linear = -1},
                       Buoyancy{.normal = Vec3(0, 0, 0)},
                       Buoyancy{.level = none},
                       Buoyancy{.drag = {.linear = -1}},
                       Attractor{.power = 9},
                       Attractor{.softening = -1},
                       Attractor{.of = {7, 0}},
                       Vortex{.axis = Vec3(0, 0, 0)},
                       Vortex{.acceleration = none},
                       Damper{.a = body, .damping = -1},
                       Damper{},
                       Push{},
                       Push{.body = body, .force = Vec3(0, 1e31, 0)}};
  for (const Force& force : bad) CHECK_THROWS_AS(world.add_force(force), std::invalid_argument);
  CHECK_THROWS_AS(world.add_force(Push{.body = body}, {.bodies = {body}}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_force(Drag{}, {.bodies = {{3, 3}}}), std::invalid_argument);
  // At the very point, at any power: no force.
  world.add_force(Attractor{.power = 8});
  world.step(0.01);
  CHECK(world.twist(body).linear.x() == 0);
}

TEST_CASE("a formula of a force that was moved from is what it was") {
  ForceFormula formula({"2*x", "0", "mass"});
  const ForceFormula taken = std::move(formula);
  CHECK(formula.force(3, Vec3(4, 0, 0), Vec3(0, 0, 0), 0) == Vec3(8, 0, 3));
  CHECK(taken.force(3, Vec3(4, 0, 0), Vec3(0, 0, 0), 0) == Vec3(8, 0, 3));
}
