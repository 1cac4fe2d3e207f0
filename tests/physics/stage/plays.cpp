#include "support.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/recording.h>
#include <tweenfall/physics/stage/stage.h>

#include <cstring>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A ball carried along x at 1 m/s by "walk", with an event at 0.5 s; "lift" holds it 3 m up.
StageDescription carried() {
  StageDescription stage;
  stage.nodes = {{.name = "ball", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}},
                 {.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}}};
  stage.nodes[1].rest.position = {0, -1, 0};
  Clip walk{.name = "walk", .duration = 10}, lift{.name = "lift", .duration = 10};
  walk.tracks = {{"ball", "position",
                  keyed_curve<Vec3>(
                      {{.time = 0, .value = {0, 0, 0}, .ease = Ease::linear()}, {.time = 10, .value = {10, 0, 0}}})}};
  walk.events = {{.from = 0, .to = 0, .name = "off", .data = {}}, {.from = 0.5, .to = 0.5, .name = "half", .data = {}}};
  lift.tracks = {{"ball", "position", Curve<Vec3>(Vec3(0, 3, 0))}};
  stage.clips = {walk, lift};
  stage.plays = {Play{.clip = 0}};
  return stage;
}

double x_of(const Stage& stage) {
  return stage.world(0).motion.pose.position.x();
}

bool same(const Recording& a, const Recording& b) {
  bool equal = a.times == b.times && a.events.size() == b.events.size() && a.handoffs.size() == b.handoffs.size();
  for (std::size_t n = 0; equal && n < a.nodes.size(); ++n)
    for (std::size_t i = 0; i < a.times.size(); ++i)
      equal = equal && a.nodes[n].world[i].motion.pose.position == b.nodes[n].world[i].motion.pose.position &&
              a.nodes[n].twist[i].linear == b.nodes[n].twist[i].linear && a.nodes[n].owner[i] == b.nodes[n].owner[i];
  for (std::size_t i = 0; equal && i < a.events.size(); ++i)
    equal = a.events[i].time == b.events[i].time && a.events[i].name == b.events[i].name;
  return equal;
}

}  // namespace

TEST_CASE("a speed changed while a body follows takes effect at its instant, and its place does not jump") {
  Stage stage(carried());
  stage.advance_to(0.31);
  CHECK(near(x_of(stage), 0.31, 1e-14));
  stage.ask("walk", playing::SetSpeed{.speed = {{0, 3}}});
  CHECK(near(x_of(stage), 0.31, 1e-14));
  CHECK(near(stage.twist(0).linear.x(), 3, 1e-12));
  stage.advance_to(0.4713);
  CHECK(near(x_of(stage), 0.31 + 3 * (0.4713 - 0.31), 1e-13));
  stage.seek(0.2);
  CHECK(near(x_of(stage), 0.2, 1e-14));
  stage.seek(0.4713);
  CHECK(near(x_of(stage), 0.31 + 3 * (0.4713 - 0.31), 1e-13));
}

TEST_CASE("an event fires once across a change of speed, at its new time") {
  Stage stage(carried());
  stage.advance_to(0.3);
  stage.ask("walk", playing::SetSpeed{.speed = {{0, 2}}});
  stage.advance_to(1);
  REQUIRE(stage.events().size() == 2);
  CHECK(stage.events()[0].name == "off");
  CHECK(stage.events()[1].name == "half");
  CHECK(near(stage.events()[1].time, 0.4, 1e-12));
}

TEST_CASE("an interval is told where it begins and where it ends, each as what it is, and after loading too") {
  StageDescription stage = carried();
  stage.clips[0].events.push_back({.from = 0.2, .to = 0.7, .name = "loud", .data = {}});
  Stage straight(stage), saved(stage), loaded(stage);
  straight.advance_to(1);
  saved.advance_to(0.31);
  loaded.load(saved.save());
  loaded.advance_to(1);
  for (const Stage* each : {&straight, &loaded}) {
    std::string told;
    for (const StageEvent& event : each->events())
      told += event.name + (event.kind == EventKind::begin ? "( " : event.kind == EventKind::end ? ") " : " ");
    CHECK(told == "off loud( half loud) ");
  }
}

