#include "planar/contacts/contact_block.h"

#include <cstring>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;
namespace plane = tweenfall::planar::inner;

TEST_CASE("in a plane rows give the same bits in registers of any width") {
  Random random(5);
  const auto fill = [&](plane::Lanes& lanes, double low, double high) {
    for (double& lane : lanes.lanes) lane = random.between(low, high);
  };
  std::vector<plane::BodyRow> bodies(65), moved(65);
  std::vector<plane::ContactBlock> blocks(4);
  for (plane::BodyRow& row : bodies) row = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0};
  for (plane::BodyRow& row : moved) row = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0};
  for (std::uint32_t i = 0; i < blocks.size(); ++i) {
    plane::ContactBlock& block = blocks[i];
    block.points = 1 + static_cast<int>(i % 2);
    for (std::uint32_t lane = 0; lane < plane::lane_count; ++lane) {
      block.a[lane] = plane::row_length * 2 * (plane::lane_count * i + lane);
      block.b[lane] = block.a[lane] + plane::row_length;
      const double angle = random.between(0, 6);
      block.normal_x[lane] = std::cos(angle);
      block.normal_y[lane] = std::sin(angle);
    }
    for (plane::Lanes* lanes : {&block.friction, &block.inverse_mass_a, &block.inverse_mass_b, &block.inverse_moment_a,
                                &block.inverse_moment_b, &block.ahead})
      fill(*lanes, 0, 1);
    for (plane::PointRow& point : block.point) {
      for (plane::Lanes* lanes :
           {&point.turn_a, &point.turn_b, &point.slip_a, &point.slip_b, &point.gap, &point.sideways})
        fill(*lanes, -1, 1);
      for (plane::Lanes* lanes : {&point.mass, &point.slip_mass, &point.normal}) fill(*lanes, 0, 1);
      fill(point.total_normal, 0, 0);
      fill(point.total_sideways, 0, 0);
    }
  }
  const plane::PassRule rule{9, 0.5, 0.9, 0.95, 240, true};
  const auto run = [&](const plane::Kernels& kernel) {
    std::vector<plane::BodyRow> velocities = bodies;
    std::vector<plane::ContactBlock> its = blocks;
    kernel.warm_start(its.data(), its.size(), velocities.data());
    for (int i = 0; i < 5; ++i) kernel.solve(its.data(), its.size(), velocities.data(), moved.data(), rule);
    return velocities;
  };
  const std::vector<plane::BodyRow> expected = run(*plane::possible_kernels()[0]);
  CHECK(expected[0].x != bodies[0].x);
  for (const plane::Kernels* kernel : plane::possible_kernels())
    CHECK(std::memcmp(run(*kernel).data(), expected.data(), sizeof(plane::BodyRow) * expected.size()) == 0);
}

