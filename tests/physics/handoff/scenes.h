#pragma once

// The bodies and paths that the hand-off tests share.

#include "support.h"

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/stage.h>

#include <cmath>
#include <numbers>

namespace tweenfall::test {

inline constexpr double standard_gravity = 9.81;
/// The steps at which every hand-off must give the same result.
inline constexpr double compared_steps[] = {1.0 / 30, 1.0 / 60, 1.0 / 240};

/// Scenario 1: theta(t) = cos(sqrt(9.81) t) rad about z, 1 m below a pivot at y = 2.
inline StageDescription pendulum(double step) {
  StageDescription stage;
  stage.step = step;
  stage.nodes = {{.name = "pivot", .rest = {.position = {0, 2, 0}}},
                 {.name = "bob",
                  .parent = 0,
                  .rest = {.position = {0, -1, 0}},
                  .body = BodyDescription{.shape = {Sphere{0.05}}, .mass = 0.5}}};
  Clip swing;
  swing.name = "swing";
  swing.duration = std::numeric_limits<double>::infinity();
  swing.tracks = {{"pivot", "rotation",
                   axis_curve({0, 0, 1}, oscillator({.amplitude = 1,
                                                     .hz = std::sqrt(standard_gravity) / (2 * std::numbers::pi)}))}};
  stage.clips = {swing};
  stage.plays = {{.clip = 0}};
  return stage;
}

/// A body on a curve that swings and tumbles, its center of mass off the node's origin.
inline StageDescription tumbler(double step) {
  StageDescription stage;
  stage.step = step;
  stage.nodes = {
      {.name = "arm", .rest = {.position = {0, 3, 0}}},
      {.name = "body",
       .parent = 0,
       .rest = {.position = {0.4, 0, 0.1}},
       .body = BodyDescription{.shape = {Box{{0.1, 0.2, 0.15}}, {.position = {0.3, -0.2, 0.1}}}, .mass = 2.0}}};
  Random random(7);
  std::vector<Key<Vec3>> places;
  std::vector<Key<Quat>> turns, own;
  for (int i = 0; i <= 6; ++i) {
    places.push_back({.time = 0.4 * i, .value = Vec3(0, 3, 0) + random.vector(0.5), .ease = Ease::smooth()});
    turns.push_back({.time = 0.4 * i, .value = random.rotation(), .ease = Ease::smooth()});
    own.push_back({.time = 0.4 * i, .value = random.rotation(), .ease = Ease::smooth()});
  }
  Clip clip;
  clip.name = "tumble";
  clip.duration = 2.4;
  clip.tracks = {{"arm", "position", keyed_curve<Vec3>(places)},
                 {"arm", "rotation", keyed_curve<Quat>(turns)},
                 {"body", "rotation", keyed_curve<Quat>(own)}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

inline Rule release_at(double time, const std::string& body, const TakeOver& take_over = {}) {
  Rule rule;
  rule.bodies = {body};
  rule.when.triggers = {when::At{time}};
  rule.to = Drive::free();
  rule.take_over = take_over;
  return rule;
}

inline Rule recover_at(double time, const std::string& body, const HandBack& hand_back = {}) {
  Rule rule;
  rule.bodies = {body};
  rule.when.triggers = {when::At{time}};
  rule.to = Drive::keyed();
  rule.hand_back = hand_back;
  return rule;
}

/// Position of the center of mass.
inline Vec3 center(const Pose& pose, const Vec3& local) {
  return pose.position + pose.rotation * local;
}

}  // namespace tweenfall::test
