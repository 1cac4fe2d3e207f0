#include "physics/soft/soft_scene.h"
#include "processor_time.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr int long_side = 120, short_side = 3;

/// A ribbon of very stiff springs along x, whose last nodes are pinned to a bar.
SoftSettings ribbon(World& world) {
  SoftSettings made = cloth({.along = {0.6, 0, 0},
                             .across = {0, 0, 0.3},
                             .columns = long_side,
                             .rows = short_side,
                             .material = {.stretching = 1e6, .damping = 1e3, .bending = 1e-4}});
  made.solver = SoftSolver::springs;
  const BodyId bar = world.add(
      {.shape = {Box{Vec3(0.01, 0.01, 0.2)}}, .mass = 0.1, .motion = {.pose = {.position = Vec3(0.6, 0, 0.15)}}});
  for (std::uint32_t j = 0; j <= short_side; ++j) {
    made.pins.push_back({.node = j * (long_side + 1), .in_place = true});
    made.pins.push_back({.node = j * (long_side + 1) + long_side, .body = bar, .in_place = true});
  }
  made.collide = false;
  return made;
}

std::uint32_t across_of(std::uint32_t node) {
  return node % (long_side + 1) * (short_side + 1) + node / (long_side + 1);
}

/// The same with its nodes numbered across it.
SoftSettings numbered_across(SoftSettings made) {
  const SoftSettings before = made;
  for (std::uint32_t node = 0; node < made.positions.size(); ++node) {
    made.positions[across_of(node)] = before.positions[node];
    made.masses[across_of(node)] = before.masses[node];
  }
  for (SoftEdge& edge : made.edges)
    edge = {across_of(edge.a), across_of(edge.b), edge.length, edge.stiffness, edge.damping};
  for (SoftBend& bend : made.bends)
    for (std::uint32_t& node : bend.nodes) node = across_of(node);
  for (auto& triangle : made.triangles)
    for (std::uint32_t& node : triangle) node = across_of(node);
  for (SoftPin& pin : made.pins) pin.node = across_of(pin.node);
  return made;
}

}  // namespace

TEST_CASE("how the nodes of a stiff cloth are numbered changes neither its motion nor, by much, the time it takes") {
  World along, across;
  const SoftId first = add_soft(along, ribbon(along)), second = add_soft(across, numbered_across(ribbon(across)));
  const double begin = processor_seconds();
  for (int n = 0; n < 4; ++n) across.step(1.0 / 60);
  const double between = processor_seconds();
  for (int n = 0; n < 4; ++n) along.step(1.0 / 60);
  CHECK(processor_seconds() - between < 4 * (between - begin));  // 15 times as long if it is not ordered anew
  for (std::uint32_t node = 0; node < soft_positions(along, first).size(); ++node)
    REQUIRE(near(soft_positions(along, first)[node], soft_positions(across, second)[across_of(node)], 1e-9));
  CHECK(along.kinetic_energy() > 0.001);
}

TEST_CASE("the energy of a cantilevered cloth never grows") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    SoftSettings sheet =
        cloth({.across = {0, 0, 1}, .columns = 10, .rows = 10, .material = {.stretching = 500, .bending = 1e-3}});
    for (std::uint32_t i = 0; i <= 10; ++i) sheet.pins.push_back({.node = i, .in_place = true});
    sheet.solver = solver;
    World world;
    const SoftId id = add_soft(world, sheet);
    const double start = energy_of(world, id);
    double before = start, lowest = 0;
    for (int n = 0; n < 300; ++n) {
      world.step(1.0 / 240);
      const double now = energy_of(world, id);
      REQUIRE(now <= before + 1e-9 * std::max(1.0, std::abs(start)));
      before = now;
      lowest = std::min(lowest, soft_positions(world, id)[120].y());
    }
    CHECK(lowest < -0.5);
    CHECK(all_finite(world, id));
  }
}

TEST_CASE(
    "the energy of a cantilevered cloth of constraints never grows, however stiff or damped it is or finely woven") {
  struct Weave {
    int cells;
    ClothMaterial material;
  };
  const Weave weaves[] = {{20, {}},
                          {10, {.stretching = 1e5, .bending = 1e-3}},
                          {10, {.stretching = 1e8, .bending = 1e-3}},
                          {20, {.stretching = 1e12}},
                          {10, {.damping = 50, .bending = 1e-3}},
                          {10, {.damping = 5000}},
                          {10, {.bending = 100}}};
  for (const Weave& weave : weaves) {
    const int cells = weave.cells;
    const ClothMaterial& material = weave.material;
    CAPTURE(cells);
    CAPTURE(material.stretching);
    CAPTURE(material.damping);
    CAPTURE(material.bending);
    SoftSettings sheet = cloth({.columns = cells, .rows = cells, .material = material});
    for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(cells); ++i)
      sheet.pins.push_back({.node = i, .in_place = true});
    World world;
    const SoftId id = add_soft(world, sheet);
    double before = energy_of(world, id), lowest = 0;
    for (int n = 0; n < 240; ++n) {
      world.step(1.0 / 240);
      const double now = energy_of(world, id);
      REQUIRE(now <= before + 1e-12);
      before = now;
      const auto x = soft_positions(world, id);
      lowest = std::min(lowest, x.back().y());
      double longest = 0;
      for (const SoftEdge& edge : soft_settings(world, id).edges)
        longest = std::max(longest, (x[edge.a] - x[edge.b]).norm() / *edge.length);
      REQUIRE(longest < 1.01);
    }
    if (material.bending < 1) CHECK(lowest < -0.9);
  }
}