TEST_CASE("a play started with a fade leads the body over with the weight's own rate") {
  Stage stage(carried());
  stage.advance_to(0.2);
  stage.ask("lift", playing::Start{.fade_in = {0.5}});
  stage.advance_to(0.45);
  const Vec3 place = stage.world(0).motion.pose.position, speed = stage.twist(0).linear;
  CHECK(near(place, Vec3(0.45 * 0.5, 1.5, 0), 1e-13));
  CHECK(near(speed, Vec3(0.5 - 2 * 0.45, 6, 0), 1e-12));
  stage.advance_to(1);
  CHECK(near(stage.world(0).motion.pose.position, Vec3(0, 3, 0), 1e-13));
  stage.ask("lift", playing::Stop{});
  CHECK(near(x_of(stage), 1, 1e-13));
}

TEST_CASE("a rule that waits for a clip's end fires when its play is stopped, at that instant") {
  StageDescription described = carried();
  described.rules = {{.bodies = {"ball"}, .when = {.triggers = {when::ClipEnd{}}}, .to = Drive::free()}};
  Stage stage(described);
  stage.advance_to(0.377);
  CHECK(stage.owner(0) == Owner::keyed);
  stage.ask("walk", playing::Stop{.seconds = 0.1});
  stage.advance_to(1);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(near(stage.handoffs()[0].time, 0.477, 1e-12));
  CHECK(stage.handoffs()[0].cause == Cause::clip_end);
  Stage at_once(described);
  at_once.advance_to(0.377);
  at_once.ask("walk", playing::Stop{});
  REQUIRE(at_once.handoffs().size() == 1);
  CHECK(at_once.handoffs()[0].time == 0.377);
}

TEST_CASE("a rule that waits for a marker fires when a play is started on it") {
  StageDescription described = carried();
  described.plays = {Play{.clip = 1}};
  described.rules = {{.bodies = {"ball"}, .when = {.triggers = {when::Marker{"off"}}}, .to = Drive::free()}};
  Stage stage(described);
  stage.advance_to(0.25);
  CHECK(stage.handoffs().empty());
  stage.ask("walk", playing::Start{});
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].time == 0.25);
  REQUIRE(stage.events().size() == 1);
  CHECK(stage.events()[0].name == "off");
}

TEST_CASE("inputs given again to another stage, or found again by going back, run to the same bits") {
  const auto ask_much = [](Stage& stage) {
    stage.advance_to(0.123);
    stage.ask("walk", playing::SetSpeed{.speed = {{0, 2}}, .seconds = 0.2});
    stage.advance_to(0.5);
    stage.ask("lift", playing::Start{.fade_in = {0.3, Ease::named("cubic-in-out").value()}});
    stage.advance_to(0.7);
    stage.ask("lift", playing::FadeTo{.weight = 0.25, .seconds = 0.4});
    stage.ask("walk", playing::Seek{.time = 0.1, .events = true});
    stage.advance_to(1.1);
    stage.release(0);
    stage.apply_impulse(0, {0.3, 2, 0.1}, {0, 0, 0.02});
    stage.advance_to(1.7);
    stage.recover(0, {});
    stage.ask("walk", playing::Stop{.seconds = 0.5});
  };
  Stage stage(carried());
  ask_much(stage);
  const std::vector<TimedInput> inputs = stage.inputs();
  CHECK(inputs.size() == 8);
  stage.advance_to(3);
  const std::uint64_t hash = stage.state_hash();

  Stage first(carried()), second(carried());
  const Recording a = record(first, 3, 60, 1e9, false, inputs);
  const Recording b = record(second, 3, 47.3, 1e9, false, inputs);
  CHECK(first.state_hash() == hash);
  CHECK(second.state_hash() == hash);
  CHECK(a.events.size() == b.events.size());
  stage.seek(0.05);
  stage.seek(3);
  CHECK(stage.state_hash() == hash);
  Stage again(carried());
  CHECK(same(a, record(again, 3, 60, 1e9, false, inputs)));
}

TEST_CASE("what plays were asked for is saved with the stage") {
  Stage stage(carried());
  stage.advance_to(0.3);
  stage.ask("walk", playing::SetSpeed{.speed = {{0, 1, Ease::named("quad-in-out").value()}, {0.5, 2}}});
  stage.ask("lift", playing::Start{.to = 5, .loop = Loop{LoopMode::pingpong, 2}, .weight = {{0, 0}, {1, 0.5}}});
  stage.advance_to(0.61);
  const std::vector<std::byte> saved = stage.save();
  stage.advance_to(2);
  const Vec3 place = stage.world(0).motion.pose.position;
  Stage other(carried());
  other.load(saved);
  CHECK(other.inputs().size() == 2);
  other.advance_to(2);
  CHECK(other.world(0).motion.pose.position == place);
  CHECK(other.state_hash() == stage.state_hash());
  other.seek(0.4);
  stage.seek(0.4);
  CHECK(other.world(0).motion.pose.position == stage.world(0).motion.pose.position);
}

