#include <tweenfall/physics/stage/recording.h>
#include "physics/handoff/scenes.h"

#include <cmath>
#include <map>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Ten boxes on a floor, and far from them a keyed ball, a free one, and a thing without a body.
StageDescription stack_and_far_bodies(double step) {
  StageDescription stage;
  stage.step = step;
  stage.world.sleep_after = std::numeric_limits<double>::infinity();
  stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                 {.name = "keyed",
                  .rest = {.position = {90, 1, 0}},
                  .body = BodyDescription{.shape = {Sphere{0.1}}, .drive = Drive::keyed()}},
                 {.name = "free", .rest = {.position = {60, 900, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}}},
                 {.name = "deco"}};
  for (int i = 0; i < 10; ++i)
    stage.nodes.push_back({.name = "box" + std::to_string(i),
                           .rest = {.position = {0.02 * (i % 2), 0.5 + i, 0}},
                           .body = BodyDescription{.shape = {Box{{0.5, 0.5, 0.5}}}, .mass = 10.0}});
  return stage;
}

/// Where the boxes are at this time if nothing happens.
const std::vector<Vec3>& undisturbed(double step, double time) {
  static std::map<std::pair<double, double>, std::vector<Vec3>> known;
  std::vector<Vec3>& places = known[{step, time}];
  if (places.empty()) {
    Stage alone(stack_and_far_bodies(step));
    alone.advance_to(time);
    for (std::size_t i = 4; i < 14; ++i) places.push_back(alone.world(i).motion.pose.position);
  }
  return places;
}

/// How far the boxes are from where they would be if nothing had happened.
double greatest_shift(const Stage& stage) {
  const std::vector<Vec3>& places = undisturbed(stage.step(), stage.time());
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    most = std::max(most, (stage.world(i + 4).motion.pose.position - places[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("rules at every frame and an ulp beside it leave a stack of ten where it stands") {
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 100, 1.0 / 240}) {
    for (const int side : {-1, 0, 1}) {
      CAPTURE(step);
      CAPTURE(side);
      StageDescription description = stack_and_far_bodies(step);
      int count = 0;
      for (int frame = 12; frame <= 27; ++frame) {
        double time = frame / 60.0;
        if (side != 0) time = std::nextafter(time, side < 0 ? 0.0 : 10.0);
        description.rules.push_back(frame % 2 == 0 ? release_at(time, "keyed") : recover_at(time, "keyed"));
        ++count;
      }
      Stage stage(description);
      stage.advance_to(0.6);
      CHECK(greatest_shift(stage) < 1e-4);
      CHECK(stage.handoffs().size() == static_cast<std::size_t>(count));
    }
  }
}

TEST_CASE("impulses of nothing and releases by the caller leave a stack of ten where it stands, whenever they come") {
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 100, 1.0 / 240}) {
    for (const double beside : {-3e-3, -1e-6, -1e-9, -1e-12, 0.0, 1e-12, 0.7e-9, 1e-5, 4e-4, 8e-3}) {
      CAPTURE(step);
      CAPTURE(beside);
      Stage stage(stack_and_far_bodies(step));
      stage.advance_to(0.15);
      for (int frame = 12; frame < 36; ++frame) {
        stage.advance_to(frame / 60.0 + beside);
        stage.apply_impulse(2, {0, 0, 0}, {60, 900, 0});
        stage.apply_impulse(13, {0, 0, 0}, {0, 9.5, 0});
        if (frame % 2 == 0)
          stage.release(1);
        else
          stage.recover(1);
        CHECK(stage.owner(1) == (frame % 2 == 0 ? Owner::free : Owner::keyed));
      }
      stage.advance_to(0.75);
      CHECK(greatest_shift(stage) < 1e-4);
      CHECK(stage.handoffs().size() == 24);
      const std::uint64_t hash = stage.state_hash();
      stage.seek(0.3);
      stage.seek(0.75);
      CHECK(stage.state_hash() == hash);
      CHECK(stage.handoffs().size() == 24);
    }
  }
}

