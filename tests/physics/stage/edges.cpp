#include "physics/handoff/scenes.h"

#include <stdexcept>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

BodyDescription ball(double mass, const Vec3& velocity = {0, 0, 0}) {
  return {.shape = {Sphere{0.1}}, .mass = mass, .friction = 0, .twist = {velocity, {0, 0, 0}}};
}

/// A ball flies at a keyed statue; `count` such pairs side by side.
StageDescription statues(int count) {
  StageDescription stage;
  stage.world.gravity = {0, 0, 0};
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    stage.nodes.push_back({.name = "statue" + number, .rest = {.position = {0, 0, 2.0 * i}}, .body = ball(5)});
    stage.nodes.back().body->drive = Drive::keyed();
    stage.nodes.push_back(
        {.name = "ball" + number, .rest = {.position = {-1, 0, 2.0 * i}}, .body = ball(0.5, {8, 0, 0})});
    stage.nodes.back().body->restitution = 0.3;
  }
  Rule rule;
  rule.bodies = {"statue*"};
  rule.when.triggers = {when::ContactHit{.impulse = 4}};
  stage.rules = {rule};
  return stage;
}

/// Something that slides along x at 1 m/s, 1 s long.
Clip sliding(const std::string& name, const std::string& node) {
  Clip clip;
  clip.name = name;
  clip.duration = 1;
  clip.tracks = {{node, "position",
                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::linear()},
                                     {.time = 1, .value = Vec3(1, 0, 0)}})}};
  return clip;
}

}  // namespace

TEST_CASE("bodies struck in the same step are all freed, and none of the momentum is lost") {
  constexpr int count = 12;
  Stage stage(statues(count));
  stage.advance_to(0.5);
  CHECK(stage.handoffs().size() == count);
  for (int i = 0; i < count; ++i) {
    const NodeId statue = stage.node("statue" + std::to_string(i)), struck = stage.node("ball" + std::to_string(i));
    CHECK(stage.owner(statue) == Owner::free);
    CHECK(near(5 * stage.twist(statue).linear + 0.5 * stage.twist(struck).linear, Vec3(4, 0, 0), 1e-9));
  }
}

TEST_CASE("a rule for all of several contacts waits for each of them") {
  StageDescription description = statues(1);
  description.nodes.push_back({.name = "other", .rest = {.position = {9, 0, 0}}, .body = ball(1)});
  description.rules[0].when.all = true;
  description.rules[0].when.triggers = {when::ContactHit{.with = "ball0"}, when::ContactHit{.with = "other"}};
  Stage stage(description);
  stage.advance_to(0.5);
  CHECK(stage.handoffs().empty());
}

TEST_CASE("taken back and let go at one instant, a body goes on as it was") {
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  description.nodes = {{.name = "body", .body = ball(1)}};
  description.clips = {sliding("slide", "body")};
  description.clips[0].tracks = {{"body", "position",
                                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::smooth()},
                                                     {.time = 0.4, .value = Vec3(0.5, 0.3, 0), .ease = Ease::smooth()},
                                                     {.time = 1, .value = Vec3(0, 0, 0)}})}};
  description.plays = {{.clip = 0}};
  HandBack back;
  back.clock = HandBack::Clock::restart;
  Stage stage(description);
  stage.advance_to(0.3);
  stage.release(0);
  stage.advance_to(0.55);
  const Vec3 place = stage.world(0).motion.pose.position, velocity = stage.twist(0).linear;
  stage.recover(0, back);
  stage.release(0);
  CHECK(near(stage.twist(0).linear, velocity, 1e-12));
  stage.advance_to(1.05);
  CHECK(near(stage.world(0).motion.pose.position, place + 0.5 * velocity, 1e-12));
}

TEST_CASE("events inside a long step are told in order, each when its time has come") {
  StageDescription description = statues(1);
  description.step = 0.2;
  description.rules.clear();
  Clip clip = sliding("slide", "statue0");
  clip.tracks.clear();
  for (const double time : {0.11, 0.13, 0.15})
    clip.events.push_back({.from = time, .to = time, .name = "tick", .data = {}});
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  Stage stage(description);
  double last = 0;
  int ticks = 0;
  const auto tell = [&](const StageEvent& event) {
    CHECK(event.time >= last);
    CHECK(stage.time() == event.time);
    last = event.time;
    if (event.name == "tick") ++ticks;
  };
  stage.on_event(tell);
  stage.on_contact([&](const StageEvent& event) { CHECK(event.time <= stage.time()); });
  stage.advance_to(0.12);
  CHECK(ticks == 1);
  stage.advance_to(1);
  CHECK(ticks == 3);
}

TEST_CASE("a weight that jumps throws nothing") {
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  description.nodes = {{.name = "wall", .body = BodyDescription{.shape = {Box{{0.1, 1, 1}}}, .mass = 1.0}},
                       {.name = "ball", .rest = {.position = {0.5, 0, 0}}, .body = ball(1)}};
  Clip near_by = sliding("near", "wall"), far_off = sliding("far", "wall");
  near_by.tracks[0].curve = Curve<Vec3>(Vec3(0, 0, 0));
  far_off.tracks[0].curve = Curve<Vec3>(Vec3(1, 0, 0));
  description.clips = {near_by, far_off};
  const auto weight =
      keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::hold()}, {.time = 0.502, .value = 1.0}});
  description.plays = {{.clip = 0}, {.clip = 1, .weight = weight}};
  Stage stage(description);
  stage.advance_to(1);
  CHECK(near(stage.world(0).motion.pose.position, Vec3(1, 0, 0), 1e-12));
  CHECK(stage.twist(1).linear.norm() < 1);
}

