#include "physics/handoff/scenes.h"
#include "processor_time.h"

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <stdexcept>
#include <utility>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

StageDescription falling_ball() {
  StageDescription stage;
  stage.nodes = {
      {.name = "ball", .rest = {.position = {0, 1, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
  return stage;
}

}  // namespace

TEST_CASE("a stage that was moved from says so") {
  Stage first(falling_ball());
  const Stage second(std::move(first));
  CHECK_THROWS_AS(first.advance(1), std::logic_error);
  CHECK_THROWS_AS(first.release(0), std::logic_error);
  CHECK_THROWS_AS((void)first.world(0), std::logic_error);
  CHECK(first.time() == 0);
  CHECK(first.nodes().empty());
  CHECK_FALSE(first.contains(0));
  CHECK(second.contains(0));
  first = Stage(falling_ball());
  first.advance(0.1);
}

TEST_CASE("a callback may destroy the stage that calls it") {
  StageDescription description = falling_ball();
  description.rules = {release_at(0.1, "ball"), recover_at(0.05, "ball")};
  std::optional<Stage> stage(std::in_place, description);
  int told = 0;
  stage->on_handoff([&](const HandOff&) {
    ++told;
    stage.reset();
  });
  stage->advance(1);
  CHECK(told == 1);
}

TEST_CASE("what would never end is refused") {
  Stage stage(falling_ball());
  CHECK_THROWS_AS(stage.advance(1e9), std::invalid_argument);
  CHECK_THROWS_AS(stage.seek(1e300), std::invalid_argument);
  CHECK_THROWS_AS(stage.advance_to(1e300), std::invalid_argument);
  CHECK_THROWS_AS((void)record(stage, 1e8, 0.001), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)record(stage, 4e4, 1e5), doctest::Contains("MiB"), std::invalid_argument);
  CHECK(stage.time() == 0);
}

TEST_CASE("a stage refuses the clip that would have too many events in a step, before a step is taken") {
  StageDescription description = falling_ball();
  description.clips = {{.name = "buzz", .duration = 1e-9, .loop = {LoopMode::repeat, 0}}};
  description.clips[0].events = {{.from = 5e-10, .to = 5e-10, .name = "tick", .data = {}}};
  description.plays = {{.clip = 0, .at = 100}};
  CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("clip \"buzz\" goes around every 1e-09 s"),
                       std::invalid_argument);
  description.step = 1e-6;
  CHECK_NOTHROW(Stage{description});
}

TEST_CASE("poses that are none, and times that are none, are refused") {
  for (const Pose& rest : {Pose{.position = {std::nan(""), 0, 0}}, Pose{.rotation = Quat(0, 0, 0, 0)},
                           Pose{.scale = {1, std::numeric_limits<double>::infinity(), 1}}}) {
    StageDescription description = falling_ball();
    description.nodes.push_back({.name = "bad", .rest = rest});
    CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("\"bad\""), std::invalid_argument);
    Stage stage(falling_ball());
    CHECK_THROWS_AS((void)stage.add({.name = "bad", .rest = rest}), std::invalid_argument);
    CHECK(stage.nodes().size() == 1);
  }
  StageDescription description = falling_ball();
  description.rules = {release_at(std::nan(""), "ball")};
  CHECK_THROWS_AS(Stage{description}, std::invalid_argument);
}

TEST_CASE(
    "a node so far away that what turns it would make it faster than any number is refused, and nearer has a "
    "velocity") {
  StageDescription description = falling_ball();
  description.nodes[0].body->twist.angular = Vec3(2000, -2000, 40);
  Stage stage(description);
  for (const Pose& rest :
       {Pose{.position = {1, -1e308, 1}}, Pose{.position = {0, 1e31, 0}}, Pose{.scale = {1, 1e300, 1}}}) {
    const NodeDescription far{.name = "far", .parent = 0, .rest = rest};
    CHECK_THROWS_WITH_AS((void)stage.add(far), doctest::Contains("\"far\" needs numbers of at most 1e30"),
                         std::invalid_argument);
    StageDescription with = description;
    with.nodes.push_back(far);
    CHECK_THROWS_WITH_AS(Stage{with}, doctest::Contains("\"far\" needs numbers of at most 1e30"),
                         std::invalid_argument);
  }
  const NodeId near = stage.add({.name = "near", .parent = 0, .rest = {.position = {1, -1e30, 1}}});
  stage.advance(0.05);
  CHECK(stage.twist(near).linear.allFinite());
}

