// Graphs on a stage that get inputs while it runs.

#include "support.h"

#include <tweenfall/anim/graph_player.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/recording.h>
#include <tweenfall/physics/stage/stage.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Kind = GraphCondition::Kind;

/// A ball that rests, is carried along x at `speed` (half of 2 m/s at 0.5), or hops up once: with an event where the
/// hop ends. Another lies in its way.
StageDescription led() {
  StageDescription stage;
  stage.nodes = {{.name = "ball", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}},
                 {.name = "other",
                  .rest = {.position = {0.5, 0, 0}},
                  .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}},
                 {.name = "floor",
                  .rest = {.position = {0, -0.1, 0}},
                  .body = BodyDescription{.shape = {Plane{}}, .fixed = true}}};
  Clip go{.name = "go", .duration = 4}, hop{.name = "hop", .duration = 0.5},
      beat{.name = "beat", .duration = 1, .loop = {LoopMode::repeat}};
  go.tracks = {
      {"ball", "position",
       keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::linear()}, {.time = 4, .value = {8, 0, 0}}})}};
  hop.tracks = {{"ball", "position",
                 keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::smooth()},
                                    {.time = 0.25, .value = {0, 1, 0}, .ease = Ease::smooth()},
                                    {.time = 0.5, .value = {0, 0, 0}}})}};
  hop.events = {{.from = 0, .to = 0, .name = "off", .data = {}}, {.from = 0.25, .to = 0.25, .name = "top", .data = {}}};
  beat.events = {{.from = 0.4, .to = 0.4, .name = "beat", .data = {}}};
  stage.clips = {go, hop, beat};
  stage.plays = {{.clip = 2}};
  stage.graphs = {
      {.name = "figure",
       .parameters = {{.name = "speed", .half_life = 0.05}, {.name = "armed"}, {.name = "beats"}},
       .poses = {{"stand", RestPose{}},
                 {"move", BlendPose{{{"stand", 0.0001}, {"go", ByParameter{"speed"}}}}},
                 {"body", MachinePose{.start = "move",
                                      .states = {{"move", "move"}, {"hop", "hop"}},
                                      .transitions = {{.from = {"move"},
                                                       .to = "hop",
                                                       .when = {{Kind::event, "jump"}, {Kind::equals, "armed", 1}},
                                                       .change = {GraphChange::Kind::quintic, 0.1}},
                                                      {.from = {"hop"}, .to = "move", .when = {{Kind::clip_end}}}}}}},
       .reactions = {{"beat", "beats", 1}}}};
  return stage;
}

struct Told {
  double time;
  const char* name;
  std::optional<double> value{};
};
const std::vector<Told> script{
    {0.1037, "speed", 0.5}, {0.3, "armed", 1}, {0.4119, "jump"}, {0.4119, "speed", 0.1}, {1.2, "speed", 0}};

Stage run_with(double frame, double until) {
  Stage stage(led());
  std::size_t next = 0;
  for (double at = 0; at < until;) {
    at = std::min(at + frame, until);
    for (; next < script.size() && script[next].time <= at; ++next) {
      stage.advance_to(script[next].time);
      if (script[next].value)
        stage.set("figure", script[next].name, *script[next].value);
      else
        stage.send("figure", script[next].name);
    }
    stage.advance_to(at);
  }
  return stage;
}

}  // namespace

TEST_CASE("a parameter set on a running stage takes effect at its instant, with exact rates") {
  Stage stage(led());
  stage.advance_to(0.2);
  CHECK(stage.world(0).motion.pose.position.norm() == 0);
  stage.set("figure", "speed", 1);
  CHECK(stage.world(0).motion.pose.position.norm() == 0);
  stage.advance_to(0.25);
  const GraphPlayer player = stage.graph("figure");
  const double weight = player.parameter("speed").value, share = weight / (weight + 0.0001);
  CHECK(near(stage.world(0).motion.pose.position.x(), 0.5 * share, 1e-12));
  stage.seek(0.19);
  CHECK(stage.world(0).motion.pose.position.norm() == 0);
  stage.seek(0.25);
  CHECK(near(stage.world(0).motion.pose.position.x(), 0.5 * share, 1e-12));
}

TEST_CASE("a graph that is told something runs to the same bits whatever the frames, back and again, and from a log") {
  Stage coarse = run_with(0.5, 3), fine = run_with(0.0123, 3);
  CHECK(coarse.state_hash() == fine.state_hash());
  CHECK(coarse.graph("figure").hash() == fine.graph("figure").hash());
  CHECK(coarse.graph("figure").passages(0).size() == 3);
  CHECK(coarse.events().size() == fine.events().size());
  const std::uint64_t hash = coarse.state_hash();
  coarse.seek(0.35);
  CHECK(coarse.inputs().size() == 2);
  coarse.seek(3);
  CHECK(coarse.state_hash() == hash);
  Stage again(led());
  for (const TimedInput& input : coarse.inputs()) {
    again.advance_to(input.time);
    again.give(input.what);
  }
  again.advance_to(3);
  CHECK(again.state_hash() == hash);
  REQUIRE(again.inputs().size() == script.size());
  CHECK(std::get<input::Set>(again.inputs()[0].what).parameter == "speed");
  CHECK(std::get<input::Send>(again.inputs()[2].what).event == "jump");
}

TEST_CASE("a stage that was saved between inputs to its graphs goes on to the same bits") {
  for (const double at : {0.05, 0.1037, 0.35, 0.4119, 0.47, 1.7}) {
    CAPTURE(at);
    Stage stage = run_with(0.1, at), loaded(led());
    loaded.load(stage.save());
    CHECK(loaded.inputs().size() == stage.inputs().size());
    for (Stage* each : {&stage, &loaded}) {
      each->set("figure", "speed", 0.9);
      each->advance_to(at + 1.1);
    }
    CHECK(loaded.state_hash() == stage.state_hash());
    CHECK(loaded.graph("figure").hash() == stage.graph("figure").hash());
  }
}

