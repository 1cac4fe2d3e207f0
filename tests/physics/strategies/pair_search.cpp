#include <tweenfall/physics/pair_search.h>

#include <array>
#include <bit>
#include <limits>

#include "physics/strategies/ground.h"

using namespace tweenfall;

namespace {

constexpr std::array every_search{PairSearch::tree,     PairSearch::all_pairs, PairSearch::sweep,   PairSearch::grid,
                                  PairSearch::quadtree, PairSearch::octree,    PairSearch::kd_tree, PairSearch::bvh};

std::vector<Bounds> random_boxes(test::Random& random, std::size_t count, double space, double largest) {
  std::vector<Bounds> boxes;
  boxes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 low = random.vector(space);
    const double x = random.between(0, largest), y = random.between(0, largest), z = random.between(0, largest);
    boxes.push_back({low, low + Vec3(x, y, z)});
  }
  return boxes;
}

/// All pairs by their definition, without any of our searches.
std::vector<std::pair<std::uint32_t, std::uint32_t>> counted_out(const std::vector<Bounds>& boxes) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      bool meet = true;
      for (int axis = 0; axis < 3; ++axis)
        meet = meet && !(boxes[a].high[axis] < boxes[b].low[axis]) && !(boxes[b].high[axis] < boxes[a].low[axis]);
      if (meet) pairs.emplace_back(a, b);
    }
  return pairs;
}

void require_same(const std::vector<Bounds>& boxes) {
  const auto all = counted_out(boxes);
  for (const PairSearch search : every_search) {
    CAPTURE(static_cast<int>(search));
    REQUIRE(find_pairs(search, boxes).pairs == all);
  }
}

}  // namespace

TEST_CASE("every search finds the pairs of boxes that all pairs have, each once") {
  test::Random random(1);
  for (int round = 0; round < 60; ++round) {
    const std::size_t count = random.bits() % 300;
    const double space = random.between(0.1, 20), largest = random.between(0, 3);
    require_same(random_boxes(random, count, space, largest));
  }
}

TEST_CASE("boxes that only touch, are all alike, are points, lie in a row or reach everywhere are found all the same") {
  std::vector<Bounds> row, alike, points, mixed;
  for (int i = 0; i < 100; ++i) {
    row.push_back({Vec3(i, 0, 0), Vec3(i + 1, 1, 1)});
    alike.push_back({Vec3(0, 0, 0), Vec3(1, 1, 1)});
    points.push_back({Vec3(i % 10, i / 10, 0), Vec3(i % 10, i / 10, 0)});
    mixed.push_back({Vec3(i % 7, 0, i % 3), Vec3(i % 7 + 0.5, 1e-300, i % 3 + 1e6 * (i % 10 == 0 ? 1 : 0))});
  }
  mixed.push_back({Vec3::Constant(-1e100), Vec3::Constant(1e100)});
  mixed.push_back({Vec3(1e15, 0, 0), Vec3(1e15 + 2, 1, 1)});
  mixed.push_back({Vec3(1e15 + 2, 0, 0), Vec3(1e15 + 4, 1, 1)});
  for (const std::vector<Bounds>& boxes : {row, alike, points, mixed, std::vector<Bounds>{}, {row[0]}})
    require_same(boxes);
}

TEST_CASE("all pairs are n (n - 1) / 2 tests, and every other search takes fewer where boxes are spread out") {
  test::Random random(9);
  const std::vector<Bounds> boxes = random_boxes(random, 1000, 20, 1);
  CHECK(find_pairs(PairSearch::all_pairs, boxes).tests == 1000 * 999 / 2);
  for (const PairSearch search : every_search) {
    CAPTURE(static_cast<int>(search));
    if (search != PairSearch::all_pairs) CHECK(find_pairs(search, boxes).tests < 100'000);
  }
}

TEST_CASE("the lecture's grid: of nine bodies five pairs share a cell, of the 36 that there are") {
  // Cells of 2 m; two by two in cells of their own, three that share one, and one that lies in two cells.
  const auto at = [](double x, double y) { return Bounds{Vec3(x, y, 0), Vec3(x + 1, y + 1, 1)}; };
  const std::vector<Bounds> boxes{at(0.1, 0.1), at(0.8, 0.8), at(4.1, 0.1), at(4.5, 0.8), at(5.4, 0.5),
                                  at(6.6, 0.1), at(0.2, 4.2), at(4.2, 4.2), at(8.2, 4.2)};
  const PairsFound found = find_pairs(PairSearch::grid, boxes);
  CHECK(found.tests == 5);
  CHECK(find_pairs(PairSearch::all_pairs, boxes).tests == 36);
}

TEST_CASE("a world goes by the same bits by whichever search it finds its pairs") {
  std::array<std::uint64_t, every_search.size()> hashes{};
  for (std::size_t i = 0; i < every_search.size(); ++i) {
    WorldSettings settings;
    settings.broad_phase = every_search[i];
    World world(settings);
    test::add_floor(world);
    test::Random random(4);
    for (int k = 0; k < 60; ++k) {
      const double x = random.between(-2, 2), y = random.between(0.3, 4), z = random.between(-2, 2);
      BodySettings body = test::solid_at(Box{Vec3(0.2, 0.15, 0.25)}, Vec3(x, y, z));
      if (k % 3 == 0) body.shape.solid = Sphere{0.2};
      if (k % 10 == 0) body.fixed = true;
      body.restitution = 0.3;
      world.add(body);
    }
    for (int step = 0; step < 120; ++step) world.step(1.0 / 60);
    // The setting itself is part of a world's state, so the motion of the bodies is compared.
    for (const BodyId body : world.bodies())
      for (const double part : {world.motion(body).pose.position.x(), world.twist(body).linear.y(),
                                world.motion(body).pose.rotation.w(), world.twist(body).angular.z()})
        hashes[i] = hashes[i] * 31 + std::bit_cast<std::uint64_t>(part);
  }
  for (const std::uint64_t hash : hashes) CHECK(hash == hashes[0]);
}

TEST_CASE("a crowd at one place neither fills the memory nor takes for ever, by whichever search") {
  for (const PairSearch search : every_search) {
    WorldSettings settings;
    settings.broad_phase = search;
    World world(settings);
    for (int i = 0; i < 3000; ++i) world.add(test::solid_at(Sphere{0.5}, Vec3(0, 1, 0)));
    world.step(1.0 / 60);
    CHECK(world.motion(world.bodies().front()).pose.position.allFinite());
  }
}

TEST_CASE("boxes that are none are refused by number") {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const Bounds& wrong : {Bounds{Vec3(1, 0, 0), Vec3(0, 1, 1)}, Bounds{Vec3(nothing, 0, 0), Vec3(1, 1, 1)},
                              Bounds{Vec3(0, 0, 0), Vec3(1, 1, std::numeric_limits<double>::infinity())}}) {
    const std::array<Bounds, 2> boxes{Bounds{Vec3(0, 0, 0), Vec3(1, 1, 1)}, wrong};
    CHECK_THROWS_WITH_AS(static_cast<void>(find_pairs(PairSearch::grid, boxes)),
                         "box 1 is not finite, or its low end is above its high one", std::invalid_argument);
  }
  CHECK_THROWS_AS(static_cast<void>(find_pairs(static_cast<PairSearch>(99), {})), std::invalid_argument);
}