TEST_CASE("in a plane, too, a stack of ten stands where it stood, wherever its steps are split") {
  for (const double step : {1.0 / 60, 1.0 / 240}) {
    for (const double beside : {-3e-3, -1e-6, 1e-8, 1e-4, 8e-3}) {
      CAPTURE(step);
      CAPTURE(beside);
      StageDescription description = stack_and_far_bodies(step);
      description.world.plane = WorldPlane::xy;
      Stage alone(description), split(description);
      // There it takes a second until it has sunk to its rest.
      for (int frame = 60; frame < 68; ++frame) {
        split.advance_to(frame / 60.0 + beside);
        split.apply_impulse(2, {0, 0, 0}, {60, 900, 0});
      }
      double most = 0;
      for (int frame = 68; frame < 80; ++frame) {
        alone.advance_to(frame / 60.0);
        split.advance_to(frame / 60.0);
        for (std::size_t i = 4; i < 14; ++i)
          most = std::max(most, (alone.world(i).motion.pose.position - split.world(i).motion.pose.position).norm());
      }
      CHECK(most < 1e-4);
    }
  }
}

TEST_CASE("257 and 600 changes in one step, a millionth of a microsecond and more apart, are all made") {
  for (const auto& changes : {std::pair{600, 1e-12}, std::pair{257, 3e-6}}) {
    const int count = changes.first;
    const double apart = changes.second;
    CAPTURE(count);
    Stage stage(stack_and_far_bodies(1.0 / 240));
    stage.advance_to(0.25);
    for (int i = 0; i < count; ++i) {
      stage.advance_to(0.25 + 1e-5 + i * apart);
      stage.apply_impulse(2, {1, 0, 0}, stage.world(2).motion.pose.position);
    }
    const double mass = 1000 * 4.0 / 3 * std::numbers::pi * 1e-3;
    CHECK(stage.twist(2).linear.x() == doctest::Approx(count / mass).epsilon(1e-12));
    stage.advance_to(0.35);
    CHECK(greatest_shift(stage) < 1e-4);
  }
}

TEST_CASE("rules a moment apart are fired in order of time, whatever their order in the list") {
  for (const double apart : {0.0, 1e-13, 1e-10, 0.9e-9, 1.1e-9, 1e-6}) {
    for (const double time : {0.5, 0.5 + 1.0 / 480, 1e-310, 0.0}) {
      CAPTURE(apart);
      CAPTURE(time);
      StageDescription description = stack_and_far_bodies(1.0 / 240);
      description.nodes.resize(4);
      description.rules = {recover_at(time + apart + 1e-14, "keyed"), release_at(time, "keyed")};
      Stage stage(description);
      stage.advance_to(0.7);
      REQUIRE(stage.handoffs().size() == 2);
      CHECK(stage.handoffs()[0].to == Owner::free);
      CHECK(stage.handoffs()[1].to == Owner::keyed);
    }
  }
}

TEST_CASE("a loop of something without a body is nothing to physics") {
  StageDescription description = stack_and_far_bodies(1.0 / 240);
  Stage still(description);
  still.advance_to(0.3);
  for (const double length : {0.1, 1.0 / 60, 1e-4}) {
    Clip clip;
    clip.name = "spin";
    clip.duration = length;
    clip.loop = {LoopMode::repeat, 0};
    clip.tracks = {
        {"deco", "position",
         keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 0, 0)}, {.time = length, .value = Vec3(1, 0, 0)}})}};
    description.clips = {clip};
    description.plays = {{.clip = 0}};
    Stage stage(description);
    stage.advance_to(0.3);
    CHECK(stage.state_hash() == still.state_hash());
  }
}

TEST_CASE("a body that leaves its path a moment beside a step's end leaves from where the path was at that moment") {
  for (const double step : compared_steps) {
    for (const double beside : {-0.9e-9, -1e-12, 1e-12, 0.9e-9, 2e-9}) {
      const double released = 15 * (1.0 / 30) + beside, end = 1.1, w = std::sqrt(standard_gravity);
      StageDescription description = pendulum(step);
      description.rules = {release_at(released, "bob")};
      Stage stage(description);
      stage.advance_to(end);
      REQUIRE(stage.handoffs().size() == 1);
      CHECK(stage.handoffs()[0].time == released);
      const double theta = std::cos(w * released), rate = -w * std::sin(w * released), fall = end - released;
      const Vec3 velocity(rate * std::cos(theta), rate * std::sin(theta), 0);
      CHECK(near(stage.handoffs()[0].after.twist.linear, velocity, 1e-9));
      CHECK(near(stage.handoffs()[0].after.pose.position, Vec3(std::sin(theta), 2 - std::cos(theta), 0), 1e-12));
      const Vec3 expected = Vec3(std::sin(theta), 2 - std::cos(theta), 0) + fall * velocity -
                            Vec3(0, standard_gravity * fall * fall / 2, 0);
      CHECK(near(stage.world(stage.node("bob")).motion.pose.position, expected, 1e-9));
    }
  }
}

