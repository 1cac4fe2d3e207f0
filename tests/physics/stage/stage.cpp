#include "physics/handoff/scenes.h"

#include <tweenfall/physics/stage/recording.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A floor, a scripted ball that is let go, and a box that it may hit.
StageDescription playground(double step = 1.0 / 240) {
  StageDescription stage;
  stage.step = step;
  stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                 {.name = "ball",
                  .rest = {.position = {-1, 1, 0}},
                  .body = BodyDescription{.shape = {Sphere{0.2}}, .mass = 1.0, .restitution = 0.5}},
                 {.name = "box",
                  .rest = {.position = {1, 0.3, 0}},
                  .body = BodyDescription{.shape = {Box{{0.3, 0.3, 0.3}}}, .mass = 3.0}}};
  Clip clip;
  clip.name = "throw";
  clip.duration = 0.75;
  clip.tracks = {
      {"ball", "position",
       keyed_curve<Vec3>({{.time = 0, .value = Vec3(-1, 1, 0)},
                          {.time = 0.75,
                           .value = Vec3(0, 1.5, 0),
                           .in = Tangent<Vec3>{.kind = Tangent<Vec3>::Kind::given, .rate = Vec3(3, 0.5, 0)}}})}};
  clip.events = {{.from = 0, .to = 0, .name = "begin", .data = {}},
                 {.from = 0.5, .to = 0.5, .name = "now", .data = "{\"loud\": 1}"}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  Rule rule;
  rule.bodies = {"ball"};
  rule.when.triggers = {when::ClipEnd{}};
  stage.rules = {rule};
  return stage;
}

}  // namespace

TEST_CASE("any frame time gives the same simulation") {
  Stage whole(playground());
  whole.advance_to(2);
  for (const double frame : {1.0 / 17, 1.0 / 60, 1.0 / 1000, 0.7}) {
    Stage pieces(playground());
    while (pieces.time() < 2) pieces.advance_to(std::min(2.0, pieces.time() + frame));
    CHECK(pieces.state_hash() == whole.state_hash());
    CHECK(pieces.events().size() == whole.events().size());
  }
}

TEST_CASE("between two steps a falling body is on its parabola, and has its velocity") {
  StageDescription description;
  description.step = 1.0 / 30;
  description.nodes = {
      {.name = "stone",
       .rest = {.position = {0, 10, 0}},
       .body = BodyDescription{.shape = {Box{{0.1, 0.2, 0.3}}}, .mass = 1.0, .twist = {{1, 2, 3}, {0, 0, 0}}}}};
  Stage stage(description);
  for (const double time : {0.01, 0.0333, 0.05, 0.4567}) {
    stage.advance_to(time);
    const Vec3 expected(time, 10 + 2 * time - standard_gravity * time * time / 2, 3 * time);
    CHECK(near(stage.world(0).motion.pose.position, expected, 1e-12));
    CHECK(near(stage.twist(0).linear, Vec3(1, 2 - standard_gravity * time, 3), 1e-12));
  }
}

TEST_CASE("seeking back and forth gives the bits of running there from the start") {
  Stage straight(playground());
  straight.advance_to(1.3);
  Stage wandering(playground());
  for (const double time : {0.4, 2.0, 0.0, 0.9, 0.3, 1.3}) wandering.seek(time);
  CHECK(wandering.state_hash() == straight.state_hash());
  for (NodeId node = 0; node < 3; ++node)
    CHECK(wandering.world(node).motion.pose.position == straight.world(node).motion.pose.position);
  CHECK(wandering.handoffs().size() == straight.handoffs().size());
  CHECK(wandering.events().size() == straight.events().size());
}

TEST_CASE("what the caller does is done again when the stage is sought back") {
  Stage stage(playground());
  stage.advance_to(0.3);
  stage.release(stage.node("ball"));
  stage.advance_to(0.8);
  stage.apply_impulse(stage.node("box"), {0, 0, 2}, {1, 0.3, 0});
  stage.advance_to(1.5);
  const std::uint64_t hash = stage.state_hash();
  stage.seek(0.1);
  CHECK(stage.owner(stage.node("ball")) == Owner::keyed);
  stage.seek(1.5);
  CHECK(stage.state_hash() == hash);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].cause == Cause::caller);
}

