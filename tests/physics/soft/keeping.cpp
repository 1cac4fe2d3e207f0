#include "physics/saved_bytes.h"
#include "physics/soft/soft_scene.h"

#include <algorithm>
#include <limits>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Ropes, a cloth, a soft box and a balloon among bodies, with both solvers; some of it tears.
World varied(int threads = 0) {
  World world({.threads = threads});
  world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId hand =
      world.add({.shape = {Sphere{0.05}}, .drive = Drive::keyed(), .motion = {.pose = {.position = {0, 2, 0}}}});
  const BodyId box = world.add({.shape = {Box{Vec3(0.1, 0.1, 0.1)}}, .motion = {.pose = {.position = {0, 1, 0}}}});
  SoftSettings line =
      rope({.from = {0, 2, 0}, .to = {0, 1.1, 0}, .links = 8, .mass = 0.5, .stiffness = 2e3, .bending = 1e-3});
  line.pins = {{.node = 0, .body = hand, .in_place = true}, {.node = 8, .body = box, .in_place = true}};
  add_soft(world, line);
  SoftSettings sheet =
      cloth({.corner = {0.5, 0.6, 0}, .columns = 5, .rows = 5, .material = {.stretching = 100, .tear = 0.03}});
  sheet.pins = {{.node = 0, .in_place = true}, {.node = 35, .in_place = true}};
  sheet.solver = SoftSolver::springs;
  add_soft(world, sheet);
  world.add({.shape = {Sphere{0.12}}, .motion = {.pose = {.position = {1, 1, 0.5}}}});
  const SoftId gone = add_soft(world, sheet);
  add_soft(world,
           soft_box({.pose = {.position = Vec3(-1, 0.4, 0)}, .half_extents = {0.2, 0.2, 0.2}, .cells = {2, 2, 2}}));
  remove_soft(world, gone);
  return world;
}

void move(World& world, int n) {
  Motion motion;
  motion.pose.position = Vec3(0.01 * n, 2, 0);
  motion.twist.linear = Vec3(2.4, 0, 0);
  world.set_target(world.bodies()[1], motion);
  world.step(n % 3 == 0 ? 1.0 / 240 : 1.0 / 200);
}

}  // namespace

TEST_CASE(
    "a world with soft bodies goes on in the same bits after any copy, and after saving and loading at any step") {
  World original = varied(), relay = original, threaded = varied(3);
  for (int n = 0; n < 60; ++n) {
    move(original, n);
    World next;
    next.load(relay.save());
    relay = next;
    move(relay, n);
    move(threaded, n);
    REQUIRE(relay.state_hash() == original.state_hash());
    REQUIRE(threaded.state_hash() == original.state_hash());
  }
  CHECK(relay.save() == original.save());
  CHECK(soft_bodies(relay) == soft_bodies(original));
  const SoftId sheet = soft_bodies(original)[1];
  std::size_t count_torn = 0;
  for (std::size_t i = 0; i < soft_settings(original, sheet).edges.size(); ++i)
    count_torn += torn(original, sheet, i) ? 1 : 0;
  CHECK(count_torn > 0);
  CHECK(soft_triangles(relay, sheet).size() < 50);
  CHECK(soft_triangles(relay, sheet) == soft_triangles(original, sheet));
  apply_impulse(relay, sheet, 7, {1e-9, 0, 0});
  CHECK(relay.state_hash() != original.state_hash());
}

TEST_CASE("saved soft bodies that cannot be are refused, whatever byte is wrong") {
  World world = varied();
  for (int n = 0; n < 5; ++n) move(world, n);
  const std::vector<std::byte> good = world.save();
  Random random(7);
  for (int n = 0; n < 150; ++n) {
    std::vector<std::byte> bad = good;
    const auto at = header + static_cast<std::size_t>(random.unit() * static_cast<double>(bad.size() - header - 8));
    put(bad, at, n % 2 == 0 ? ~std::uint64_t{0} : 0x7ff8000000000000u);
    seal(bad);
    World other;
    try {
      other.load(bad);
      other.step(1.0 / 240);
      for (const SoftId id : soft_bodies(other)) CHECK(all_finite(other, id));
    } catch (const std::exception&) {
    }
  }
}

