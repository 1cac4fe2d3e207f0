#include "physics/handoff/scenes.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/shape.h>

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double speed = 0.8;  // m/s, of each of the two

/// Bodies a little askew, one beside the other, between two boxes that are led toward each other until they meet.
StageDescription press(const Solid& solid, double rate, double friction, int count = 1) {
  StageDescription stage;
  stage.step = 1 / rate;
  stage.world.gravity.setZero();
  const double far = 1 + 0.3 * (count - 1);
  const auto jaw = [&](const char* name, double x) {
    return NodeDescription{.name = name,
                           .rest = {.position = {x, 0, 0}},
                           .body = BodyDescription{.shape = {Box{{0.5, 1, 1}}}, .friction = friction}};
  };
  Pose askew{.position = Vec3(0.01, 0.003, 0.002)};
  askew.rotation = exp_map(Vec3(0.05, 0.09, 0.12));
  stage.nodes = {jaw("left", -far), jaw("right", far)};
  for (int i = 0; i < count; ++i) {
    askew.position.x() = 0.01 + 0.6 * (i - 0.5 * (count - 1));
    stage.nodes.push_back(
        {.name = "b" + std::to_string(i),
         .rest = askew,
         .body = BodyDescription{.shape = {solid}, .mass = 1.0, .friction = friction, .drive = Drive::free()}});
  }
  Clip clip;
  clip.name = "close";
  clip.duration = (far - 0.5) / speed;
  for (const auto& [name, side] : {std::pair{"left", -1.0}, std::pair{"right", 1.0}})
    clip.tracks.push_back(
        {name, "position", line({.from = {side * far, 0, 0}, .to = {side * 0.5, 0, 0}, .duration = clip.duration})});
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

}  // namespace

TEST_CASE("what two led bodies pinch gets no faster than they are, and an event tells of it") {
  for (const Solid& solid :
       {Solid{Sphere{0.25}}, Solid{Capsule{0.2, 0.25}}, Solid{Box{{0.25, 0.25, 0.25}}}, Solid{Cylinder{0.25, 0.25}}})
    for (const double rate : {60.0, 240.0, 1000.0})
      for (const double friction : {0.0, 0.5}) {
        CAPTURE(kind_name(solid));
        CAPTURE(rate);
        CAPTURE(friction);
        Stage stage(press(solid, rate, friction));
        double fastest = 0, spin = 0;
        while (stage.time() < 0.6) {
          stage.advance(1 / rate);
          fastest = std::max(fastest, stage.twist(2).linear.norm());
          spin = std::max(spin, stage.twist(2).angular.norm());
        }
        CHECK(fastest < 1.5 * speed);
        CHECK(spin < 20);
        CHECK(std::ranges::any_of(stage.events(), [](const StageEvent& event) { return event.name == "overlap"; }));
      }
}

TEST_CASE("rows that are pressed together store nothing that would throw them") {
  for (const Solid& solid : {Solid{Box{{0.25, 0.25, 0.25}}}, Solid{Box{{0.25, 0.4, 0.1}}}, Solid{Capsule{0.2, 0.25}}})
    for (const double rate : {60.0, 240.0, 1000.0})
      for (const double friction : {0.0, 0.5}) {
        CAPTURE(kind_name(solid));
        CAPTURE(rate);
        CAPTURE(friction);
        Stage stage(press(solid, rate, friction, 3));
        double fastest = 0;
        while (stage.time() < 2.3) {
          stage.advance(1 / rate);
          for (const NodeId node : {2, 3, 4}) fastest = std::max(fastest, stage.twist(node).linear.norm());
        }
        CHECK(fastest < 25 * speed);
      }
}