TEST_CASE("a play asked for a loop of too many events is refused at once, and goes on as it was") {
  StageDescription description = falling_ball();
  Clip clip{.name = "beat", .duration = 1, .loop = {LoopMode::repeat, 0}};
  clip.events = {{.from = 0, .to = 0, .name = "tick"}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  Stage stage(description);
  stage.advance(0.3);
  CHECK_THROWS_WITH_AS(stage.ask("beat", playing::Start{.clip = "beat", .to = 1e-300}),
                       doctest::Contains("more than 20000 events"), std::invalid_argument);
  stage.advance(1);
  CHECK(stage.events().size() == 2);
}

TEST_CASE(
    "tens of thousands of events in one step take a time that grows with their number, whatever is called among them") {
  StageDescription description = falling_ball();
  description.step = 1.0 / 60;
  Clip buzz{.name = "buzz", .duration = 1.7e-6, .loop = {LoopMode::repeat, 0}}, score{.name = "score", .duration = 1};
  buzz.events = {{.from = 0, .to = 0, .name = "a name that is too long to be kept within a string"}};
  for (int i = 1; i <= 20'000; ++i) score.events.push_back({.from = i / 40e3, .to = i / 40e3, .name = "note"});
  description.clips = {buzz, score};
  description.plays = {{.clip = 0}, {.clip = 1, .at = 10}};
  Stage stage(description);
  stage.advance_to(1.7 / 60);
  const std::size_t before = stage.events().size();
  CHECK(before > 15'000);
  const double begin = test::processor_seconds();
  stage.apply_impulse(0, Vec3(0, 0, 1e-3), Vec3(0, 1, 0));
  CHECK(stage.events().size() == before);
  stage.ask("score", playing::Start{});
  stage.ask("score", playing::Seek{.time = 0.9, .events = true});
  CHECK(stage.events().size() == before + 20'000);
  stage.advance_to(2.0 / 60);
  CHECK(stage.events().size() > before + 20'000 + 2'000);
  CHECK(std::ranges::is_sorted(stage.events(), {}, &StageEvent::time));
  CHECK(test::processor_seconds() - begin < 1.5);
}

TEST_CASE(
    "a rule that a contact pulls and overlap vetoes does not hold the stage up, and fires when the way is clear") {
  StageDescription description = falling_ball();
  description.world.gravity = Vec3(0, 0, 0);
  description.nodes[0].body->twist.linear = Vec3(0, -3, 0);
  description.nodes.push_back(
      {.name = "drum", .body = BodyDescription{.shape = {Sphere{0.3}}, .mass = 2.0, .drive = Drive::keyed()}});
  description.nodes.push_back({.name = "wall",
                               .rest = {.position = {0, -0.5, 0}},
                               .body = BodyDescription{.shape = {Sphere{0.3}}, .fixed = true}});
  Rule rule{.bodies = {"drum"}, .to = Drive::free(), .take_over = {.overlap = TakeOver::Overlap::veto}};
  rule.when.triggers = {when::ContactHit{.impulse = 0.1}};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(0.5);
  CHECK(stage.handoffs().empty());
  CHECK(std::ranges::count(stage.events(), std::string("vetoed"), &StageEvent::name) > 0);
  stage.remove(2);
  stage.advance_to(0.6);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].cause == Cause::contact);
}

TEST_CASE("a rule to a drive or a velocity that cannot be is refused when it is armed, and not when it fires") {
  Stage stage(falling_ball());
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [&](const OwnerChange& change, const char* words) {
    Rule rule = release_at(0.1, "ball");
    rule.to = change.to;
    rule.take_over = change.take_over;
    CHECK_THROWS_WITH_AS(stage.arm(rule), doctest::Contains(words), std::invalid_argument);
    CHECK_THROWS_WITH_AS(stage.hand_over(0, change), doctest::Contains(words), std::invalid_argument);
    Rule later = release_at(0.1, "ball");
    later.then = {{0.1, change}};
    CHECK_THROWS_WITH_AS(stage.arm(later), doctest::Contains(words), std::invalid_argument);
  };
  refuse({.to = {.hz = 5, .zeta = -1}}, "damping ratio of a drive");
  refuse({.to = {.hz = -5}}, "frequency of a drive");
  refuse({.to = {.hz = 5, .max_force = none}}, "greatest force of a drive");
  refuse({.to = {.hz = 5, .gravity_compensation = 2}}, "gravity compensation of a drive must lie in 0 to 1");
  refuse({.take_over = {.scale = none}}, "the scale of a velocity");
  refuse({.take_over = {.add = {.linear = Vec3(0, none, 0)}}}, "the scale of a velocity");
  stage.advance(0.3);
}

TEST_CASE("a body that lies in another is rewound by no time at all, too") {
  StageDescription description = falling_ball();
  description.nodes[0].body->drive = Drive::keyed();
  description.nodes.push_back({.name = "wall",
                               .rest = {.position = {0, 1, 0}},
                               .body = BodyDescription{.shape = {Box{{1, 1, 1}}}, .fixed = true}});
  for (const double within : {0.0, 5e-324, 1e-17, 1e300}) {
    Stage stage(description);
    stage.advance(0.2);
    stage.release(0, {.overlap = TakeOver::Overlap::rewind, .rewind_within = within});
    CHECK(stage.owner(0) == Owner::free);
    stage.advance(0.1);
  }
}

TEST_CASE("a play of no clip does not count for the natural length, nor a clip that lasts for ages") {
  StageDescription description = falling_ball();
  description.plays = {{.clip = 7}};
  CHECK(natural_length(description) == 3);
  description.clips = {Clip{.name = "long", .duration = 1e300}};
  description.plays = {{.clip = 0}};
  CHECK(natural_length(description) == 7);
}

TEST_CASE("a node's scale and its parents' scale what collides") {
  for (const bool of_parent : {false, true}) {
    StageDescription description;
    description.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                         {.name = "parent"},
                         {.name = "box",
                          .parent = 1,
                          .rest = {.position = {0, 2, 0}},
                          .body = BodyDescription{.shape = {Box{{0.2, 0.2, 0.2}}}, .mass = 1.0}}};
    description.nodes[of_parent ? 1 : 2].rest.scale = {3, 3, 3};
    Stage stage(description);
    stage.advance_to(4);
    CHECK(std::abs(stage.world(2).motion.pose.position.y() - 0.6) < 1e-4);
    description.nodes[2].body->shape = {Sphere{0.2}};
    Stage round(description);
    round.advance_to(4);
    CHECK(std::abs(round.world(2).motion.pose.position.y() - 0.6) < 1e-4);
    description.nodes[of_parent ? 1 : 2].rest.scale = {3, 1, 3};
    CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("same scale along all axes"), std::invalid_argument);
  }
}