TEST_CASE("soft bodies that share a rigid one go the same ways to the bit, whatever soft bodies do far away") {
  struct Shared {
    std::vector<SoftId> softs;
    BodyId box;
  };
  // A cloth that falls on a box, which hangs on a rope, and a rope that falls on the cloth.
  const auto add = [](World& world, double x, double thickness, double stretching) {
    Shared shared;
    shared.box = world.add({.shape = {Box{{0.2, 0.1, 0.2}}}, .mass = 0.5, .motion = {.pose = {.position = {x, 0, 0}}}});
    SoftSettings line = rope({.from = {x, 1, 0}, .to = {x, 0.1, 0}, .links = 8, .stiffness = 500});
    line.pins = {{.node = 0, .in_place = true}, {.node = 8, .body = shared.box, .in_place = true}};
    SoftSettings sheet = cloth({.corner = {x - 0.3, 0.15, -0.3},
                                .along = {0.6, 0, 0},
                                .across = {0, 0, 0.6},
                                .columns = 6,
                                .rows = 6,
                                .material = {.stretching = stretching}});
    sheet.solver = SoftSolver::springs;
    SoftSettings second = rope({.from = {x - 0.2, 0.25, 0.1}, .to = {x + 0.2, 0.25, 0.1}, .links = 8});
    sheet.thickness = second.thickness = thickness;
    for (const SoftSettings& one : {line, sheet, second}) shared.softs.push_back(add_soft(world, one));
    return shared;
  };
  for (const bool far_first : {false, true}) {
    CAPTURE(far_first);
    World alone, beside;
    const Shared one = add(alone, 0, 0.03, 300);
    if (far_first) add(beside, 500, 0.05, 2000);
    const Shared other = add(beside, 0, 0.03, 300);
    if (!far_first) add(beside, 500, 0.05, 2000);
    for (int n = 0; n < 30; ++n) {
      CAPTURE(n);
      alone.step(1.0 / 60);
      beside.step(1.0 / 60);
      REQUIRE(beside.motion(other.box).pose.position == alone.motion(one.box).pose.position);
      for (std::size_t k = 0; k < one.softs.size(); ++k)
        REQUIRE(std::ranges::equal(soft_positions(beside, other.softs[k]), soft_positions(alone, one.softs[k])));
    }
  }
}

TEST_CASE("soft bodies with a thickness that do not meet fall freely, however many there are") {
  World world;
  std::vector<SoftId> ropes;
  for (const double x : {0.0, 5.0}) {
    SoftSettings line = rope({.from = {x, 0, 0}, .to = {x + 1, 0, 0}, .links = 5});
    line.thickness = 0.1;
    ropes.push_back(add_soft(world, line));
  }
  for (int n = 0; n < 60; ++n) world.step(1.0 / 60);
  for (const SoftId id : ropes) CHECK(near(center_of(world, id).y(), -0.5 * 9.81, 1e-9));
}

