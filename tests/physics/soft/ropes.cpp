#include "physics/soft/soft_scene.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Parameter a of the catenary y = a cosh(x / a) of this length between ends at the same height, this far apart.
double catenary_parameter(double span, double length) {
  double low = 1e-3 * span, high = 1e3 * span;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    (2 * a * std::sinh(span / (2 * a)) > length ? low : high) = a;
  }
  return 0.5 * (low + high);
}

struct Sag {
  double sag, horizontal, vertical;
};

Sag hung(SoftSettings line, double seconds, double dt) {
  line.pins = {{.node = 0, .in_place = true},
               {.node = static_cast<std::uint32_t>(line.positions.size() - 1), .in_place = true}};
  line.linear_damping = 8;
  World world;
  const SoftId id = add_soft(world, line);
  step(world, seconds, dt);
  double lowest = 0;
  for (const Vec3& place : soft_positions(world, id)) lowest = std::min(lowest, place.y());
  const auto pins = soft_pins(world, id);
  return {-lowest, std::abs(pins[0].force.x()), -pins[0].force.y()};
}

}  // namespace

// Closed form, e.g. Lockwood, A Book of Curves, 1961, chapter 13: sag a (cosh(span / 2a) - 1), horizontal pull of the
// weight per length times a.
TEST_CASE("a rope between two hooks hangs as a catenary, by either solver") {
  const double span = 1, length = 1.3, mass = 0.4, a = catenary_parameter(span, length);
  const double sag = a * (std::cosh(span / (2 * a)) - 1), pull = mass / length * 9.81 * a;
  RopeSettings settings{.to = {span, 0, 0}, .links = 60, .slack = 0.3, .mass = mass};
  SUBCASE("positions") {
    SoftSettings line = rope(settings);
    line.sub_step = 1.0 / 4800;
    line.iterations = 4;
    const Sag result = hung(line, 4, 1.0 / 60);
    CHECK(result.sag == doctest::Approx(sag).epsilon(0.001));
    CHECK(result.horizontal == doctest::Approx(pull).epsilon(0.003));
    CHECK(result.vertical == doctest::Approx(0.5 * mass * 9.81).epsilon(0.001));
  }
  SUBCASE("springs") {
    settings.stiffness = 1e4;
    SoftSettings line = rope(settings);
    line.solver = SoftSolver::springs;
    line.sub_step = 1.0 / 60;
    const Sag result = hung(line, 8, 1.0 / 60);
    CHECK(result.sag == doctest::Approx(sag).epsilon(0.001));
    CHECK(result.horizontal == doctest::Approx(pull).epsilon(0.001));
    CHECK(result.vertical == doctest::Approx(0.5 * mass * 9.81).epsilon(0.001));
  }
}

// By the same closed form, at the default sub-steps of a rope.
TEST_CASE("a rope hangs as a catenary however many links it has and however tight it is, by constraints as they are") {
  for (const int links : {40, 100, 400})
    for (const double slack : {0.05, 0.3, 1.0}) {
      CAPTURE(links);
      CAPTURE(slack);
      const double a = catenary_parameter(1, 1 + slack), sag = a * (std::cosh(0.5 / a) - 1);
      const Sag result = hung(rope({.to = {1, 0, 0}, .links = links, .slack = slack, .mass = 0.4}), 2.5, 1.0 / 60);
      CHECK(result.sag == doctest::Approx(sag).epsilon(0.001));
      CHECK(result.horizontal == doctest::Approx(0.4 / (1 + slack) * 9.81 * a).epsilon(0.001));
      CHECK(result.vertical == doctest::Approx(0.2 * 9.81).epsilon(1e-4));
    }
}

TEST_CASE("what hangs on a rope may be two thousand times as heavy, and a rope that cannot be so long does no harm") {
  World world;
  BodySettings ball{.shape = {Sphere{0.1}}, .mass = 2.0};
  ball.motion.pose.position = Vec3(0, -1, 0);
  const BodyId load = world.add(ball);
  SoftSettings line = rope({.to = {0, -1, 0}, .links = 20, .mass = 1e-3});
  line.collide = false;
  line.pins = {{.node = 0}, {.node = 20, .body = load}};
  const SoftId id = add_soft(world, line);
  step(world, 2, 1.0 / 60);
  CHECK(soft_pins(world, id)[0].force.y() == doctest::Approx(-2.001 * 9.81).epsilon(1e-6));
  CHECK(world.motion(load).pose.position.y() == doctest::Approx(-1).epsilon(1e-6));
  SoftSettings tight = rope({.from = {0, 5, 0}, .to = {1, 5, 0}, .links = 30});
  tight.pins = {{.node = 0, .in_place = true}, {.node = 30, .point = Vec3(1.01, 5, 0)}};
  const SoftId held = add_soft(world, tight);
  step(world, 2, 1.0 / 60);
  for (const Vec3& velocity : soft_velocities(world, held)) CHECK(velocity.norm() < 1);
}

