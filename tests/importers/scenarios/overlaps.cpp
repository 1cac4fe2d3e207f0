#include "importers/scenarios/scenario_stages.h"

#include <algorithm>
#include <cmath>

// The scenarios of the hand-off in which bodies are pressed into each other, each with the bound that it states.

namespace tweenfall::overlap_scenarios {

using namespace tweenfall::scenarios;
using namespace tweenfall::test;

namespace {

StageDescription press(const std::string& drive) {
  return described(
      floor_node +
          R"(, "press": {"position": [0, 1.1, 0], "body": {"shape": {"box": {"size": [1, 0.2, 1]}}, "mass": 10)" +
          drive + R"(}},
         "cube": {"position": [0, 0.25, 0], "body": {"shape": {"box": {"size": [0.5, 0.5, 0.5]}}, "mass": 20}})",
      R"("stroke": {"tracks": {"press.position": [[0, [0, 1.1, 0], "linear"], [1, [0, 0.4, 0], "hold"],
                                                               [3, [0, 0.4, 0], "linear"], [4, [0, 1.1, 0]]]}})",
      R"("world": {"sleep_after": "never"}, "handoff": [{"body": "press", "when": {"saturated": 0.02}, "to": {"hz": 10, "max_force": 500.000001}}])");
}

}  // namespace

TEST_CASE("scenario 15: a keyed press keeps to its path, tells the overlap, and its ledger the reaction") {
  StageDescription stage = press("");
  stage.rules.clear();
  Stage run(stage);
  run.advance_to(2);
  CHECK(place(run, "press").y() == 0.4);
  CHECK(count_of(run, "overlap") >= 1);
  CHECK(run.reaction(run.node("press")).y() > 100);
  CHECK(place(run, "cube").allFinite());
  const Vec3 press_impulse = run.reaction(run.node("press")), floor_impulse = run.reaction(run.node("floor"));
  run.advance_to(2.5);
  // The floor takes what the press takes, plus the cube's weight.
  const double up = (run.reaction(run.node("press")) - press_impulse).y();
  const double down = (run.reaction(run.node("floor")) - floor_impulse).y();
  CHECK(std::abs(up + down + 0.5 * 20 * g) < 1e-6 * up);
  run.advance_to(5);
  MESSAGE("after the press has gone the cube moves at " << velocity(run, "cube").norm() << " m/s");
  CHECK(velocity(run, "cube").norm() < 0.15);
}

TEST_CASE("scenario 15: a driven press of 500 N stops, says that it is saturated, and lets the cube go gently") {
  Stage run(press(R"(, "drive": {"hz": 10, "max_force": 500})"));
  const NodeId cube = run.node("cube"), floor = run.node("floor");
  double touched = 0, fastest = 0;
  run.on_contact([&](const StageEvent& event) {
    if (touched == 0 && std::ranges::find(event.nodes, run.node("press")) != event.nodes.end()) touched = event.time;
  });
  run.advance_to(2);
  REQUIRE(run.handoffs().size() == 1);
  CHECK(run.handoffs()[0].cause == Cause::saturated);
  const Vec3 before = run.reaction(floor);
  run.advance_to(2.5);
  const double force = -(run.reaction(floor) - before).y() / 0.5;
  const double overlap = 0.5 - (place(run, "press").y() - 0.1);
  MESSAGE("touched at " << touched << " s, saturated at " << run.handoffs()[0].time << " s; " << force
                        << " N on the floor, " << 1e3 * overlap << " mm of overlap");
  CHECK(run.handoffs()[0].time - touched <= 0.1);
  CHECK(overlap <= 5e-3);
  CHECK(force == doctest::Approx(500 + 30 * g).epsilon(0.02));
  while (run.time() < 5) {
    run.advance(run.step());
    fastest = std::max(fastest, run.twist(cube).linear.norm());
  }
  MESSAGE("on retract the cube moves at " << fastest << " m/s at most");
  CHECK(fastest <= 0.1);
}

namespace {

/// A cube that a clip moves into the floor at 0.5 m/s, `depth` deep by 2 s, when it is let go.
StageDescription sunk(double depth, const std::string& policy) {
  const double from = 0.25 - depth + 0.5;
  return described(floor_node + ", \"cube\": {\"position\": [0, " + in_text(from) +
                       R"(, 0], "body": {"shape": {"box": {"size": [0.5, 0.5, 0.5]}}, "mass": 10}},
         "shelf": {"position": [0, -3, 0], "body": {"shape": {"box": {"size": [4, 0.2, 4]}}, "static": true}})",
                   "\"sink\": {\"tracks\": {\"cube.position\": [[0, [0, " + in_text(from) +
                       ", 0], \"hold\"], [1, [0, " + in_text(from) + ", 0], \"linear\"], [2, [0, " +
                       in_text(0.25 - depth) + ", 0]]]}}",
                   R"("handoff": [{"body": "cube", "when": {"at": 2}, "to": "free", "velocity": "zero", "overlap": ")" +
                       policy + "\"}]");
}

}  // namespace