TEST_CASE("a stage is loaded although a rule waits for an event, and a graph or a play was told something") {
  StageDescription stage = led();
  stage.rules = {{.bodies = {"other"}, .when = {{when::Event{"top"}}}, .to = {.hz = 5}}};
  Stage first(stage), second(stage);
  first.advance(0.21);
  first.set("figure", "armed", 1);
  first.ask("beat", playing::SetSpeed{.speed = {{0, 2}}});
  first.send("figure", "jump");
  first.advance(0.1);
  second.load(first.save());
  for (Stage* each : {&first, &second}) each->advance(0.5);
  CHECK(second.state_hash() == first.state_hash());
  CHECK(first.drive(first.node("other")).hz == 5);
}

TEST_CASE("an event with which what was sent begins is told once, and rules wait for it") {
  StageDescription described = led();
  described.rules = {{.bodies = {"ball"}, .when = {.triggers = {when::Event{"off"}}}, .to = Drive::free()}};
  Stage stage(described);
  stage.advance_to(0.3);
  stage.set("figure", "armed", 1);
  stage.advance_to(0.41190001);
  stage.send("figure", "jump");
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].time == 0.41190001);
  stage.advance_to(2);
  std::size_t off = 0;
  for (const StageEvent& event : stage.events()) off += event.name == "off";
  CHECK(off == 1);
}

TEST_CASE("events of plays set parameters of graphs on the stage, and what was set survives a change of plays") {
  Stage stage(led());
  stage.advance_to(0.1);
  stage.set("figure", "speed", 0.25);
  stage.advance_to(0.3);
  stage.ask("beat", playing::SetSpeed{.speed = {{0, 2}}});
  CHECK(stage.graph("figure").parameter("beats").value == 0);
  stage.advance_to(0.36);
  CHECK(stage.graph("figure").parameter("beats").value == 1);
  CHECK(stage.graph("figure").own_inputs().size() == 1);
  CHECK(stage.inputs().size() == 2);
  CHECK(near(stage.graph("figure").parameter("speed").value, 0.25, 0.01));
  stage.add({.name = "late"});
  stage.advance_to(0.4);
  CHECK(stage.graph("figure").own_inputs().size() == 1);
}

TEST_CASE("what a graph is not told of is refused with the nearest name, and changes nothing") {
  Stage stage = run_with(0.1, 0.2);
  const std::uint64_t before = stage.state_hash();
  CHECK_THROWS_WITH_AS(stage.set("figrue", "speed", 1), "there is no graph \"figrue\"; did you mean \"figure\"?",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(stage.set("figure", "sped", 1), "there is no parameter \"sped\"; did you mean \"speed\"?",
                       std::invalid_argument);
  CHECK_THROWS_AS(stage.set("figure", "speed", std::nan("")), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(stage.graph("")), std::invalid_argument);
  CHECK(stage.state_hash() == before);
  CHECK(stage.inputs().size() == 1);
  Stage none(StageDescription{});
  CHECK_THROWS_AS(none.set("figure", "speed", 1), std::invalid_argument);
}

TEST_CASE("a body that a graph leads over the seam of a loop is not thrown by it") {
  StageDescription described = led();
  described.clips[0].loop = {LoopMode::repeat};
  described.nodes.resize(1);
  described.graphs = {{.name = "figure", .poses = {{"round", ClipPose{"go"}}}}};
  described.rules = {{.bodies = {"ball"}, .when = {.triggers = {when::At{4.001}}}, .to = Drive::free()}};
  described.step = 0.01;
  Stage stage(described);
  stage.advance_to(4.002);
  CHECK(near(stage.world(0).motion.pose.position.x(), 2 * 0.002, 1e-9));
  CHECK(near(stage.twist(0).linear.x(), 2, 1e-9));
  // A rider feels the world's velocity of it: the push on another body is that of 2 m/s, not of 8 m in a step.
  StageDescription pushing = led();
  pushing.clips[0].loop = {LoopMode::repeat};
  pushing.nodes[1].rest.position = {0.21, 0, 0};
  pushing.graphs = {{.name = "figure", .poses = {{"round", ClipPose{.clip = "go", .at = -3.995}}}}};
  pushing.step = 0.01;
  Stage pushed(pushing);
  pushed.advance_to(0.2);
  CHECK(pushed.twist(1).linear.x() < 4.1);
}

TEST_CASE("nodes that come while a graph plays stay where they are put, whatever it is told, and are found again") {
  Stage stage(led());
  stage.advance(0.2);
  std::vector<NodeId> late;
  for (int i = 0; i < 40; ++i)
    late.push_back(stage.add({.name = "late" + std::to_string(i), .rest = {.position = {0, 1.0 + i, 3}}}));
  for (int i = 0; i < 10; ++i) {
    stage.set("figure", "speed", 0.1 * i);
    stage.ask("beat", playing::SetSpeed{.speed = {{0, 1 + 0.1 * i}}});
    stage.advance(0.05);
    for (std::size_t k = 0; k < late.size(); ++k)
      CHECK(stage.world(late[k]).motion.pose.position == Vec3(0, 1.0 + static_cast<double>(k), 3));
  }
  const std::uint64_t hash = stage.state_hash();
  const double time = stage.time();
  stage.seek(0.1);
  stage.seek(time);
  CHECK(stage.state_hash() == hash);
  CHECK(stage.world(late[39]).motion.pose.position == Vec3(0, 40, 3));
}