// A rope of weight W and stiffness EA that hangs from one end is longer by W / EA times half its length; steps far
// longer than its slowest mode lead there at once, if the first node affects the last.
TEST_CASE("a rope of thousands of springs is as long as its weight makes it, after a few long steps") {
  SoftSettings line = rope({.to = {0, -1, 0}, .links = 4000, .mass = 0.4, .stiffness = 1000, .bending = 1e-4});
  line.solver = SoftSolver::springs;
  line.sub_step = 1;
  line.pins = {{.node = 0, .in_place = true}};
  World world;
  const SoftId id = add_soft(world, line);
  step(world, 8, 1);
  CHECK(soft_positions(world, id).back().y() == doctest::Approx(-1 - 0.4 * 9.81 / 2000).epsilon(1e-7));
}

// Twenty equal masses at the ends of twenty links: the first mode's square over g is 20 x, with x the smallest zero of
// the Laguerre polynomial L20 (Abramowitz, Stegun, table 25.9: 0.070539889692), for links of 1/20 m.
TEST_CASE("a plucked rope swings in its first mode, and its hook bears its weight") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    SoftSettings line = rope({.to = {0, -1, 0}, .links = 20, .mass = 0.2, .stiffness = 2e5});
    line.masses.assign(21, 0.01);
    line.solver = solver;
    line.sub_step = solver == SoftSolver::positions ? 1.0 / 4800 : 1.0 / 1920;
    const double pluck = pi / 180;
    // Its shape, k links above the end: the Laguerre polynomial Lk there.
    for (int k = 0; k <= 20; ++k) {
      double value = 1, term = 1;
      for (int m = 1; m <= k; ++m) value += term *= -(k - m + 1) * 0.070539889692 / (m * m);
      line.positions[static_cast<std::size_t>(20 - k)].x() = pluck * value;
    }
    line.pins = {{.node = 0, .in_place = true}};
    World world;
    const SoftId id = add_soft(world, line);
    std::vector<double> crossings;
    double before = soft_positions(world, id)[20].x(), time = 0, bears = 0, counted = 0;
    while (crossings.size() < 5 && time < 6) {
      world.step(1.0 / 240);
      time += 1.0 / 240;
      const double now = soft_positions(world, id)[20].x();
      if ((before > 0) != (now > 0)) crossings.push_back(time - now / (now - before) / 240);
      before = now;
      bears -= soft_pins(world, id)[0].force.y();
      ++counted;
    }
    REQUIRE(crossings.size() == 5);
    const double rate = 2 * pi / (0.5 * (crossings[4] - crossings[0]));
    CHECK(rate == doctest::Approx(std::sqrt(20 * 9.81 * 0.070539889692)).epsilon(0.005));
    CHECK(bears / counted == doctest::Approx(0.21 * 9.81).epsilon(0.001));
  }
}

// A bob that swings on a rope is as fast as its fall makes it, however stiff the rope: its springs store almost
// nothing.
TEST_CASE("springs of any stiffness give what hangs on them no energy") {
  for (const double stiffness : {1e6, 1e11, 1e12, 1e15}) {
    CAPTURE(stiffness);
    World world;
    SoftSettings line = rope({.to = {1, 0, 0}, .links = 10, .mass = 0.1, .stiffness = stiffness});
    line.solver = SoftSolver::springs;
    line.collide = false;
    const BodyId lamp = world.add(
        {.shape = {Box{{0.08, 0.08, 0.08}}}, .mass = 0.2, .motion = {.pose = {.position = Vec3(1.08, 0, 0)}}});
    line.pins = {{.node = 0, .in_place = true}, {.node = 10, .body = lamp, .point = {-0.08, 0, 0}}};
    const SoftId id = add_soft(world, line);
    const double inertia = 0.2 * 0.16 * 0.16 / 6;
    double lowest = 0, least = 0, most = -1;
    for (int n = 0; n < 300; ++n) {
      world.step(1.0 / 240);
      const SoftEnergy rope_has = soft_energy(world, id);
      const Motion motion = world.motion(lamp);
      const double moves = rope_has.kinetic + 0.1 * motion.twist.linear.squaredNorm() +
                           0.5 * inertia * motion.twist.angular.squaredNorm();
      const double height = rope_has.weight + 0.2 * 9.81 * motion.pose.position.y();
      lowest = std::min(lowest, motion.pose.position.y());
      least = std::min(least, height);
      most = std::max(most, moves + height);
    }
    CHECK(most < 0);
    CHECK(lowest == doctest::Approx(-1.08).epsilon(0.002));
    CHECK(least < -2);
  }
}

