#include <tweenfall/physics/stage/recording.h>

#include "support.h"

#include <cmath>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double earths_pull = 9.81;

/// A mass of 0.5 kg on a spring of 1 m and 200 N/m, let go stretched by 0.1 m.
StageDescription hanging_spring(SoftSolver solver, double sub_step) {
  SoftSettings spring;
  spring.positions = {Vec3(0, 0, 0), Vec3(0, -1.1, 0)};
  spring.masses = {0.5, 0.5};
  spring.edges = {{.a = 0, .b = 1, .length = 1.0, .stiffness = 200}};
  spring.solver = solver;
  spring.sub_step = sub_step;
  StageDescription stage;
  stage.step = 1.0 / 240;
  stage.softs.push_back({.name = "spring", .soft = spring, .pins = {{.node = 0}}});
  return stage;
}

/// One particle of 2 g leaves at 0.1 s, upward at 3 m/s from 5 m above the origin.
StageDescription one_particle() {
  StageDescription stage;
  stage.step = 1.0 / 240;
  ParticlesDescription spark{.name = "spark", .settings = {.mass = 2e-3}};
  spark.emitters.push_back(
      {.position = Vec3(0, 5, 0), .rate = Curve<double>(10.0), .speed = Curve<double>(3.0), .end = 0.15});
  stage.particles.push_back(std::move(spark));
  return stage;
}

}  // namespace

// A method that turns x' = i w x by 1 / (1 - i h w) in a step, as backward Euler does, divides the energy of a swing by
// 1 + h^2 w^2; positions corrected by one linear constraint are the same method.
TEST_CASE("the energy of a mass that swings on a soft spring is that of the swing, less what backward Euler takes") {
  for (const SoftSolver solver : {SoftSolver::springs, SoftSolver::positions})
    for (const double sub_step : {1.0 / 240, 1.0 / 2400}) {
      CAPTURE(static_cast<int>(solver));
      CAPTURE(sub_step);
      Stage stage(hanging_spring(solver, sub_step));
      const double mass = 0.5, stiffness = 200, square = stiffness / mass, hung = mass * earths_pull / stiffness;
      const double at_rest = -mass * earths_pull * (1 + hung) + 0.5 * stiffness * hung * hung;
      const double swing = 0.5 * stiffness * (0.1 - hung) * (0.1 - hung);
      const Recording recording = record(stage, 1, 60);
      for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
        const double sub_steps = recording.times[frame] / sub_step;
        const double left = swing * std::pow(1 + sub_step * sub_step * square, -sub_steps);
        REQUIRE(recording.energy[frame].softs.size() == 1);
        CHECK(near(recording.energy[frame].total(), at_rest + left, 1e-9));
        CHECK(recording.energy[frame].kinetic == 0);
      }
      const SoftEnergy &first = recording.energy.front().softs[0], &last = recording.energy.back().softs[0];
      CHECK(near(first.elastic, 0.5 * stiffness * 0.01, 1e-12));
      CHECK(near(first.weight, -mass * earths_pull * 1.1, 1e-12));
      CHECK(first.kinetic == 0);
      CHECK(last.kinetic > 0);
    }
}

TEST_CASE("a particle that flies has exactly the energy with which it left, between steps too") {
  Stage stage(one_particle());
  const double mass = 2e-3, total = mass * (earths_pull * 5 + 0.5 * 9);
  stage.advance_to(0.15);
  std::size_t flying = stage.particles("spark").numbers.size();
  REQUIRE(flying == 1);
  const double left_at = 0.1;
  for (const double time : {0.2, 0.31, 0.5123, 1.0, 1.5}) {
    CAPTURE(time);
    stage.advance_to(time);
    const StageEnergy energy = stage.energy();
    REQUIRE(energy.particles.size() == 1);
    CHECK(near(energy.total(), total, 1e-12 * total));
  }
  // At the end of a step, each part by itself.
  const double flown = 1.5 - left_at, speed = 3 - earths_pull * flown;
  CHECK(near(stage.energy().particles[0].kinetic, 0.5 * mass * speed * speed, 1e-12));
  CHECK(near(stage.energy().particles[0].weight,
             mass * earths_pull * (5 + 3 * flown - 0.5 * earths_pull * flown * flown), 1e-12));
}

TEST_CASE("the total is the sum of what bodies, forces, soft bodies and particles have") {
  StageDescription both = hanging_spring(SoftSolver::springs, 1.0 / 240);
  both.particles = one_particle().particles;
  both.nodes.push_back(
      {.name = "ball",
       .rest = {.position = Vec3(3, 2, 0)},
       .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 4.0, .twist = {.linear = Vec3(1, 2, 0)}}});
  both.forces = {{.force = Spring{.a = {}, .rest_length = 1, .stiffness = 50}, .a = 0}, {.force = Drag{.linear = 0}}};
  Stage stage(both), alone(hanging_spring(SoftSolver::springs, 1.0 / 240));
  for (Stage* one : {&stage, &alone}) one->advance_to(0.5);
  const StageEnergy energy = stage.energy();
  REQUIRE(energy.forces.size() == 2);
  REQUIRE(energy.forces[0].has_value());
  CHECK(!energy.forces[1]);
  CHECK(energy.kinetic > 0);
  CHECK(energy.softs[0].kinetic == alone.energy().softs[0].kinetic);
  CHECK(near(energy.total(),
             energy.kinetic + energy.weight + *energy.forces[0] + alone.energy().total() + energy.particles[0].kinetic +
                 energy.particles[0].weight,
             1e-12));
}