TEST_CASE("a skeleton whose scales are ones rounded to floats carries bodies, and one that shears does not") {
  const auto skeleton = [](double error) {
    StageDescription description;
    description.nodes.push_back({.name = "root"});
    const Solid solids[] = {Capsule{0.02, 0.03}, Box{{0.02, 0.05, 0.02}}, Sphere{0.04}};
    for (std::size_t i = 0; i < 24; ++i) {
      NodeDescription bone{.name = "bone " + std::to_string(i),
                           .parent = i,
                           .body = BodyDescription{.shape = {solids[i % 3]}, .mass = 1.0, .drive = Drive::keyed()}};
      bone.rest.position = {0, 0.1, 0};
      bone.rest.rotation = Quat(0.9, 0.1, 0.2 + 0.01 * static_cast<double>(i), -0.3).normalized();
      bone.rest.scale = Vec3(1 + 2 * error, 1 - error, 1 + error);
      description.nodes.push_back(bone);
    }
    return description;
  };
  constexpr double rounded = 1.0 / (1 << 24);
  Stage stage(skeleton(rounded));
  stage.advance(0.1);
  CHECK((stage.world(24).motion.pose.position - stage.world(23).motion.pose.position).norm() ==
        doctest::Approx(0.1).epsilon(1e-5));
  CHECK_THROWS_WITH_AS(Stage{skeleton(1e-3)}, doctest::Contains("shears its node"), std::invalid_argument);
}

TEST_CASE("a pattern takes what can be taken, a name alone must be takeable") {
  StageDescription description = falling_ball();
  description.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  description.rules = {recover_at(0.1, "*")};
  Stage stage(description);
  stage.advance(0.2);
  CHECK(stage.handoffs().size() == 1);
  description.rules = {recover_at(0.1, "floor")};
  CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("static"), std::invalid_argument);
}

TEST_CASE("rules that waited in vain are listed with what is known of them") {
  StageDescription description = falling_ball();
  description.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  const auto rule = [&](const Trigger& trigger) {
    Rule one = recover_at(0, "ball");
    one.when.triggers = {trigger};
    description.rules.push_back(one);
  };
  rule(when::At{9});
  rule(when::Marker{"let go"});
  rule(when::ContactHit{.impulse = 1000});
  rule(when::ContactHit{.with = "nobody"});
  rule(when::Asleep{50});
  description.rules.push_back(release_at(0.1, "ball"));
  Stage stage(description);
  const Recording recording = record(stage, 2, 10);
  REQUIRE(recording.unfired.size() == 6);
  const char* words[] = {"9 s lies beyond the end",  "no playing clip that moves the body has an event \"let go\"",
                         "the greatest blow was 4.", "nothing named \"nobody\" touched",
                         "the rule waits for 50 s",  "free all the time"};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(recording.unfired[i].rule == i);
    CHECK(recording.unfired[i].node == 0);
    CHECK_MESSAGE(recording.unfired[i].reason.find(words[i]) != std::string::npos, recording.unfired[i].reason);
  }
}