TEST_CASE("damping gives a cantilevered cloth no energy, however hard it is and however few the passes") {
  for (const int iterations : {1, 2, 3})
    for (const double damping : {10.0, 1e3, 1e8})
      for (const double stretching : {1e4, 1e9}) {
        CAPTURE(iterations);
        CAPTURE(damping);
        CAPTURE(stretching);
        SoftSettings sheet = cloth(
            {.columns = 8, .rows = 8, .material = {.stretching = stretching, .damping = damping, .bending = 1e-4}});
        for (std::uint32_t j = 0; j <= 8; ++j) sheet.pins.push_back({.node = 9 * j, .in_place = true});
        sheet.iterations = iterations;
        World world;
        const SoftId id = add_soft(world, sheet);
        double before = energy_of(world, id);
        for (int n = 0; n < 90; ++n) {
          world.step(1.0 / 60);
          const double now = energy_of(world, id);
          REQUIRE(now <= before + 1e-9);  // 8e-4 J if damping is one of the constraints
          before = now;
        }
        CHECK(before < -0.1);
      }
}

// A strip stretched evenly and slowly has the same strain everywhere.
TEST_CASE("a cloth tears at its strain, however hard it is damped") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs})
    for (const double damping : {0.0, 2.0, 5000.0}) {
      CAPTURE(static_cast<int>(solver));
      CAPTURE(damping);
      SoftSettings strip = cloth({.along = {0.2, 0, 0},
                                  .across = {0, -1, 0},
                                  .columns = 4,
                                  .rows = 20,
                                  .material = {.stretching = 500, .damping = damping, .tear = 0.1}});
      for (std::uint32_t i = 0; i <= 4; ++i)
        for (const std::uint32_t node : {i, 100 + i}) strip.pins.push_back({.node = node, .in_place = true});
      strip.solver = solver;
      World world({.gravity = {0, 0, 0}});
      const SoftId id = add_soft(world, strip);
      double strain = 0;
      while (soft_tears(world, id).empty() && strain < 0.2) {
        strain += 0.1 / 240;
        for (std::uint32_t i = 100; i <= 104; ++i)
          lead_pin(world, id, i, strip.positions[i] - Vec3(0, strain, 0), Vec3(0, -0.1, 0));
        world.step(1.0 / 240);
      }
      CHECK(strain > 0.092);
      CHECK(strain < 0.101);
    }
}

// Cloth and step by step the same fall: what hardly stretches swings as what is ten times as stiff.
TEST_CASE("the energy of a cantilevered cloth of springs never grows, however stiff it is, and it swings as it must") {
  std::vector<double> ends;
  for (const double stretching : {1e7, 1e9, 1e10, 1e11, 1e12}) {
    CAPTURE(stretching);
    SoftSettings sheet = cloth({.columns = 8, .rows = 8, .material = {.stretching = stretching}});
    for (std::uint32_t row = 0; row <= 8; ++row) sheet.pins.push_back({.node = 9 * row, .in_place = true});
    sheet.solver = SoftSolver::springs;
    World world;
    const SoftId id = add_soft(world, sheet);
    double before = energy_of(world, id);
    for (int n = 0; n < 120; ++n) {
      world.step(1.0 / 240);
      const double now = energy_of(world, id);
      REQUIRE(now <= before + 1e-12);
      // A force of its weight in edges that give way by so little.
      REQUIRE(soft_energy(world, id).elastic < 10 / stretching);
      before = now;
    }
    ends.push_back(soft_positions(world, id)[8].y());
  }
  for (const double end : ends) CHECK(near(end, ends[0], 2e-3));
}

TEST_CASE("a cloth of fine cells, however stiff, swings no faster than its fall can make it") {
  for (const double stretching : {20'000.0, 100'000.0}) {
    CAPTURE(stretching);
    SoftSettings sheet = cloth({.corner = {0, 1, 0},
                                .along = {1.2, 0, 0},
                                .across = {0, 0, 0.7},
                                .columns = 18,
                                .rows = 9,
                                .material = {.density = 0.31, .stretching = stretching, .bending = 0.003}});
    for (std::uint32_t row = 0; row <= 9; ++row)
      for (std::uint32_t i = 0; i < 2; ++i) sheet.pins.push_back({.node = 19 * row + i, .in_place = true});
    World world;
    const SoftId id = add_soft(world, sheet);
    const double start = energy_of(world, id);
    for (int n = 0; n < 240; ++n) {
      world.step(1.0 / 240);
      // Bodies held by such stiff edges are off by as much as their lengths: little.
      const SoftEnergy energy = soft_energy(world, id);
      REQUIRE(energy.kinetic + energy.weight <= start);
      REQUIRE(energy.elastic < 0.25 * start);
    }
    CHECK(energy_of(world, id) < 0.99 * start);
  }
}

