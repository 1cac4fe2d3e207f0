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
      block.a[lane] = 2 * (plane::lane_count * i + lane);
      block.b[lane] = block.a[lane] + 1;
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