TEST_CASE("what makes no soft body is refused in words") {
  World world;
  const auto refused = [&](const SoftSettings& settings, const char* words) {
    CAPTURE(words);
    const std::uint64_t before = world.state_hash();
    std::string told;
    try {
      add_soft(world, settings);
    } catch (const std::invalid_argument& fault) {
      told = fault.what();
    }
    CAPTURE(told);
    CHECK(told.find(words) != std::string::npos);
    CHECK(world.state_hash() == before);
  };
  const SoftSettings line = rope({.links = 2, .stiffness = 100});
  SoftSettings bad = line;
  bad.positions.clear();
  refused(bad, "needs nodes");
  bad = {.positions = {Vec3(0, 1, 0)}, .masses = {1}};
  refused(bad, "at least two nodes");
  bad = line;
  bad.masses.pop_back();
  refused(bad, "3 nodes has 2 masses");
  bad = line;
  bad.masses[1] = 0;
  refused(bad, "mass of node 1");
  bad = line;
  bad.positions[2].y() = std::numeric_limits<double>::quiet_NaN();
  refused(bad, "place of node 2");
  bad = line;
  bad.velocities.assign(3, Vec3(0, endless, 0));
  refused(bad, "velocity of node 0");
  bad = line;
  bad.edges[1].b = 9;
  refused(bad, "edge 1 names node 9; there are 3");
  bad = line;
  bad.edges[1].b = bad.edges[1].a;
  refused(bad, "twice");
  bad = line;
  bad.edges[0].length.reset();
  bad.positions[1] = bad.positions[0];
  refused(bad, "edge 0 has no length");
  bad = line;
  bad.edges[0].stiffness = endless;
  bad.solver = SoftSolver::springs;
  refused(bad, "only the positions solver");
  bad = line;
  bad.edges[0].stiffness = endless;
  bad.edges[0].tear = 0.1;
  refused(bad, "never stretches");
  bad = line;
  bad.bends = {{.nodes = {0, 1, 2, 2}, .weights = {1, 1, 1, 0}, .stiffness = 1}};
  refused(bad, "sum to 0");
  bad = line;
  bad.radius = 0;
  refused(bad, "radius");
  bad = line;
  bad.sub_step = 0;
  refused(bad, "sub-steps");
  bad = line;
  bad.pins = {{.node = 3}};
  refused(bad, "there is no node 3");
  bad = line;
  bad.pins = {{.node = 0, .body = {5, 0}}};
  refused(bad, "there is no body");
  SoftSettings solid = soft_box({.cells = {1, 1, 1}});
  solid.positions[0] = solid.positions[7];
  solid.edges.clear();
  refused(solid, "tetrahedron");
  solid = soft_box({.cells = {1, 1, 1}});
  std::swap(solid.tetrahedra[0].nodes[0], solid.tetrahedra[0].nodes[1]);
  refused(solid, "wrong way round");

  CHECK_THROWS_WITH_AS(static_cast<void>(rope({.links = 0})), "a rope has 1 to 100000 links, not 0",
                       std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(rope({.to = {0, 0, 0}})), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(rope({.mass = -1})), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(cloth({.across = {2, 0, 0}})), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(soft_box({.half_extents = {1, 0, 1}})), std::invalid_argument);
  SurfaceMesh mesh{
      .positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, .normals = {}, .texture_coordinates = {}, .triangles = {0, 2, 1}};
  CHECK(cloth(mesh).edges.size() == 3);
  CHECK_THROWS_WITH_AS(static_cast<void>(balloon(mesh)),
                       "the mesh of a balloon must be closed: each edge needs a triangle on either side",
                       std::invalid_argument);
  mesh.positions[1].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(cloth(mesh)), std::invalid_argument);
  mesh.positions.assign(3, Vec3(1, 1, 1));
  CHECK_THROWS_AS(static_cast<void>(cloth(mesh)), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(soft_positions(world, {3, 0})), std::invalid_argument);
}

TEST_CASE("whatever a soft body meets, its nodes stay numbers") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    // Ten thousand nodes at one point, with edges between some that want to be apart.
    SoftSettings heap;
    heap.positions.assign(10'000, Vec3(0, 0.02, 0));
    heap.masses.assign(10'000, 1e-3);
    for (std::uint32_t i = 0; i < 100; ++i) heap.edges.push_back({.a = i, .b = i + 1, .length = 0.1, .stiffness = 100});
    heap.solver = solver;
    const SoftId at_one_point = add_soft(world, heap);
    for (int n = 0; n < 2; ++n) world.step(1.0 / 60);
    CHECK(all_finite(world, at_one_point));
    remove_soft(world, at_one_point);
    // A cloth far too stiff, blown apart; and a box crushed flat and turned inside out.
    SoftSettings sheet = cloth({.corner = {0, 1, 0}, .columns = 4, .rows = 4, .material = {.stretching = 1e12}});
    for (std::size_t i = 0; i < sheet.positions.size(); ++i)
      sheet.velocities.emplace_back(0, i % 2 == 0 ? 1e4 : -1e4, 0);
    sheet.solver = solver;
    const SoftId blown = add_soft(world, sheet);
    SoftSettings solid = soft_box({.pose = {.position = Vec3(5, 0, 0)}, .cells = {1, 1, 1}});
    solid.solver = solver;
    for (std::size_t i = 0; i < 4; ++i) solid.velocities.emplace_back(0, 0, 500);
    solid.velocities.resize(8, Vec3(0, 0, -500));
    const SoftId crushed = add_soft(world, solid);
    for (const double dt : {1.0 / 60, 1.0 / 60, 1.0, 3.0}) {
      world.step(dt);
      for (const SoftId id : {blown, crushed}) REQUIRE(all_finite(world, id));
    }
  }
}
