#include "physics/handoff/scenes.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/shape.h>

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double speed = 0.8;  // m/s, of each of the two

/// A body a little askew between two boxes that are led toward each other, from 3 m apart until they meet.
StageDescription press(const Solid& solid, double rate, double friction) {
  StageDescription stage;
  stage.step = 1 / rate;
  stage.world.gravity.setZero();
  const auto jaw = [&](const char* name, double x) {
    return NodeDescription{.name = name,
                           .rest = {.position = {x, 0, 0}},
                           .body = BodyDescription{.shape = {Box{{0.5, 1, 1}}}, .friction = friction}};
  };
  Pose askew{.position = Vec3(0.01, 0.003, 0.002)};
  askew.rotation = exp_map(Vec3(0.05, 0.09, 0.12));
  stage.nodes = {
      jaw("left", -1),
      jaw("right", 1),
      {.name = "b",
       .rest = askew,
       .body = BodyDescription{.shape = {solid}, .mass = 1.0, .friction = friction, .drive = Drive::free()}}};
  Clip clip;
  clip.name = "close";
  clip.duration = 0.5 / speed;
  for (const auto& [name, x] : {std::pair{"left", -1.0}, std::pair{"right", 1.0}})
    clip.tracks.push_back(
        {name, "position", line({.from = {x, 0, 0}, .to = {0.5 * x, 0, 0}, .duration = 0.5 / speed})});
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
