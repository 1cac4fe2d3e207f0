#include <tweenfall/physics/detail.h>
#include <tweenfall/physics/stage/recording.h>
#include <tweenfall/physics/strategies.h>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Boxes on each other and a heavy one on top, dropped onto the ground.
StageDescription dropped_stack(ContactSolver solver) {
  StageDescription stage;
  stage.step = 1.0 / 60;
  stage.world.solver = solver;
  stage.world.separation = Parting::positional_impulse;
  stage.nodes.push_back({.name = "ground", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  for (int i = 0; i < 5; ++i)
    stage.nodes.push_back({.name = "box " + std::to_string(i),
                           .rest = {.position = Vec3(0.02 * i, 0.55 + 1.01 * i, 0)},
                           .body = BodyDescription{.shape = {Box{Vec3(0.5, 0.5, 0.5)}}, .mass = i < 4 ? 1.0 : 50.0}});
  return stage;
}

}  // namespace

TEST_CASE("a stage tells the greatest residual of complementarity of all its steps, where its solver has one") {
  CHECK(!Stage(dropped_stack(ContactSolver::iterative)).complementarity());
  Stage stage(dropped_stack(ContactSolver::lcp));
  CHECK(stage.complementarity() == 0.0);
  const Recording recording = record(stage, 2, 10);
  REQUIRE(recording.complementarity.size() == recording.times.size());
  for (std::size_t frame = 1; frame < recording.times.size(); ++frame)
    CHECK(recording.complementarity[frame] >= recording.complementarity[frame - 1]);
  CHECK(recording.complementarity.back() > 0);
  CHECK(recording.complementarity.back() < 1e-9);
  CHECK(record(stage, 2.1, 10).complementarity.front() == recording.complementarity.back());
  // By the world alone, step for step.
  World world({.solver = ContactSolver::lcp, .separation = Parting::positional_impulse});
  double most = 0, time = 0;
  const StageDescription described = dropped_stack(ContactSolver::lcp);
  for (const NodeDescription& node : described.nodes) {
    BodySettings body{.shape = node.body->shape, .mass = node.body->mass, .fixed = node.body->fixed};
    body.motion.pose = node.rest;
    world.add(body);
  }
  for (int n = 1; n <= 120; ++n) {
    world.step(n * described.step - time, described.step);
    time = n * described.step;
    most = std::max(most, complementarity_residual(world));
  }
  CHECK(recording.complementarity.back() == most);
}

TEST_CASE("the residual of complementarity goes back and on with its stage, and is saved with it") {
  const StageDescription described = dropped_stack(ContactSolver::lcp);
  Stage stage(described);
  stage.advance_to(0.05);
  CHECK(stage.complementarity() == 0.0);  // nothing touches yet
  stage.advance_to(0.5);
  const double some = *stage.complementarity();
  CHECK(some > 0);
  const std::vector<std::byte> saved = stage.save();
  stage.advance_to(1.5);
  const double all = *stage.complementarity();
  stage.seek(0.05);
  CHECK(stage.complementarity() == 0.0);
  stage.seek(1.5);
  CHECK(stage.complementarity() == all);
  Stage loaded(described);
  loaded.load(saved);
  CHECK(loaded.complementarity() == some);
  loaded.advance_to(1.5);
  CHECK(loaded.complementarity() == all);
}
