#include <tweenfall/physics/detail.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "physics/strategies/ground.h"
#include "strategies/solvers/lemke.h"

using namespace tweenfall;
using test::near;

namespace {

constexpr std::array all_solvers{ContactSolver::iterative, ContactSolver::sequential, ContactSolver::shock,
                                 ContactSolver::lcp};

/// Sum of the impulses that carried a body from below in the last step, N s.
double borne(const World& world, BodyId below, BodyId above) {
  double sum = 0;
  for (const Contact& contact : world.contacts())
    if ((contact.a == below && contact.b == above) || (contact.a == above && contact.b == below))
      sum += contact.impulse;
  return sum;
}

struct Fate {
  double top = 0, deepest = 0, aside = 0, residual = 0;
};

/// Of boxes, one on top of the other.
Fate stack_by(ContactSolver solver, int count, int steps) {
  World world(test::with(solver, Parting::positional_impulse));
  test::add_floor(world);
  const std::vector<BodyId> boxes = test::add_stack(world, count);
  Fate fate;
  for (int step = 0; step < steps; ++step) {
    world.step(1.0 / 60);
    fate.deepest = std::max(fate.deepest, test::deepest(world));
    fate.residual = std::max(fate.residual, complementarity_residual(world));
  }
  fate.top = world.motion(boxes.back()).pose.position.y();
  fate.aside = std::hypot(world.motion(boxes.back()).pose.position.x(), world.motion(boxes.back()).pose.position.z());
  return fate;
}

}  // namespace

TEST_CASE("two balls that meet head on part as the lecture's collision equation says, by every solver") {
  for (const ContactSolver solver : all_solvers)
    for (const double e : {0.0, 0.5, 1.0}) {
      World world(test::weightless(test::with(solver)));
      BodySettings ball = test::solid_at(Sphere{0.5}, Vec3(-0.5, 0, 0), 2);
      ball.restitution = e;
      ball.motion.twist.linear = Vec3(3, 1, 0);
      ball.friction = 0;
      const BodyId a = world.add(ball);
      ball.mass = 1;
      ball.motion.pose.position = Vec3(0.5, 0, 0);
      ball.motion.twist.linear = Vec3(-1, 0, 0);
      const BodyId b = world.add(ball);
      world.step(0.01);
      // j = (1 + e) v / (1/m1 + 1/m2)
      const double j = (1 + e) * 4 / (0.5 + 1);
      CHECK(near(world.twist(a).linear.x(), 3 - j / 2, 1e-9));
      CHECK(near(world.twist(b).linear.x(), -1 + j, 1e-9));
      CHECK(world.twist(a).linear.y() == 1);
      CHECK(near(world.contacts()[0].impulse, j, 1e-9));
    }
}

TEST_CASE("a rod struck at its end parts and turns as the collision equation with rotation says, by every solver") {
  for (const ContactSolver solver : all_solvers) {
    World world(test::weightless(test::with(solver)));
    BodySettings ball = test::solid_at(Sphere{0.1}, Vec3(0.9, -0.15, 0), 0.5);
    ball.restitution = 0.7;
    ball.friction = 0;
    ball.motion.twist.linear = Vec3(0, 2, 0);
    const BodyId striker = world.add(ball);
    const BodyId rod = world.add(test::solid_at(Box{Vec3(1, 0.05, 0.05)}, Vec3(0, 0, 0), 2));
    world.step(1e-3);
    const double inertia = 2.0 / 12 * (2.0 * 2 + 0.1 * 0.1);
    const double j = 1.7 * 2 / (1 / 0.5 + 1 / 2.0 + 0.9 * 0.9 / inertia);
    CHECK(near(world.twist(striker).linear.y(), 2 - j / 0.5, 1e-6));
    CHECK(near(world.twist(rod).linear.y(), j / 2, 1e-6));
    CHECK(near(world.twist(rod).angular.z(), 0.9 * j / inertia, 1e-6));
  }
}