TEST_CASE("a play that is over and shows nothing gives its body back to what is below, and throws nothing") {
  for (const bool over_another : {false, true}) {
    StageDescription description;
    description.world.gravity = {0, 0, 0};
    description.nodes = {{.name = "wall", .rest = {.position = {3, 0, 0}}, .body = ball(5)},
                         {.name = "ball", .rest = {.position = {2.5, 0, 0}}, .body = ball(1)}};
    Clip still = sliding("still", "wall");
    still.tracks[0].curve = Curve<Vec3>(Vec3(4, 0, 0));
    description.clips = {still, sliding("slide", "wall")};
    if (over_another) description.plays = {{.clip = 0}};
    description.plays.push_back({.clip = 1, .at = 0.3017, .fill = Fill::none});
    Stage stage(description);
    const Vec3 below(over_another ? 4 : 3, 0, 0);
    stage.advance_to(0.3);
    CHECK(stage.world(0).motion.pose.position == below);
    stage.advance_to(0.8017);
    CHECK(near(stage.world(0).motion.pose.position, Vec3(0.5, 0, 0), 1e-12));
    CHECK(near(stage.twist(0).linear, Vec3(1, 0, 0), 1e-12));
    stage.advance_to(2);
    CHECK(stage.world(0).motion.pose.position == below);
    CHECK(stage.twist(0).linear == Vec3(0, 0, 0));
    CHECK(stage.world(1).motion.pose.position == Vec3(2.5, 0, 0));
    CHECK(stage.twist(1).linear == Vec3(0, 0, 0));
  }
}

TEST_CASE("at the end of a play that shows nothing after it, a body is let go with the play's own velocity") {
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  description.nodes = {{.name = "cart", .rest = {.position = {9, 0, 0}}, .body = ball(1)}};
  description.clips = {sliding("slide", "cart")};
  description.plays = {{.at = 0.2511, .fill = Fill::none}};
  Rule rule;
  rule.bodies = {"cart"};
  rule.when.triggers = {when::ClipEnd{}};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(2.2511);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(near(stage.handoffs()[0].time, 1.2511, 1e-12));
  CHECK(near(stage.world(0).motion.pose.position, Vec3(2, 0, 0), 1e-9));
  CHECK(near(stage.twist(0).linear, Vec3(1, 0, 0), 1e-12));
}

TEST_CASE("a clip that jumps onto its last key throws nothing that stands in between") {
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  description.nodes.push_back({.name = "lamp", .body = ball(5)});
  description.nodes.push_back({.name = "ball", .rest = {.position = {2.5, 0, 0}}, .body = ball(1)});
  Clip clip{.name = "held", .duration = 0.505};
  clip.tracks.push_back({"lamp", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = Vec3(2, 0, 0), .ease = Ease::hold()},
                                            {.time = 0.505, .value = Vec3(3, 0, 0)}})});
  description.clips = {clip};
  description.plays = {{}};
  Stage stage(description);
  stage.advance_to(1);
  CHECK(stage.world(stage.node("lamp")).motion.pose.position == Vec3(3, 0, 0));
  CHECK(stage.twist(stage.node("lamp")).linear == Vec3(0, 0, 0));
  CHECK(stage.world(stage.node("ball")).motion.pose.position == Vec3(2.5, 0, 0));
  CHECK(stage.twist(stage.node("ball")).linear == Vec3(0, 0, 0));
}

TEST_CASE("what is read before a caller's change does not know of it") {
  StageDescription description;
  description.step = 0.1;
  description.world.gravity = {0, 0, 0};
  description.nodes = {{.name = "a", .body = ball(1)}, {.name = "b", .rest = {.position = {0, 5, 0}}, .body = ball(1)}};
  Stage stage(description);
  stage.advance_to(0.05);
  stage.apply_impulse(0, {0, 3, 0}, {0, 0, 0});
  stage.remove(1);
  stage.seek(0.025);
  CHECK(stage.twist(0).linear.norm() == 0);
  CHECK(near(stage.world(1).motion.pose.position, Vec3(0, 5, 0), 1e-15));
  stage.seek(0.07);
  CHECK(near(stage.world(0).motion.pose.position, Vec3(0, 0.06, 0), 1e-12));
}

TEST_CASE("a callback may replace itself, and one that throws leaves the stage usable") {
  Stage stage(statues(1));
  int told = 0;
  stage.on_contact([&](const StageEvent&) {
    stage.on_contact({});
    ++told;
  });
  stage.on_handoff([](const HandOff&) { throw std::runtime_error("enough"); });
  CHECK_THROWS_WITH_AS(stage.advance_to(0.5), "enough", std::runtime_error);
  stage.advance_to(1);
  CHECK(told == 1);
}

TEST_CASE("a body's fault is told with its node's name") {
  StageDescription description = statues(1);
  description.nodes[0].body->shape.solid = Sphere{-1};
  CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("the body of \"statue0\": "), std::invalid_argument);
  description = statues(1);
  description.step = 1e-300;
  CHECK_THROWS_AS(Stage{description}, std::invalid_argument);
}