TEST_CASE("what cannot be asked changes nothing, and says what is wrong") {
  Stage stage(carried());
  stage.advance_to(0.3);
  CHECK_THROWS_WITH_AS(stage.ask("wlak", playing::Stop{}), "there is no play \"wlak\"; did you mean \"walk\"?",
                       std::invalid_argument);
  CHECK_THROWS_AS(stage.ask("walk", playing::FadeTo{.weight = 2}), std::invalid_argument);
  CHECK_THROWS_AS(stage.ask("walk", playing::SetSpeed{.speed = {}}), std::invalid_argument);
  CHECK_THROWS_AS(stage.ask("walk", playing::Stop{.seconds = -1}), std::invalid_argument);
  CHECK(stage.inputs().empty());
  stage.advance_to(0.5);
  CHECK(near(x_of(stage), 0.5, 1e-14));
  const TimedInput behind{0.2, input::Ask{"walk", playing::Stop{}}};
  CHECK_THROWS_AS(static_cast<void>(advance_with(stage, {&behind, 1}, 1)), std::invalid_argument);
}

TEST_CASE("the texts and weights of user tracks count in the memory that a recording may take") {
  constexpr double megabyte = 1024 * 1024;
  StageDescription description = carried();
  SUBCASE("a text") {
    using Texts = StepCurve<std::string>;
    description.clips[0].tracks.push_back({"ball", "word", Texts({{0.0, std::string(1 << 20, 'x')}})});
  }
  SUBCASE("weights") {
    // A weight has a value, a rate and an acceleration.
    description.clips[0].tracks.push_back({"ball", "smiles", WeightCurves((1 << 20) / 24, Curve<double>(0.5))});
  }
  Stage enough(description), short_of_it(description);
  // 11 frames, of which each has one.
  CHECK(record(enough, 1, 10, 11.1 * megabyte).user_tracks.at(0).value.size() == 11);
  CHECK_THROWS_WITH_AS((void)record(short_of_it, 1, 10, 10.9 * megabyte),
                       doctest::Contains("by 1 s a recording of the user tracks takes more memory than is allowed"),
                       std::invalid_argument);
}

TEST_CASE("what frames need is not allowed once more to user tracks") {
  StageDescription description = carried();
  description.clips[0].tracks.push_back({"ball", "word", StepCurve<std::string>({{0.0, std::string(5000, 'x')}})});
  // 101 frames of 5 kB in texts and at least .5 kB in two nodes.
  static_assert(2 * sizeof(WorldMotion) > 500);
  Stage stage(description);
  CHECK_THROWS_WITH_AS((void)record(stage, 1, 100, 101 * 5500.0), doctest::Contains("user tracks"),
                       std::invalid_argument);
}

TEST_CASE("a recording has the user tracks that were played at some time, and nothing else takes memory") {
  StageDescription description = carried();
  using Texts = StepCurve<std::string>;
  description.clips[0].tracks.push_back({"ball", "first", Texts({{0.0, "go"}})});
  description.clips[0].tracks.push_back({"ball", "drive_hz", Curve<double>(5)});
  description.clips[1].tracks.push_back({"ball", "second", Texts({{0.0, "up"}})});
  Clip never{.name = "never", .duration = 1};
  for (int i = 0; i < 1000; ++i) never.tracks.push_back({"ball", "own" + std::to_string(i), Curve<double>(1)});
  description.clips.push_back(never);
  Stage stage(description);
  const std::vector<TimedInput> inputs = {{.time = 0.5, .what = input::Ask{"lift", playing::Start{}}}};
  // Those of "never" would take 11,000 values.
  const Recording recording = record(stage, 1, 10, 1000 * sizeof(UserValue), false, inputs);
  REQUIRE(recording.user_tracks.size() == 2);
  CHECK(recording.user_tracks[0].name == "ball.first");
  CHECK(recording.user_tracks[1].name == "ball.second");
  for (std::size_t frame = 0; frame < 11; ++frame) {
    CHECK(std::get<std::string>(recording.user_tracks[0].value.at(frame)) == "go");
    CHECK(std::get<std::string>(recording.user_tracks[1].value.at(frame)) == (frame < 5 ? "" : "up"));
  }
}
