#include <tweenfall/physics/world.h>

#include <cstring>

#include "blocks/coloring.h"
#include "blocks/contact_block.h"
#include "support.h"

using namespace tweenfall;

TEST_CASE("no two contacts of one color share a movable body, whatever touches what") {
  test::Random random(3);
  for (int round = 0; round < 50; ++round) {
    const std::uint32_t bodies = 2 + static_cast<std::uint32_t>(random.between(0, 60));
    std::vector<char> movable(bodies);
    for (char& moves : movable) moves = random.between(0, 1) < 0.8;
    blocks::Coloring coloring;
    coloring.reset(bodies);
    std::vector<std::vector<char>> seen(blocks::Coloring::none, std::vector<char>(bodies));
    for (int i = 0; i < 400; ++i) {
      const auto a = static_cast<std::uint32_t>(random.between(0, bodies - 1e-9));
      const auto b = static_cast<std::uint32_t>(random.between(0, bodies - 1e-9));
      if (a == b || !(movable[a] || movable[b])) continue;
      const std::uint32_t color = coloring.color(a, movable[a] != 0, b, movable[b] != 0);
      if (color == blocks::Coloring::none) continue;
      REQUIRE(color < blocks::Coloring::none);
      for (const std::uint32_t body : {a, b}) {
        if (!movable[body]) continue;
        REQUIRE(!seen[color][body]);
        seen[color][body] = 1;
      }
    }
  }
}

TEST_CASE("rows are solved to the same bits with every instruction set") {
  using namespace blocks;
  struct Work {
    std::vector<ContactBlock> blocks;
    std::vector<PointRow> points;
    std::vector<FrictionRow> frictions;
    std::vector<BodyLanes> velocities, displacements;
    [[nodiscard]] Rows rows() {
      return {blocks.data(), blocks.size(), points.data(), frictions.data(), velocities.data(), displacements.data()};
    }
  };
  test::Random random(8);
  const auto fill = [&random](auto& list, std::size_t count) {
    list.resize(count);
    // Of the magnitudes that occur, both signs.
    for (auto& item : list) {
      double numbers[sizeof item / sizeof(double)];
      for (double& number : numbers) number = random.between(-1, 1);
      std::memcpy(&item, numbers, sizeof item);
    }
  };
  Work first;
  constexpr int count = 40;
  fill(first.points, 4 * count);
  fill(first.frictions, 4 * count);
  fill(first.velocities, 8 * count);
  fill(first.displacements, 8 * count);
  for (BodyLanes& body : first.velocities) body.linear[3] = body.angular[3] = 0;
  for (PointRow& row : first.points)
    for (Lanes* lanes : {&row.mass, &row.impulse})
      for (int lane = 0; lane < lane_count; ++lane) (*lanes)[lane] = std::abs((*lanes)[lane]);
  fill(first.blocks, count);
  for (int i = 0; i < count; ++i) {
    ContactBlock& block = first.blocks[static_cast<std::size_t>(i)];
    for (int lane = 0; lane < lane_count; ++lane) {
      block.a[lane] = static_cast<std::uint32_t>((8 * i + 2 * lane) % (8 * count));
      block.b[lane] = static_cast<std::uint32_t>((8 * i + 2 * lane + 9) % (8 * count));
      block.hard[lane] = lane % 2 == 0 ? -1 : 0;
      block.coefficient[lane] = std::abs(block.coefficient[lane]);
      block.restitution[lane] = 0.5;
    }
    block.points = 1 + i % 4;
    block.frictions = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : block.points;
    block.point = block.friction = static_cast<std::uint32_t>(4 * i);
  }
  const Work before = first;
  Work second = first;
  std::vector<std::uint32_t> found_first(4 * count), found_second(4 * count);
  const auto run = [](Work& work, const Kernels& kernels, std::vector<std::uint32_t>& found) {
    kernels.warm_start(work.rows());
    const std::size_t meetings = kernels.find_meetings(work.rows(), work.displacements.data(), 0.01, found.data());
    found.resize(meetings);
    for (int pass = 0; pass < 3; ++pass) kernels.solve(work.rows(), {0.7, 0.2, 0.9, 0.1, 240, true});
  };
  run(first, plain_kernels(), found_first);
  run(second, fastest_kernels(), found_second);
  CHECK(!found_first.empty());
  CHECK(found_first == found_second);
  const auto same = [](const auto& a, const auto& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
  };
  CHECK(same(first.velocities, second.velocities));
  CHECK(same(first.points, second.points));
  CHECK(same(first.frictions, second.frictions));
  CHECK(!same(first.velocities, before.velocities));
  CHECK(!same(first.points, before.points));
  if (&plain_kernels() == &fastest_kernels()) MESSAGE("SKIPPED: this processor has one instruction set only");
}

TEST_CASE("a cloud of bodies that meets in its middle keeps its momentum, and gains no energy") {
  test::Random random(4);
  for (const double restitution : {0.0, 0.3, 1.0}) {
    CAPTURE(restitution);
    World world({.gravity = {0, 0, 0}});
    std::vector<BodyId> bodies;
    const Solid solids[] = {Sphere{0.3}, Box{Vec3(0.3, 0.2, 0.25)}, Capsule{0.15, 0.2}};
    for (int i = 0; i < 125; ++i) {
      BodySettings body;
      body.shape.solid = solids[i % 3];
      body.restitution = restitution;
      body.mass = 1 + i % 4;
      body.motion.pose.position = Vec3(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2) * 0.65;
      body.motion.pose.rotation = random.rotation();
      body.motion.twist.linear = -4 * body.motion.pose.position + random.vector(0.2);
      body.motion.twist.angular = random.vector(2);
      bodies.push_back(world.add(body));
    }
    const auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (const BodyId body : bodies) sum += world.mass(body).mass * world.twist(body).linear;
      return sum;
    };
    const Vec3 before = momentum();
    double energy = world.kinetic_energy();
    std::size_t most = 0;
    for (int step = 0; step < 240; ++step) {
      world.step(1.0 / 120);
      most = std::max(most, world.contacts().size());
      CAPTURE(step);
      CHECK(world.kinetic_energy() <= energy * (1 + 1e-9));
      energy = world.kinetic_energy();
    }
    CHECK(most > 75);
    CHECK((momentum() - before).norm() < 1e-11);
  }
}