TEST_CASE("each box of a stack bears what lies on it, exactly by the complementarity problem") {
  World world(test::with(ContactSolver::lcp));
  const BodyId floor = test::add_floor(world);
  const std::vector<BodyId> boxes = test::add_stack(world, 8);
  const double dt = 1.0 / 60;
  for (int step = 0; step < 20; ++step) {
    world.step(dt);
    CHECK(complementarity_residual(world) < 1e-9);
    CHECK(near(borne(world, floor, boxes[0]), 8 * 9.81 * dt, 1e-9));
    for (std::size_t i = 1; i < boxes.size(); ++i)
      CHECK(near(borne(world, boxes[i - 1], boxes[i]), static_cast<double>(8 - i) * 9.81 * dt, 1e-9));
  }
}

TEST_CASE("a plank on two posts rests on them by the law of the lever") {
  World world(test::with(ContactSolver::lcp));
  std::array<BodyId, 2> posts;
  for (std::size_t i = 0; i < 2; ++i) {
    BodySettings post = test::solid_at(Sphere{0.2}, Vec3(i == 0 ? -0.5 : 0.9, 0, 0));
    post.shape.solid = Capsule{0.2, 0.5};
    post.motion.pose.rotation = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
    post.fixed = true;
    posts[i] = world.add(post);
  }
  const BodyId plank = world.add(test::solid_at(Box{Vec3(1.2, 0.05, 0.3)}, Vec3(0, 0.25, 0), 7));
  world.step(0.01);
  const double weight = 7 * 9.81 * 0.01;
  CHECK(near(borne(world, posts[0], plank), weight * 0.9 / 1.4, 1e-9));
  CHECK(near(borne(world, posts[1], plank), weight * 0.5 / 1.4, 1e-9));
  CHECK(complementarity_residual(world) < 1e-9);
}

TEST_CASE("the same stack under each solver: all but the sequential one hold it") {
  for (const ContactSolver solver : all_solvers) {
    CAPTURE(static_cast<int>(solver));
    const Fate fate = stack_by(solver, 10, 120);
    CAPTURE(fate.top);
    CAPTURE(fate.aside);
    CAPTURE(fate.deepest);
    CHECK(fate.residual < 1e-9);
    if (solver == ContactSolver::sequential) {
      CHECK(fate.deepest > 0.1);
    } else {
      CHECK(near(fate.top, 9.5, 1e-3));
      CHECK(fate.aside < 0.01);
      CHECK(fate.deepest < 2e-3);
    }
  }
}

TEST_CASE("complementarity is met below 1e-9 m/s by pivots and by sweeps, whatever is heaped up") {
  for (const int rows : {3, 5, 9}) {
    CAPTURE(rows);
    World world(test::with(ContactSolver::lcp));
    test::add_floor(world);
    for (int row = 0; row < rows; ++row)
      for (int i = 0; i < rows - row; ++i)
        world.add(test::solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(1.1 * (i + 0.5 * row), 0.5 + row, 0)));
    double most = 0;
    for (int step = 0; step < 40; ++step) {
      world.step(1.0 / 60);
      most = std::max(most, complementarity_residual(world));
    }
    CHECK(most < 1e-9);
  }
}

TEST_CASE("stacks of any height stand under the complementarity problem, however their overlap is found and parted") {
  for (const int count : {2, 8, 12})
    for (const Parting parting : {Parting::half, Parting::positional_impulse})
      for (const Detection detection : {Detection::ahead, Detection::discrete, Detection::time_of_impact}) {
        CAPTURE(count);
        CAPTURE(static_cast<int>(parting));
        CAPTURE(static_cast<int>(detection));
        WorldSettings settings = test::with(ContactSolver::lcp, parting);
        settings.collision = detection;
        settings.sleep_after = std::numeric_limits<double>::infinity();
        World world(settings);
        test::add_floor(world);
        std::vector<BodyId> boxes;
        for (int i = 0; i < count; ++i)
          boxes.push_back(world.add(test::solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0, 0.25 + 0.5 * i, 0))));
        double most = 0;
        for (int step = 0; step < 120; ++step) {
          world.step(1.0 / 60);
          most = std::max(most, complementarity_residual(world));
        }
        CHECK(most < 1e-9);
        CHECK(near(world.motion(boxes.back()).pose.position.y(), 0.5 * count - 0.25, 0.01));
      }
}

