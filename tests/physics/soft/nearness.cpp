#include "physics/soft/soft_scene.h"

#include <cmath>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Two point masses with nothing but a thickness.
SoftSettings two_beads(SoftSolver solver) {
  SoftSettings beads;
  beads.positions = {Vec3(-0.3, 0, 0), Vec3(0.3, 0.02, 0)};
  beads.velocities = {Vec3(2, 0, 0), Vec3(-1, 0, 0)};
  beads.masses = {0.1, 0.3};
  beads.solver = solver;
  beads.thickness = 0.1;
  beads.sub_step = 1.0 / 1920;
  return beads;
}

double nearest_two(const World& world, SoftId id, std::size_t apart) {
  const auto places = soft_positions(world, id);
  double nearest = 1e9;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = i + apart; k < places.size(); ++k) nearest = std::min(nearest, (places[i] - places[k]).norm());
  return nearest;
}

}  // namespace

TEST_CASE("nodes that meet come no nearer than a thickness, and keep their momentum") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    World world({.gravity = {0, 0, 0}});
    SoftSettings beads = two_beads(solver);
    beads.friction = 0;
    const SoftId id = add_soft(world, beads);
    const Vec3 before = momentum_of(world, id);
    for (int n = 0; n < 120; ++n) {
      world.step(1.0 / 240);
      CHECK(nearest_two(world, id, 1) > 0.1 - 1e-9);
    }
    CHECK(near(momentum_of(world, id), before, 1e-12));
    // Of 3 m/s, the part across the line between them remains, whose offset is a fifth of their distance; along it
    // nothing.
    const Vec3 parting = soft_velocities(world, id)[1] - soft_velocities(world, id)[0];
    CAPTURE(parting.transpose());
    CHECK(near(parting.norm(), 3 * 0.02 / 0.1, 0.03));
  }
  // Without a thickness, nothing.
  World world({.gravity = {0, 0, 0}});
  SoftSettings beads = two_beads(SoftSolver::positions);
  beads.thickness = 0;
  const SoftId id = add_soft(world, beads);
  step(world, 0.2);
  CHECK(near(soft_velocities(world, id)[0], Vec3(2, 0, 0), 1e-12));
}

TEST_CASE("a rope that falls in a heap lies on itself where it has a thickness, and in itself where it has none") {
  double nearest[2] = {};
  for (const bool thick : {false, true}) {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    SoftSettings line = rope({.from = {0, 0.05, 0}, .to = {0.01, 1.25, 0.005}, .links = 40, .mass = 0.4});
    line.radius = 0.015;
    line.thickness = thick ? 0.03 : 0;
    line.linear_damping = 1;
    const SoftId id = add_soft(world, line);
    step(world, 1.5);
    CHECK(all_finite(world, id));
    nearest[thick ? 1 : 0] = nearest_two(world, id, 2);
  }
  CHECK(nearest[1] > 0.9 * 0.03);
  CHECK(nearest[0] < 0.5 * nearest[1]);
}

TEST_CASE("what is deep in itself is let out slowly, ten thousand nodes in one place stay numbers") {
  World world;
  SoftSettings heap;
  heap.positions.assign(10'000, Vec3(0, 5, 0));
  heap.masses.assign(10'000, 1e-3);
  heap.thickness = 0.01;
  const SoftId same_place = add_soft(world, heap);
  world.step(1.0 / 240);
  CHECK(all_finite(world, same_place));
  SoftSettings pair = two_beads(SoftSolver::positions);
  pair.velocities.clear();
  World deep({.gravity = {0, 0, 0}, .push_out_speed = 0.5});
  const SoftId id = add_soft(deep, pair);
  step(deep, 0.5);
  pair.positions = {Vec3(0, 0, 0), Vec3(0.3, 0, 0)};
  pair.velocities = {Vec3(2, 0, 0), Vec3(-2, 0, 0)};
  pair.thickness = 1e-3;  // they move farther in a sub-step, and pass
  const SoftId fast = add_soft(deep, pair);
  step(deep, 0.5);
  CHECK(all_finite(deep, id));
  CHECK(soft_positions(deep, fast)[0].x() > 0.2);
  SoftSettings bad = pair;
  bad.thickness = -1;
  CHECK_THROWS_WITH_AS(add_soft(deep, bad), doctest::Contains("thickness"), std::invalid_argument);
  bad.thickness = 0;
  bad.air_drag = std::nan("");
  CHECK_THROWS_WITH_AS(add_soft(deep, bad), doctest::Contains("air drag"), std::invalid_argument);
}

TEST_CASE("a sheet that falls flat through still air goes by v tanh(g t / v), with v^2 = 2 w g / (rho C)") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    World world;
    world.add_force(Wind{.coefficient = 1, .density = 1.25});
    SoftSettings sheet = cloth({.columns = 6, .rows = 6, .material = {.density = 0.2}});
    sheet.solver = solver;
    sheet.air_drag = 1.2;
    sheet.sub_step = 1.0 / 960;
    const SoftId id = add_soft(world, sheet);
    const double end = std::sqrt(2 * 0.2 * 9.81 / (1.25 * 1.2));
    for (const double time : {0.1, 0.3, 1.0}) {
      step(world, time - world.time());
      CHECK(near(momentum_of(world, id).y() / 0.2, -end * std::tanh(9.81 * time / end), 0.01));
    }
  }
}