TEST_CASE("pins of a rope of many links bear its weight, step by step, by either solver") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    SoftSettings line =
        rope({.from = {-1, 0, 0}, .to = {1, 0, 0}, .links = 100, .slack = 0.3, .mass = 0.5, .stiffness = 1e5});
    for (Vec3& place : line.positions) place.y() = -0.8 * (1 - std::abs(place.x()));
    line.solver = solver;
    line.linear_damping = 4;
    line.pins = {{.node = 0, .in_place = true}, {.node = 100, .in_place = true}};
    World world;
    const SoftId id = add_soft(world, line);
    for (int n = 0; n < 240 * 5; ++n) world.step(1.0 / 240);
    for (int n = 0; n < 10; ++n) {
      world.step(1.0 / 240);
      Vec3 borne(0, 0, 0);
      for (const SoftPinReading& pin : soft_pins(world, id)) borne += pin.force;
      CHECK(near(borne, Vec3(0, -0.5 * 9.81, 0), 1e-3));
    }
  }
}

// Energy over area of a sheet bent to a cylinder: bending / (2 radius^2).
TEST_CASE("a cloth rolled to a cylinder holds the energy of its curvature") {
  SoftSettings sheet = cloth({.along = {1, 0, 0},
                              .across = {0, 0, 1},
                              .columns = 24,
                              .rows = 24,
                              .material = {.stretching = 1e-6, .bending = 0.3}});
  const double radius = 0.8;
  std::vector<Vec3> rolled = sheet.positions;
  for (Vec3& place : rolled)
    place = Vec3(radius * std::sin(place.x() / radius), radius * (1 - std::cos(place.x() / radius)), place.z());
  double energy = 0;
  for (const SoftBend& bend : sheet.bends) {
    Vec3 off(0, 0, 0), flat(0, 0, 0);
    for (std::size_t k = 0; k < 4; ++k) {
      off += bend.weights[k] * rolled[bend.nodes[k]];
      flat += bend.weights[k] * sheet.positions[bend.nodes[k]];
    }
    CHECK(flat.norm() < 1e-12);
    energy += 0.5 * bend.stiffness * off.squaredNorm();
  }
  CHECK(energy == doctest::Approx(0.5 * 0.3 / (radius * radius)).epsilon(0.06));
}

TEST_CASE("a strip of cloth stretches by its load over its width and stiffness") {
  SoftSettings strip = cloth({.along = {0.2, 0, 0},
                              .across = {0, -1, 0},
                              .columns = 4,
                              .rows = 20,
                              .material = {.density = 0.01, .stretching = 1000, .damping = 30}});
  for (std::uint32_t i = 0; i <= 4; ++i) strip.pins.push_back({.node = i, .in_place = true});
  const double load = 0.2;
  for (std::size_t i = 0; i <= 4; ++i) strip.masses[100 + i] += load * (i == 0 || i == 4 ? 0.125 : 0.25);
  strip.solver = SoftSolver::springs;
  strip.linear_damping = 3;
  World world;
  const SoftId id = add_soft(world, strip);
  step(world, 3, 1.0 / 120);
  // A mesh of equal triangles resists like a sheet of Poisson's ratio 1/3 (Van Gelder, 1998): somewhat more than its
  // edges along the load alone.
  const double stretched = -soft_positions(world, id)[102].y() - 1;
  CHECK(stretched == doctest::Approx(load * 9.81 / (0.2 * 1000)).epsilon(0.25));
  CHECK(stretched < load * 9.81 / (0.2 * 1000));
}

TEST_CASE("a soft box keeps its volume and a balloon its air") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    SoftSettings box = soft_box({.pose = {.position = Vec3(0, 0.3, 0)},
                                 .half_extents = {0.2, 0.2, 0.2},
                                 .cells = {3, 3, 3},
                                 .material = {.stiffness = 1e4, .bulk = 1e6}});
    double mass = 0;
    for (const double one : box.masses) mass += one;
    CHECK(near(mass, 100 * 0.064, 1e-12));
    box.solver = solver;
    box.linear_damping = 2;
    const SoftId id = add_soft(world, box);
    step(world, 1.2);
    double volume = 0;
    const auto x = soft_positions(world, id);
    for (const SoftTetrahedron& solid : box.tetrahedra) {
      const auto& n = solid.nodes;
      volume += (x[n[1]] - x[n[0]]).dot((x[n[2]] - x[n[0]]).cross(x[n[3]] - x[n[0]])) / 6;
    }
    CHECK(volume == doctest::Approx(0.064).epsilon(0.01));
    double lowest = 1, highest = 0;
    for (const Vec3& place : x) {
      lowest = std::min(lowest, place.y());
      highest = std::max(highest, place.y());
    }
    CHECK(lowest > 0.0095);
    CHECK(highest == doctest::Approx(0.41).epsilon(0.05));
    CHECK(all_finite(world, id));
  }
}