TEST_CASE("in a plane contacts are prepared to the same bits in registers of any width, and as the formulas say") {
  Random random(6);
  std::vector<plane::BodyRow> velocities(17), poses(17), masses(17);
  for (std::size_t i = 0; i < 16; ++i) {
    const double angle = random.between(-3, 3);
    velocities[i] = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0};
    poses[i] = {random.between(-1, 1), random.between(-1, 1), std::cos(angle), std::sin(angle)};
    masses[i] = {random.between(0.1, 1), random.between(0.1, 1), 0, 0};
  }
  plane::ContactBlock block;
  block.points = 2;
  for (std::uint32_t lane = 0; lane < plane::lane_count; ++lane) {
    block.a[lane] = plane::row_length * 2 * lane;
    block.b[lane] = block.a[lane] + plane::row_length;
    const double angle = random.between(0, 6);
    block.normal_x[lane] = std::cos(angle);
    block.normal_y[lane] = std::sin(angle);
    block.skin_a[lane] = random.between(0, 0.1);
    block.skin_b[lane] = random.between(0, 0.1);
    for (int i = 0; i < 2; ++i) {
      plane::PointRow& point = block.point[i];
      for (plane::Lanes* lanes : {&point.turn_a, &point.turn_b, &point.slip_a, &point.slip_b})
        (*lanes)[lane] = random.between(-1, 1);
      point.mass[lane] = i == 0 || lane % 3 != 0 ? 1 : 0;
    }
  }
  const auto run = [&](const plane::Kernels& kernel) {
    plane::ContactBlock its = block;
    kernel.prepare(&its, 1, {velocities.data(), poses.data(), masses.data()});
    return its;
  };
  const plane::ContactBlock expected = run(*plane::possible_kernels()[0]);
  for (const plane::Kernels* kernel : plane::possible_kernels()) {
    const plane::ContactBlock its = run(*kernel);
    CHECK(std::memcmp(&its.normal_x, &expected.normal_x, sizeof its.normal_x) == 0);
    CHECK(std::memcmp(&its.approach, &expected.approach, sizeof its.approach) == 0);
    for (int i = 0; i < 2; ++i) {
      CHECK(std::memcmp(&its.point[i].turn_a, &expected.point[i].turn_a, 4 * sizeof(plane::Lanes)) == 0);
      CHECK(std::memcmp(&its.point[i].gap, &expected.point[i].gap, sizeof(plane::Lanes)) == 0);
      CHECK(std::memcmp(&its.point[i].mass, &expected.point[i].mass, sizeof(plane::Lanes)) == 0);
      CHECK(std::memcmp(&its.point[i].slip_mass, &expected.point[i].slip_mass, sizeof(plane::Lanes)) == 0);
    }
  }
  for (std::uint32_t lane = 0; lane < plane::lane_count; ++lane) {
    const std::size_t a = 2 * lane, b = a + 1;
    const auto turned = [&](std::size_t body, const Vec2& v) {
      const plane::BodyRow& pose = poses[body];
      return Vec2(pose.turn * v.x() - pose.unused * v.y(), pose.unused * v.x() + pose.turn * v.y());
    };
    const auto rate = [&](std::size_t body, const Vec2& arm) {
      const plane::BodyRow& v = velocities[body];
      return Vec2(v.x - v.turn * arm.y(), v.y + v.turn * arm.x());
    };
    const Vec2 normal = turned(a, Vec2(block.normal_x[lane], block.normal_y[lane])), tangent(-normal.y(), normal.x());
    const Vec2 apart(poses[b].x - poses[a].x, poses[b].y - poses[a].y);
    double approach = 0;
    for (int i = 0; i < 2; ++i) {
      const plane::PointRow &point = block.point[i], &made = expected.point[i];
      if (point.mass[lane] == 0) {
        CHECK(made.mass[lane] == 0);
        CHECK(made.slip_mass[lane] == 0);
        continue;
      }
      // Where the skins touch: friction acts there, and so do normals, along the same line as at the cores.
      const Vec2 core_a = turned(a, Vec2(point.turn_a[lane], point.turn_b[lane]));
      const Vec2 core_b = turned(b, Vec2(point.slip_a[lane], point.slip_b[lane]));
      const Vec2 on_a = core_a + block.skin_a[lane] * normal, on_b = core_b - block.skin_b[lane] * normal;
      const auto mass = [&](const Vec2& along) {
        const auto cross = [&](const Vec2& arm) { return arm.x() * along.y() - arm.y() * along.x(); };
        return 1 / (masses[a].x + masses[b].x + masses[a].y * cross(on_a) * cross(on_a) +
                    masses[b].y * cross(on_b) * cross(on_b));
      };
      CHECK(near(made.gap[lane], normal.dot(apart + on_b - on_a), 1e-14));
      CHECK(near(made.mass[lane], mass(normal), 1e-13));
      CHECK(near(made.slip_mass[lane], mass(tangent), 1e-13));
      approach = std::max(approach, normal.dot(rate(a, core_a) - rate(b, core_b)));
    }
    CHECK(near(expected.approach[lane], approach, 1e-14));
  }
}

TEST_CASE("in a plane bodies move on to the same bits in registers of any width, in one pass as in two") {
  Random random(7);
  std::vector<plane::BodyRow> velocities(20), starts(20), unpushed(20), moved(20), gains(20);
  for (std::vector<plane::BodyRow>* rows : {&velocities, &starts, &unpushed, &moved, &gains})
    for (plane::BodyRow& row : *rows) row = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0};
  // Those that nothing pushed, and one of which only the spin was pushed.
  for (std::size_t i = 0; i < 20; i += 3) unpushed[i] = velocities[i];
  unpushed[3].turn += 1;
  const std::vector<std::uint32_t> moving{0, 1, 2, 3, 5, 6, 8, 9, 13, 18, 19};
  struct Bodies {
    std::vector<plane::BodyRow> velocities, starts, unpushed, moved;
  };
  const auto after = [&](const auto& work) {
    Bodies its{velocities, starts, unpushed, moved};
    work(
        plane::BodyRows{its.velocities.data(), its.starts.data(), its.unpushed.data(), its.moved.data(), gains.data()});
    return its;
  };
  const double h = 0.25;
  const auto same = [](const std::vector<plane::BodyRow>& one, const std::vector<plane::BodyRow>& other) {
    return std::memcmp(one.data(), other.data(), sizeof(plane::BodyRow) * one.size()) == 0;
  };
  const Bodies expected =
      after([&](const plane::BodyRows& rows) { plane::possible_kernels()[0]->move_on(rows, moving, h); });
  for (const plane::Kernels* kernel : plane::possible_kernels()) {
    const Bodies once = after([&](const plane::BodyRows& rows) { kernel->move_on(rows, moving, h); });
    const Bodies twice = after([&](const plane::BodyRows& rows) {
      kernel->move(rows, moving, h);
      kernel->begin(rows, moving, h, true);
    });
    for (const Bodies* its : {&once, &twice}) {
      CHECK(same(its->velocities, expected.velocities));
      CHECK(same(its->starts, expected.starts));
      CHECK(same(its->unpushed, expected.unpushed));
      CHECK(same(its->moved, expected.moved));
    }
  }
  // 0 was not pushed and flies by its mean velocity; 3 turned; 4 is not under way.
  CHECK(expected.moved[0].x == moved[0].x + 0.5 * (starts[0].x + velocities[0].x) * h);
  CHECK(expected.moved[3].x == moved[3].x + velocities[3].x * h);
  CHECK(expected.moved[4].x == moved[4].x);
  CHECK(expected.unpushed[1].x == velocities[1].x + gains[1].x * h);
  CHECK(expected.velocities[1].x == expected.unpushed[1].x + (velocities[1].x - unpushed[1].x));
}