TEST_CASE("a rope follows the hand that holds it, and falls as one body when the hand opens") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    World world;
    const BodyId hand = world.add({.shape = {Sphere{0.02}}, .drive = Drive::keyed()});
    SoftSettings line = rope({.to = {0, -1, 0}, .links = 20, .mass = 0.2, .stiffness = 1e4});
    line.solver = solver;
    line.pins = {{.node = 0, .body = hand, .point = {0.01, 0, 0}}};
    line.collide = false;
    const SoftId id = add_soft(world, line);
    for (int n = 1; n <= 120; ++n) {
      const double time = n / 240.0, angle = 3 * time;
      Motion motion;
      motion.pose.position = Vec3(0.1 * std::sin(5 * time), 0, 0);
      motion.twist.linear = Vec3(0.5 * std::cos(5 * time), 0, 0);
      motion.pose.rotation = Quat(std::cos(angle / 2), 0, 0, std::sin(angle / 2));
      motion.twist.angular = Vec3(0, 0, 3);
      world.set_target(hand, motion);
      world.step(1.0 / 240);
      const Vec3 arm = motion.pose.rotation * Vec3(0.01, 0, 0);
      REQUIRE(near(soft_positions(world, id)[0], motion.pose.position + arm, 1e-12));
      REQUIRE(near(soft_velocities(world, id)[0], motion.twist.linear + Vec3(0, 0, 3).cross(arm), 1e-9));
    }
    unpin(world, id, 0);
    const Vec3 start = test::center_of(world, id), momentum = momentum_of(world, id);
    step(world, 0.5);
    const double mass = 0.2;
    CHECK(near(momentum_of(world, id), momentum + mass * 0.5 * Vec3(0, -9.81, 0), 1e-9));
    CHECK(near(test::center_of(world, id), start + 0.5 * momentum / mass + 0.125 * Vec3(0, -9.81, 0), 1e-9));
  }
}

TEST_CASE("a node pinned on the way holds, follows where its pin is led, and flies on when it is let go") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    World world;
    SoftSettings line = rope({.to = {0, -1, 0}, .links = 10, .mass = 0.2, .stiffness = 1e4});
    line.solver = solver;
    line.collide = false;
    const SoftId id = add_soft(world, line);
    step(world, 0.25);
    pin(world, id, {.node = 3, .in_place = true});
    const Vec3 held = soft_positions(world, id)[3];
    REQUIRE(soft_pins(world, id).size() == 1);
    step(world, 0.5);
    CHECK(near(soft_positions(world, id)[3], held, 1e-12));
    CHECK(soft_velocities(world, id)[3].norm() < 1e-12);

    for (int n = 1; n <= 60; ++n) {
      const double time = n / 240.0;
      const Vec3 point = held + Vec3(0.1 * (1 - std::cos(6 * time)), 0, 0.05 * std::sin(6 * time) - 0.3 * time);
      const Vec3 velocity(0.6 * std::sin(6 * time), 0, 0.3 * std::cos(6 * time) - 0.3);
      lead_pin(world, id, 3, point, velocity);
      world.step(1.0 / 240);
      REQUIRE(near(soft_positions(world, id)[3], point, 1e-12));
      REQUIRE(near(soft_velocities(world, id)[3], velocity, 1e-9));
    }

    // If a node has two pins, the later one holds.
    const Vec3 elsewhere = soft_positions(world, id)[3] + Vec3(0, 0.01, 0);
    pin(world, id, {.node = 3, .point = elsewhere});
    CHECK(soft_pins(world, id).size() == 1);
    step(world, 0.1);
    CHECK(near(soft_positions(world, id)[3], elsewhere, 1e-12));
    unpin(world, id, 3);
    CHECK(soft_pins(world, id).empty());
    const Vec3 momentum = momentum_of(world, id);
    step(world, 0.5);
    CHECK(near(momentum_of(world, id), momentum + 0.2 * 0.5 * Vec3(0, -9.81, 0), 1e-9));
    CHECK_THROWS_AS(lead_pin(world, id, 3, Vec3::Zero(), Vec3::Zero()), std::invalid_argument);
    CHECK_THROWS_AS(pin(world, id, {.node = 11}), std::invalid_argument);
  }
}