TEST_CASE("a rule that waited for all of several is listed with those that did not come, and no others") {
  StageDescription description = falling_ball();
  Rule one = recover_at(0, "ball");
  one.when.all = true;
  one.when.triggers = {when::At{0.3}, when::ContactHit{.with = "nobody"}, when::At{0.4}};
  description.rules = {one};
  Stage stage(description);
  const Recording recording = record(stage, 1, 10);
  REQUIRE(recording.unfired.size() == 1);
  CHECK(recording.unfired[0].reason == "nothing named \"nobody\" touched the body");
}

TEST_CASE(
    "a motion that is no longer finite is thrown with node, time and cause, again by who goes on, until it is gone") {
  StageDescription description;
  description.nodes = {{.name = "still"},
                       {.name = "anvil", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
  description.world.gravity = Vec3(0, 1e29, 0);
  Stage stage(description);
  const NodeId anvil = stage.node("anvil");
  const double reached = [&] {
    for (int call = 0; call < 100; ++call) {
      try {
        stage.advance(1);
      } catch (const NotFinite& fault) {  // as for a world
        CHECK(fault.time > 1);
        CHECK(stage.time() > call);  // what was reached, not where the call began
        return stage.time();
      }
    }
    return -1.0;
  }();
  REQUIRE(reached >= 0);
  for (int again = 0; again < 3; ++again) {
    try {
      stage.advance(1);
      CHECK(false);
    } catch (const NodeNotFinite& fault) {
      CHECK(fault.node == anvil);
      CHECK(fault.time > reached);
      CHECK(fault.time < reached + 2 * stage.step());
      CHECK(std::string(fault.what()).find("the motion of \"anvil\" is no longer finite at ") == 0);
      CHECK(std::string(fault.what()).ends_with(" s: " + fault.cause));
      CHECK(!fault.cause.empty());
    }
    CHECK(stage.world(anvil).motion.pose.position.allFinite());
  }
  stage.remove(anvil);
  stage.advance(1);
  CHECK(stage.time() > reached + 0.9);
}

TEST_CASE("a path too fast for a world ends the run with node, time and cause, as the caller's own hand-off does") {
  for (const double rate : {1e31, 1e200, 1e300}) {
    CAPTURE(rate);
    const auto turning = [rate](double time, Side) {
      return Sample<Quat>{Quat(Eigen::AngleAxisd(time, Eigen::Vector3d::UnitZ())), Vec3(0, 0, rate), Vec3::Zero()};
    };
    StageDescription description = falling_ball();
    description.nodes.insert(description.nodes.begin(), {.name = "arm"});
    description.nodes[1].parent = 0;
    description.clips = {{.name = "turn", .duration = 1}};
    description.clips[0].tracks = {{"arm", "rotation", Curve<Quat>(turning, 0, 1)}};
    description.plays = {{.clip = 0, .at = 0.1}};
    Stage stage(description);
    for (int call = 0; call < 2; ++call) {
      try {
        stage.advance(0.5);
        CHECK(false);
      } catch (const NodeNotFinite& fault) {
        CHECK(fault.node == 1);
        CHECK(fault.time >= 0.09);
        CHECK(fault.time <= 0.11);
        CHECK_MESSAGE(fault.cause.find("its path turns it at ") == 0, fault.cause);
      }
    }
    CHECK(stage.time() <= 0.11);
    CHECK(stage.world(1).motion.pose.position.allFinite());
  }
}

TEST_CASE("a recording of more than a million events is refused, with how many there are by when") {
  StageDescription description;
  description.nodes = {{.name = "a"}};
  description.clips = {{.name = "tick", .duration = 1e-6, .loop = {LoopMode::repeat}}};
  description.clips[0].events = {{.from = 0, .to = 0, .name = "tick"}};
  description.plays = {{.clip = 0}};
  Stage stage(description);
  CHECK_THROWS_WITH_AS((void)record(stage, 4, 30), doctest::Contains("events by 1 s; a million are allowed"),
                       std::invalid_argument);
  Stage shorter(description);
  CHECK(record(shorter, 0.1, 30).events.size() == doctest::Approx(1e5).epsilon(0.01));
}

TEST_CASE("a node's color must be finite, at the start and later") {
  StageDescription description = falling_ball();
  description.nodes[0].color = Color{};
  Stage stage(description);
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    description.nodes[0].color->rgba[1] = number;
    CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("color of \"ball\""), std::invalid_argument);
    NodeDescription late{.name = "late", .color = description.nodes[0].color};
    CHECK_THROWS_AS(stage.add(late), std::invalid_argument);
  }
  CHECK(stage.nodes().size() == 1);
}

TEST_CASE("a path that was moved from is what it was") {
  const Stage stage(falling_ball());
  Path path = stage.path(0);
  const Path taken = std::move(path);
  CHECK(path.at(0.3).pose.position == taken.at(0.3).pose.position);
}