TEST_CASE("a path that begins anew a moment after a step's end is shown there with its own rate") {
  const double step = 1.0 / 240;
  for (const double beside : {-0.9e-9, -1e-12, 0.0, 1e-12, 0.9e-9}) {
    CAPTURE(beside);
    StageDescription stage;
    stage.step = step;
    stage.world.gravity = {0, 0, 0};
    stage.nodes = {{.name = "ball", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
    Clip clip{.name = "move", .duration = 4};
    clip.tracks = {{"ball", "position",
                    keyed_curve<Vec3>(
                        {{.time = 0, .value = {0, 0, 0}, .ease = Ease::linear()}, {.time = 4, .value = {8, 0, 0}}})}};
    stage.clips = {clip};
    stage.plays = {{.clip = 0}};
    Rule back;
    back.bodies = {"ball"};
    back.when.triggers = {when::At{120 * step + beside}};
    back.to = Drive::keyed();
    back.hand_back.clip = "move";
    back.hand_back.clock = HandBack::Clock::restart;
    back.hand_back.anchor = HandBack::Anchor::here;
    Rule away = back;
    away.when.triggers = {when::At{0.25}};
    away.to = Drive::free();
    stage.rules = {away, back};
    Stage run(stage);
    // The body flies as fast as the path begins, so that nothing is left to settle.
    for (int n = 0; n <= 140; ++n) {
      CAPTURE(n);
      run.advance_to(n * step);
      CHECK(run.twist(0).linear.x() == doctest::Approx(2).epsilon(1e-9));
      CHECK(std::abs(run.world(0).motion.pose.position.x() - 2 * run.time()) < 1e-8);
    }
    REQUIRE(run.handoffs().size() == 2);
  }
}

TEST_CASE("more jumps in a step than it is split at are told, and none of its rules is lost") {
  StageDescription description = stack_and_far_bodies(0.1);
  Clip clip;
  clip.name = "flicker";
  clip.duration = 2e-5;
  clip.loop = {LoopMode::repeat, 0};
  clip.tracks = {{"keyed", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(90, 0, 0)}, {.time = 2e-5, .value = Vec3(90, 1, 0)}})}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  description.nodes.resize(4);
  description.nodes[2].body->drive = Drive::keyed();
  description.rules = {release_at(0.0900001, "free")};
  Stage stage(description);
  stage.advance_to(0.1);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].time == 0.0900001);
  CHECK(std::ranges::count(stage.events(), std::string("split limit"), &StageEvent::name) == 1);
}

TEST_CASE("a blow falls when it fell, bit by bit, whoever asks for something else later in its step") {
  StageDescription description;
  description.step = 1.0 / 60;
  description.nodes = {
      {.name = "hammer", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 2.0}},
      {.name = "nail",
       .rest = {.position = {0.013, 0.7, 0.02}},
       .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .restitution = 0.3}},
      {.name = "far", .rest = {.position = {9, 0, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}}}};
  Clip clip{.name = "strike", .duration = 1};
  clip.tracks = {{"hammer", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}},
                                     {.time = 0.3, .value = {0.01, 0.3, 0.03}},
                                     {.time = 1, .value = {0, 1.5, 0}}})}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  Rule rule{.bodies = {"hammer"}, .to = Drive::free()};
  rule.when.triggers = {when::ContactHit{.impulse = 0.01}};
  description.rules = {rule};
  Stage alone(description);
  alone.advance_to(1);
  REQUIRE(alone.handoffs().size() == 1);
  const double blow = alone.handoffs()[0].time, end = std::ceil(60 * blow) / 60;
  REQUIRE(end - blow > 1e-3);
  for (const double share : {0.02, 0.3, 0.7, 0.99}) {
    CAPTURE(share);
    Stage stage(description);
    const double time = blow + share * (end - blow);
    stage.advance_to(time);
    stage.apply_impulse(stage.node("far"), Vec3(0, 0, 1), Vec3(9, 0, 0));
    const std::uint64_t hash = stage.state_hash();
    stage.seek(0);
    stage.seek(time);
    CHECK(stage.state_hash() == hash);
    REQUIRE(stage.handoffs().size() == 1);
    CHECK(stage.handoffs()[0].time == blow);
  }
}