// 1,200 points, more than sweeps would end with in 20,000 passes.
TEST_CASE("a tower of three hundred boxes meets complementarity below 1e-9 m/s, and its floor bears all") {
  World world(test::with(ContactSolver::lcp, Parting::positional_impulse));
  const BodyId floor = test::add_floor(world);
  for (int i = 0; i < 300; ++i) world.add(test::solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0, 0.25 + 0.5 * i, 0)));
  for (int step = 0; step < 3; ++step) {
    world.step(1.0 / 60);
    CHECK(complementarity_residual(world) < 1e-9);
    CHECK(near(borne(world, floor, world.bodies()[1]), 300 * 9.81 / 60, 1e-6));
  }
}

// More than pivots take on: it says how far off it is.
TEST_CASE("a tower of six hundred boxes tells by how much it misses complementarity") {
  World world(test::with(ContactSolver::lcp, Parting::positional_impulse));
  test::add_floor(world);
  for (int i = 0; i < 600; ++i) world.add(test::solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0, 0.25 + 0.5 * i, 0)));
  world.step(1.0 / 60);
  CHECK(complementarity_residual(world) > 1e-9);
  CHECK(complementarity_residual(world) < 0.01);
}

TEST_CASE("what is a hundred times as heavy lies on what is light, and complementarity is met below 1e-9 m/s") {
  for (const int count : {10, 30}) {
    World world(test::with(ContactSolver::lcp, Parting::positional_impulse));
    test::add_floor(world);
    for (int i = 0; i < count; ++i)
      world.add(test::solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0, 0.25 + 0.5 * i, 0), i % 2 == 0 ? 1 : 100));
    for (int step = 0; step < 5; ++step) {
      world.step(1.0 / 240);
      CHECK(complementarity_residual(world) < 1e-9);
    }
  }
}

TEST_CASE(
    "what is ten thousand times as heavy lies on what is light, however high, and complementarity is below 1e-9 m/s") {
  for (const int count : {24, 40, 100})
    for (const bool alternating : {true, false}) {
      CAPTURE(count);
      CAPTURE(alternating);
      World world(test::with(ContactSolver::lcp, Parting::positional_impulse));
      test::add_floor(world);
      for (int i = 0; i < count; ++i) {
        const bool heavy = alternating ? i % 2 == 1 : i == count - 1;
        world.add(test::solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0, 0.25 + 0.5 * i, 0), heavy ? 1e4 : 1));
      }
      for (int step = 0; step < 5; ++step) {
        world.step(1.0 / 240);
        CHECK(complementarity_residual(world) < 1e-9);
      }
    }
}

// What presses makes what is light so fast that its last digit is more than 1e-10 m/s.
TEST_CASE("boxes that are a hundred thousand times as heavy lie on light ones, below 1e-9 m/s at any step") {
  for (const double rate : {60.0, 240.0})
    for (const int count : {24, 40, 100})
      for (const bool alternating : {true, false}) {
        CAPTURE(rate);
        CAPTURE(count);
        CAPTURE(alternating);
        World world(test::with(ContactSolver::lcp));
        const BodyId floor = test::add_floor(world);
        double weight = 0;
        for (int i = 0; i < count; ++i) {
          const double mass = (alternating ? i % 2 == 1 : 2 * i >= count) ? 1e5 : 1;
          world.add(test::solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0.003 * (7 * i % 3), 0.25 + 0.5 * i, 0), mass));
          weight += mass * 9.81;
        }
        for (int step = 0; step < 3; ++step) {
          world.step(1 / rate);
          CHECK(complementarity_residual(world) < 1e-9);
          double borne = 0;
          for (const Contact& contact : world.contacts())
            if (contact.a == floor || contact.b == floor) borne += rate * contact.impulse;
          CHECK(borne == doctest::Approx(weight).epsilon(1e-6));
        }
      }
}