TEST_CASE("events, contacts and hand-offs are told once, in order, at their own time") {
  Stage stage(playground());
  std::vector<std::string> told;
  double last = 0;
  const auto tell = [&](double time, const std::string& what) {
    CHECK(time == stage.time());
    CHECK(time >= last);
    last = time;
    told.push_back(what);
  };
  stage.on_event([&](const StageEvent& event) { tell(event.time, event.name + event.data); });
  stage.on_contact([&](const StageEvent& event) {
    CHECK(event.impulse > 0);
    CHECK(event.nodes.size() == 2);
    // They met a little earlier: the impulse of a contact is known at the end of the step.
    CHECK(event.time <= stage.time());
    CHECK(event.time >= stage.time() - 2 * stage.step());
    tell(stage.time(), "contact");
  });
  stage.on_handoff([&](const HandOff& handoff) { tell(handoff.time, "handoff"); });
  stage.advance(0.37);
  stage.advance(3);
  std::vector<std::string> without_contacts;
  std::ranges::copy_if(told, std::back_inserter(without_contacts), [](const auto& what) { return what != "contact"; });
  CHECK(without_contacts == std::vector<std::string>{"begin", "now{\"loud\": 1}", "handoff"});
  CHECK(std::ranges::count(told, "contact") >= 2);
}

TEST_CASE("a release from inside a callback acts at the event's time") {
  Stage stage(playground());
  stage.on_event([&](const StageEvent& event) {
    if (event.name == "now") stage.release(stage.node("ball"));
  });
  stage.advance(2);
  REQUIRE(!stage.handoffs().empty());
  CHECK(stage.handoffs()[0].time == 0.5);
  CHECK(stage.handoffs()[0].cause == Cause::caller);
  const Motion left = Stage(playground()).path(1).at(0.5, Side::in);
  CHECK(near(stage.handoffs()[0].after.twist.linear, left.twist.linear, 1e-12));
}

TEST_CASE("nodes and bodies come and go while it runs") {
  Stage stage(playground());
  stage.advance_to(0.501);
  const NodeId extra = stage.add(
      {.name = "extra", .rest = {.position = {0, 3, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 0.2}});
  CHECK(stage.owner(extra) == Owner::free);
  stage.advance_to(0.75);
  const double fallen = 0.75 - 0.501;
  CHECK(near(stage.world(extra).motion.pose.position, Vec3(0, 3 - standard_gravity * fallen * fallen / 2, 0), 1e-12));
  stage.remove(stage.node("box"));
  CHECK_THROWS_WITH_AS((void)stage.node("box"), "there is no node \"box\"", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)stage.node("bal"), "there is no node \"bal\"; did you mean \"ball\"?",
                       std::invalid_argument);
  stage.advance_to(1.5);
  const std::uint64_t hash = stage.state_hash();
  stage.seek(0.2);
  CHECK(stage.contains(stage.node("box")));
  stage.seek(1.5);
  CHECK(stage.state_hash() == hash);
  CHECK_FALSE(stage.contains(2));
  const NodeId again = stage.add({.name = "box", .rest = {.position = {0, 5, 0}}});
  CHECK(stage.node("box") == again);
}

TEST_CASE("a change that cannot be made changes nothing") {
  Stage stage(playground());
  stage.advance_to(0.4);
  const std::uint64_t hash = stage.state_hash();
  CHECK_THROWS_AS(stage.release(stage.node("floor")), std::invalid_argument);
  CHECK_THROWS_AS(stage.recover(stage.node("box"), {.clip = "nothing"}), std::invalid_argument);
  CHECK_THROWS_AS(stage.add({.name = "ball"}), std::invalid_argument);
  CHECK(stage.state_hash() == hash);
  CHECK(stage.nodes().size() == 3);
  stage.advance_to(1);
  CHECK(stage.handoffs().size() == 1);
}

TEST_CASE("a child of a released body follows it") {
  StageDescription description = playground();
  description.nodes.push_back({.name = "flag", .parent = 1, .rest = {.position = {0, 0.5, 0}}});
  Stage stage(description);
  stage.advance_to(1.4);
  const WorldMotion ball = stage.world(1), flag = stage.world(3);
  CHECK(near(flag.motion.pose.position, ball.point({0, 0.5, 0}), 1e-13));
  CHECK(near(flag.motion.twist.linear, ball.point_velocity({0, 0.5, 0}), 1e-12));
}