TEST_CASE("a hanging spring is longer by the weight over its stiffness, however many sub-steps it takes") {
  // One mass on one edge, and a chain: under its own weight and a load, the sum of each link's load over its stiffness.
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs})
    for (const double sub_step : {1.0 / 240, 1.0 / 960, 1.0 / 3840})
      for (const int iterations : {1, 5}) {
        CAPTURE(sub_step);
        SoftSettings line;
        line.positions = {{0, 0, 0}, {0, -1, 0}};
        line.masses = {1, 1};
        line.edges = {{.a = 0, .b = 1, .stiffness = 100, .damping = 15}};
        line.pins = {{.node = 0, .in_place = true}};
        line.solver = solver;
        line.sub_step = sub_step;
        line.iterations = iterations;
        World world;
        const SoftId id = add_soft(world, line);
        step(world, 4, 1.0 / 60);
        CHECK(near(soft_positions(world, id)[1], Vec3(0, -1 - 9.81 / 100, 0), 1e-9));
      }
  SoftSettings chain = rope({.to = {0, -1, 0}, .links = 10, .mass = 1, .stiffness = 50, .damping = 3});
  chain.masses[10] += 2;
  chain.pins = {{.node = 0, .in_place = true}};
  chain.linear_damping = 2;
  chain.solver = SoftSolver::springs;
  World world;
  const SoftId id = add_soft(world, chain);
  step(world, 10, 1.0 / 60);
  // Continuous: (M g + m g / 2) length / stiffness; half masses at the ends make it exact for the chain, too.
  CHECK(near(soft_positions(world, id)[10], Vec3(0, -1 - (2 + 0.5) * 9.81 / 50, 0), 1e-6));
}

// A cantilever under its own weight sinks by w L^4 / (8 B) (Gere, Timoshenko, Mechanics of Materials, appendix G).
TEST_CASE("a rope that resists bending is a beam") {
  const double bending = 2, mass = 0.1;
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    SoftSettings beam = rope({.links = 16, .mass = mass, .stiffness = 1e5, .bending = bending});
    beam.solver = solver;
    beam.linear_damping = 20;
    beam.iterations = 30;
    // Clamped: the slope at the wall, half a link in, is level.
    beam.pins = {{.node = 0, .in_place = true}, {.node = 1, .in_place = true}};
    World world;
    const SoftId id = add_soft(world, beam);
    step(world, 3, 1.0 / 120);
    const double free_length = 1 - 0.5 / 16;
    CHECK(-soft_positions(world, id)[16].y() ==
          doctest::Approx(mass * 9.81 * std::pow(free_length, 4) / (8 * bending)).epsilon(0.02));
  }
}

TEST_CASE("a rope tears where it bears too much") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    // Strain of the top link at rest: weight below it over the stiffness.
    RopeSettings settings{.to = {0, -1, 0}, .links = 10, .mass = 1, .stiffness = 200, .damping = 2};
    const double strain = 0.95 * 9.81 / 200;
    for (const double tear : {3.0, 0.6}) {
      settings.tear = tear * strain;
      SoftSettings line = rope(settings);
      line.linear_damping = 5;
      line.solver = solver;
      line.pins = {{.node = 0, .in_place = true}};
      World world;
      const SoftId id = add_soft(world, line);
      step(world, 1);
      std::size_t count_torn = 0;
      for (std::size_t i = 0; i < 10; ++i) count_torn += torn(world, id, i) ? 1 : 0;
      CHECK((count_torn > 0) == (tear < 1));
      CHECK((soft_positions(world, id)[10].y() < -1.5) == (tear < 1));
      if (tear < 1) CHECK(torn(world, id, 0));
    }
  }
}