TEST_CASE("a wind blows a sheet along its normal alone and no faster than itself, as strong as it is") {
  for (const double strength : {0.0, 1.0, 1e6}) {
    World world({.gravity = {0, 0, 0}});
    world.add_force(Wind{.velocity = Vec3(30, 10, 0)}, {.strength = strength});
    SoftSettings sheet = cloth({.columns = 4, .rows = 4, .material = {.density = 0.2}});
    sheet.air_drag = 1;
    const SoftId id = add_soft(world, sheet);
    SoftSettings calm = sheet;
    calm.air_drag = 0;
    const SoftId still = add_soft(world, calm);
    step(world, 0.25);
    const Vec3 velocity = momentum_of(world, id) / 0.2;
    // dv/dt = k (10 - v)^2, k = rho C / (2 w): v = 10 - 10 / (1 + 10 k t)
    const double k = strength * 1.2041 / 0.4;
    CHECK(near(velocity, Vec3(0, 10 - 10 / (1 + 10 * k * 0.25), 0), 0.01));
    CHECK(momentum_of(world, still).norm() == 0);
  }
}

TEST_CASE("what tears tells its edge, when and where") {
  World world;
  // 1 kg on a rope that bears 5 N: it tears in the first steps, at the top where the load is largest.
  SoftSettings line =
      rope({.from = {0, 2, 0}, .to = {0, 1, 0}, .links = 10, .mass = 1, .stiffness = 500, .tear = 0.01});
  line.pins = {{.node = 0, .in_place = true}};
  const SoftId id = add_soft(world, line);
  std::vector<SoftTear> tears;
  for (int n = 0; n < 48; ++n) {
    const double before = world.time();
    world.step(1.0 / 240);
    for (const SoftTear& tear : soft_tears(world, id)) {
      CHECK(tear.time > before);
      CHECK(tear.time <= world.time() + 1e-15);
      CHECK(torn(world, id, tear.edge));
      tears.push_back(tear);
    }
  }
  REQUIRE(tears.size() >= 1);
  CHECK(tears[0].edge == 0);
  CHECK(near(tears[0].place, Vec3(0, 1.95, 0), 0.01));
  std::size_t count = 0;
  for (std::size_t i = 0; i < 10; ++i) count += torn(world, id, i) ? 1 : 0;
  CHECK(count == tears.size());
}

TEST_CASE("a thick, blown cloth goes on in the same bits after saving, and meets only those whom it shall") {
  World world;
  world.add_force(Wind{.velocity = Vec3(3, 0, 1)});
  world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId ball = world.add({.shape = {Sphere{0.2}}, .motion = {.pose = {.position = {0.5, 0.3, 0.5}}}});
  SoftSettings sheet = cloth({.corner = {0, 0.6, 0}, .columns = 8, .rows = 8});
  sheet.thickness = 0.1;
  sheet.air_drag = 1;
  const SoftId id = add_soft(world, sheet);
  step(world, 0.3);
  World copy = world, loaded;
  loaded.load(world.save());
  for (World* const one : {&world, &copy, &loaded}) step(*one, 0.3);
  CHECK(world.state_hash() == copy.state_hash());
  CHECK(world.state_hash() == loaded.state_hash());
  CHECK(soft_settings(loaded, id).thickness == 0.1);
  CHECK(world.contains(ball));
}

TEST_CASE("a body that sleeps wakes when a soft body falls on it, and what rests on that one too") {
  World world;
  world.add({.shape = {Plane{}}, .fixed = true});
  const auto box = [&](double height) {
    return world.add({.shape = {Box{Vec3(0.2, 0.1, 0.2)}}, .motion = {.pose = {.position = Vec3(0, height, 0)}}});
  };
  const BodyId lower = box(0.1), upper = box(0.3);
  step(world, 2);
  REQUIRE(world.asleep(lower));
  REQUIRE(world.asleep(upper));
  SoftSettings heavy = soft_box({.pose = {.position = Vec3(0.15, 0.75, 0)},
                                 .half_extents = {0.1, 0.1, 0.1},
                                 .cells = {2, 2, 2},
                                 .material = {.density = 2000}});
  add_soft(world, heavy);
  bool upper_woke = false, lower_woke = false;
  for (int n = 0; n < 120; ++n) {
    world.step(1.0 / 240);
    upper_woke = upper_woke || !world.asleep(upper);
    lower_woke = lower_woke || !world.asleep(lower);
  }
  CHECK(upper_woke);
  CHECK(lower_woke);
}
