// Bodies that leave their scripts, or go on, at the very instant at which a curve bends or jumps, where no number may
// stand for that instant exactly.

#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/recording.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace tweenfall;

namespace {

BodyDescription small_ball() {
  return {.shape = {Sphere{0.1}}, .mass = 1.0};
}

StageDescription without_gravity(std::vector<NodeDescription> nodes, Clip clip, Play play) {
  StageDescription stage{.nodes = std::move(nodes), .clips = {std::move(clip)}, .plays = {std::move(play)}};
  stage.world.gravity = Vec3(0, 0, 0);
  return stage;
}

/// Along x with slope 1 up to `corner`, then with slope -3, and an event at `event`.
Clip bent(double corner, double event) {
  Clip clip{.name = "way", .duration = 1};
  clip.tracks = {{"ball", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::linear()},
                                     {.time = corner, .value = {corner, 0, 0}, .ease = Ease::linear()},
                                     {.time = 1, .value = {corner - 3 * (1 - corner), 0, 0}}})}};
  clip.events = {{.from = event, .to = event, .name = "here", .data = {}}};
  return clip;
}

}  // namespace

TEST_CASE("let go at the corner of a curve, a body leaves as it arrives, though times are rounded") {
  // 0.8 - 0.7 is more than 0.1, as doubles are.
  Stage stage(without_gravity({{.name = "ball", .body = small_ball()}}, bent(0.1, 1), {.clip = 0, .at = 0.7}));
  stage.advance_to(0.8);
  stage.release(stage.node("ball"));
  CHECK(stage.twist(stage.node("ball")).linear.x() == doctest::Approx(1).epsilon(1e-12));
  stage.advance_to(1.8);
  CHECK(stage.world(stage.node("ball")).motion.pose.position.x() == doctest::Approx(1.1).epsilon(1e-12));
}

TEST_CASE("let go by an event at a corner or at a seam, a body leaves as it arrives, at any speed and in any round") {
  constexpr double corner = 0.47;
  for (const double speed : {0.37, 0.9, 1.28, 1.7, 2.65, -0.71, -1.95, -2.57})
    for (const double at : {0.0, 0.29, 0.92})
      for (const LoopMode mode : {LoopMode::repeat, LoopMode::repeat_offset, LoopMode::pingpong})
        for (const double place : {0.0, corner, 1.0})
          for (const double armed_at : {3.0, 7.5}) {
            CAPTURE(speed);
            CAPTURE(at);
            CAPTURE(static_cast<int>(mode));
            CAPTURE(place);
            Play play{.clip = 0, .at = at, .speed = speed};
            play.loop = Loop{mode, 0};
            Stage stage(without_gravity({{.name = "ball", .body = small_ball()}}, bent(corner, place), play));
            stage.advance_to(armed_at);
            stage.arm({.bodies = {"ball"}, .when = {{when::Event{"here"}}}, .to = Drive::free()});
            stage.advance(6);
            REQUIRE(stage.handoffs().size() == 1);
            const HandOff& leaves = stage.handoffs().front();
            const Motion shortly_before = stage.path(0).at(leaves.time - 1e-6);
            const double slope = shortly_before.twist.linear.x() / speed;
            CHECK(std::min({std::abs(slope - 1), std::abs(slope + 1), std::abs(slope - 3), std::abs(slope + 3)}) <
                  1e-9);
            CHECK(std::abs(leaves.after.twist.linear.x() - slope * speed) < 1e-9);
            CHECK(std::abs(leaves.after.pose.position.x() - (shortly_before.pose.position.x() + 1e-6 * slope * speed)) <
                  1e-12);
          }
}

TEST_CASE("where a loop begins anew elsewhere, its body strikes nothing on the way, at any speed") {
  Clip around{.name = "around", .duration = 1};
  around.tracks = {{"led", "position",
                    keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::linear()},
                                       {.time = 0.2, .value = {0, 0, 1}, .ease = Ease::linear()},
                                       {.time = 0.8, .value = {1, 0, 1}, .ease = Ease::linear()},
                                       {.time = 1, .value = {1, 0, 0}}})}};
  for (const double speed : {0.61, 1.0, 1.28, 1.61, 1.92, 2.67, -0.83, -1.95})
    for (const double at : {0.0, 0.3, 0.4, 0.63, 0.73, 0.92}) {
      CAPTURE(speed);
      CAPTURE(at);
      Play play{.clip = 0, .at = at, .speed = speed};
      play.loop = Loop{LoopMode::repeat, 0};
      // Half way between the end of the clip and its start.
      const NodeDescription stands{.name = "stands", .rest = {.position = Vec3(0.5, 0, 0)}, .body = small_ball()};
      Stage stage(without_gravity({{.name = "led", .body = small_ball()}, stands}, around, play));
      const Recording recording = record(stage, 8, 60);
      CHECK(stage.events().empty());
      CHECK(stage.twist(stage.node("stands")).linear == Vec3(0, 0, 0));
      // Each time around is a jump that no picture may draw as a movement.
      const double rounds = (8 - at) * std::abs(speed);
      if (std::abs(rounds - std::round(rounds)) > 1e-3) CHECK(recording.jumps.size() == std::floor(rounds));
    }
}