TEST_CASE("Lemke's pivots find what trying every choice of pressing rows finds, and of what has none say so") {
  test::Random random(11);
  int solved = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t n = 1 + random.bits() % 6, rank = 1 + random.bits() % n;
    std::vector<double> factors(n * rank), matrix(n * n), q(n), z(n);
    for (double& factor : factors) factor = random.between(-1, 1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t r = 0; r < rank; ++r) matrix[i * n + k] += factors[i * rank + r] * factors[k * rank + r];
    // Chosen so that -wish leaves nothing that closes: then there is a solution.
    std::vector<double> wish(n);
    for (double& each : wish) each = random.between(-1, 0);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] = random.bits() % 3 == 0 ? random.between(0, 0.5) : 0;
      for (std::size_t k = 0; k < n; ++k) q[i] += matrix[i * n + k] * wish[k];
    }
    REQUIRE(strategies::solve_by_lemke(matrix, q, z));
    for (std::size_t i = 0; i < n; ++i) {
      double w = q[i];
      for (std::size_t k = 0; k < n; ++k) w += matrix[i * n + k] * z[k];
      REQUIRE(z[i] >= 0);
      REQUIRE(std::abs(std::min(z[i], w)) < 1e-10);
    }
    ++solved;
  }
  CHECK(solved == 400);
  // A problem that nothing can hold apart.
  std::vector<double> z(1);
  CHECK_FALSE(strategies::solve_by_lemke(std::array{0.0}, std::array{-1.0}, z));
}

TEST_CASE("a box slides down a slope by each solver with g (sin a - mu cos a), and holds where mu is enough") {
  for (const ContactSolver solver : all_solvers)
    for (const double mu : {0.3, 0.8}) {
      CAPTURE(static_cast<int>(solver));
      const double angle = 0.5;
      WorldSettings settings = test::with(solver, Parting::positional_impulse);
      settings.gravity = 9.81 * Vec3(std::sin(angle), -std::cos(angle), 0);
      World world(settings);
      BodySettings floor;
      floor.shape.solid = Plane{};
      floor.fixed = true;
      floor.friction = mu;
      world.add(floor);
      BodySettings box = test::solid_at(Box{Vec3(0.5, 0.1, 0.5)}, Vec3(0, 0.1, 0));
      box.friction = mu;
      const BodyId sliding = world.add(box);
      for (int step = 0; step < 240; ++step) world.step(1.0 / 240);
      const double exact = mu < std::tan(angle) ? 9.81 * (std::sin(angle) - mu * std::cos(angle)) : 0;
      const double loose = solver == ContactSolver::sequential ? 0.2 : 1e-3;
      CHECK(near(world.twist(sliding).linear.x(), exact, loose));
    }
}

TEST_CASE("how many threads there are changes no bit of what the strategies do") {
  for (const ContactSolver solver : all_solvers) {
    std::array<std::uint64_t, 3> hashes{};
    for (const int threads : {1, 2, 3}) {
      WorldSettings settings = test::with(solver, Parting::by_mass);
      settings.threads = threads;
      World world(settings);
      test::add_floor(world);
      for (int i = 0; i < 60; ++i)
        for (int k = 0; k < 3; ++k)
          world.add(test::solid_at(Box{Vec3(0.2, 0.2, 0.2)}, Vec3(i, 0.2 + 0.4 * k, 0.01 * k)));
      for (int step = 0; step < 5; ++step) world.step(1.0 / 60);
      hashes[static_cast<std::size_t>(threads) - 1] = world.state_hash();
    }
    CHECK(hashes[0] == hashes[1]);
    CHECK(hashes[0] == hashes[2]);
  }
}