TEST_CASE("a struck statue is freed only by a blow that a free one would feel as hard") {
  // Scenario 10: 0.5 kg at 8 m/s into 5 kg at rest, e = 0.3: J = 4.7273 N s; against an infinite mass it would be 5.2.
  for (const double threshold : {4.0, 4.8}) {
    StageDescription description;
    description.world.gravity = {0, 0, 0};
    description.nodes = {
        {.name = "statue",
         .body =
             BodyDescription{
                 .shape = {Sphere{0.5}}, .mass = 5.0, .friction = 0, .restitution = 0.3, .drive = Drive::keyed()}},
        {.name = "ball",
         .rest = {.position = {-2, 0, 0}},
         .body = BodyDescription{
             .shape = {Sphere{0.1}}, .mass = 0.5, .friction = 0, .restitution = 0.3, .twist = {{8, 0, 0}, {0, 0, 0}}}}};
    Rule rule;
    rule.bodies = {"statue"};
    rule.when.triggers = {when::ContactHit{.impulse = threshold}};
    description.rules = {rule};
    Stage stage(description);
    stage.advance_to(1);
    if (threshold < 4.5) {
      REQUIRE(stage.handoffs().size() == 1);
      CHECK(stage.handoffs()[0].cause == Cause::contact);
      CHECK(near(stage.twist(1).linear, Vec3((0.5 - 0.3 * 5) / 5.5 * 8, 0, 0), 1e-6));
      CHECK(near(stage.twist(0).linear, Vec3(1.3 * 0.5 / 5.5 * 8, 0, 0), 1e-6));
      CHECK(near(5.0 * stage.twist(0).linear + 0.5 * stage.twist(1).linear, Vec3(4, 0, 0), 1e-9));
    } else {
      CHECK(stage.handoffs().empty());
      CHECK(near(stage.twist(1).linear, Vec3(-2.4, 0, 0), 1e-6));
      CHECK(near(stage.reaction(0), Vec3(5.2, 0, 0), 1e-6));
    }
  }
}

TEST_CASE("a body let go falls asleep and its script takes it back") {
  StageDescription description = pendulum(1.0 / 240);
  description.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  description.nodes[1].body->rolling_friction = 0.05;
  HandBack back;
  back.clip = "swing";
  back.clock = HandBack::Clock::restart;
  back.settle.seconds = 0.4;
  Rule recover;
  recover.bodies = {"bob"};
  recover.when.triggers = {when::Asleep{0.5}};
  recover.to = Drive::keyed();
  recover.hand_back = back;
  description.rules = {release_at(0.4937, "bob"), recover};
  Stage stage(description);
  stage.advance_to(10);
  REQUIRE(stage.handoffs().size() == 2);
  const HandOff& handoff = stage.handoffs()[1];
  CHECK(handoff.cause == Cause::asleep);
  CHECK(handoff.before.twist.linear.norm() < 0.05);
  CHECK(near(handoff.after.pose.position, handoff.before.pose.position, 1e-12));
  CHECK(near(handoff.after.twist.linear, handoff.before.twist.linear, 1e-9));
  CHECK(stage.owner(1) == Owner::keyed);
}

TEST_CASE("a jump of the script is not a blow: across a seam contacts use the rate") {
  // A keyed box slides at 1 m/s and jumps back each second; a ball in front of it must only ever be pushed at 1 m/s.
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  description.nodes = {{.name = "pusher", .body = BodyDescription{.shape = {Box{{0.1, 0.1, 0.1}}}, .mass = 1.0}},
                       {.name = "ball",
                        .rest = {.position = {0.05, 0, 0}},
                        .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .friction = 0}}};
  description.nodes[1].rest.position = {0.35, 0, 0};
  Clip clip;
  clip.name = "slide";
  clip.duration = 0.1;
  clip.loop = {LoopMode::repeat, 0};
  clip.tracks = {{"pusher", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::linear()},
                                     {.time = 0.1, .value = Vec3(0.1, 0, 0)}})}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  Stage stage(description);
  stage.advance_to(3);
  CHECK(stage.twist(1).linear.norm() < 1e-12);  // never reached
  description.nodes[1].rest.position = {0.25, 0, 0};
  Stage pushed(description);
  pushed.advance_to(3);
  CHECK(pushed.twist(1).linear.x() == doctest::Approx(1.0).epsilon(1e-6));
}

TEST_CASE("a recording has every frame, the end included") {
  Stage stage(playground());
  const Recording recording = record(stage, 1.01, 50);
  CHECK(recording.times.size() == 52);
  CHECK(recording.times[1] == 1 / 50.0);
  CHECK(recording.times.back() == 1.01);
  for (const NodeRecord& node : recording.nodes) {
    CHECK(node.world.size() == recording.times.size());
    CHECK(node.owner.size() == recording.times.size());
  }
  CHECK(recording.nodes[1].owner.front() == Owner::keyed);
  CHECK(recording.nodes[1].owner.back() == Owner::free);
}