TEST_CASE("scenario 21: what is let go in the floor is pushed out at 0.5 m/s at most, and gains no energy by it") {
  for (const double depth : {0.005, 0.05, 0.2}) {
    CAPTURE(depth);
    Stage run(sunk(depth, "push"));
    run.advance_to(2);
    double highest = 0, fastest = 0, energy = 0;
    while (run.time() < 5) {
      const double before = place(run, "cube").y();
      run.advance(run.step());
      highest = std::max(highest, place(run, "cube").y() - 0.25);
      fastest = std::max(fastest, (place(run, "cube").y() - before) / run.step());
      energy = std::max(energy, 5 * velocity(run, "cube").squaredNorm());
    }
    MESSAGE("from " << 1e3 * depth << " mm deep it rises at " << fastest << " m/s, " << 1e3 * highest
                    << " mm too high, " << energy / (10 * g * depth) << " of m g p");
    CHECK(fastest <= 0.5 * (1 + 1e-9));
    CHECK(highest <= 1e-3);
    CHECK(energy <= 10 * g * depth);
    CHECK(std::abs(place(run, "cube").y() - 0.25) < 1e-3);
  }
}

TEST_CASE("scenario 21: what ignores its overlap falls freely through the floor, and through nothing else") {
  for (const double depth : {0.005, 0.05, 0.2}) {
    Stage run(sunk(depth, "ignore"));
    run.advance_to(2.5);
    CHECK(std::abs(place(run, "cube").y() - (0.25 - depth - g / 2 * 0.25)) < 1e-9);
    run.advance_to(5);
    // The plane has no other side: all the way down it is inside. The shelf below holds it.
    CHECK(std::abs(place(run, "cube").y() + 2.65) < 1e-3);
  }
  // Once out of a body with two sides, it meets it again.
  StageDescription through = sunk(0.05, "ignore");
  through.nodes[0].rest.position = Vec3(0, -0.5, 0);
  through.nodes[0].body->shape = {Box{{2, 0.5, 2}}};
  Stage run(through);
  run.advance_to(2.1);
  CHECK_FALSE(run.collides(run.node("cube"), run.node("floor")));
  run.advance_to(3);
  CHECK(run.collides(run.node("cube"), run.node("floor")));
  CHECK(place(run, "cube").y() < -1.24);
}

TEST_CASE("scenario 21: what is rewound leaves from where its path was last clear, within 1e-6 s") {
  for (const double depth : {0.005, 0.05, 0.2}) {
    CAPTURE(depth);
    StageDescription stage = sunk(depth, "rewind");
    stage.rules[0].take_over.velocity = TakeOver::Velocity::curve;
    Stage run(stage);
    run.advance_to(2);
    REQUIRE(run.handoffs().size() == 1);
    // At 0.5 m/s, 1e-6 s are 0.5 micrometers.
    CHECK(std::abs(run.handoffs()[0].after.pose.position.y() - 0.25) < 0.5e-6);
    CHECK(run.handoffs()[0].after.twist.linear.y() == doctest::Approx(-0.5));
    CHECK(run.handoffs()[0].before.pose.position.y() == doctest::Approx(0.25 - depth));
    run.advance_to(4);
    CHECK(std::abs(place(run, "cube").y() - 0.25) < 1e-3);
  }
}

TEST_CASE("scenario 21: what is vetoed stays keyed, tells so at each step, and leaves once it is clear") {
  StageDescription stage = sunk(0.05, "veto");
  Stage run(stage);
  run.advance_to(2.5);
  CHECK(run.handoffs().empty());
  CHECK(run.owner(run.node("cube")) == Owner::keyed);
  CHECK(count_of(run, "vetoed") == 1 + 120);
  run.remove(run.node("floor"));
  run.advance(2 * run.step());
  REQUIRE(run.handoffs().size() == 1);
  CHECK(run.handoffs()[0].cause == Cause::at);
  CHECK(run.owner(run.node("cube")) == Owner::free);
}

}  // namespace tweenfall::overlap_scenarios
