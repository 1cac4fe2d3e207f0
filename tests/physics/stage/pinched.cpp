#include "physics/handoff/scenes.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/shape.h>

#include <algorithm>
#include <array>

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

TEST_CASE("whatever is squeezed out between led bodies is told of, and stays bounded") {
  const auto shape_of = [](std::uint64_t kind) -> Solid {
    if (kind == 0) return Sphere{0.25};
    if (kind == 1) return Box{{0.25, 0.25, 0.25}};
    if (kind == 2) return Capsule{0.2, 0.25};
    return Cylinder{0.25, 0.25};
  };
  const auto jaw_of = [](std::uint64_t kind) -> Solid {
    if (kind == 0) return Sphere{0.5};
    if (kind == 1) return Capsule{0.5, 0.5};
    return Cylinder{0.5, 0.5};
  };
  Random random(17);
  int exploded = 0;
  double most = 0;
  for (int i = 0; i < 120; ++i) {
    CAPTURE(i);
    const double rate = std::array{60.0, 240.0, 1000.0}[static_cast<std::size_t>(i % 3)];
    const int count = 1 + i / 3 % 3;
    const bool chained = i % 2 == 0;
    StageDescription described = press(shape_of(random.bits() % 4), rate, i % 4 < 2 ? 0 : 0.5, count);
    const Solid jaw = jaw_of(random.bits() % 3);
    for (const NodeId node : {0, 1}) described.nodes[node].body->shape.solid = jaw;
    for (int k = 0; k < count; ++k) {
      NodeDescription& node = described.nodes[static_cast<std::size_t>(2 + k)];
      node.rest.position += random.vector(0.02);
      node.body->mass = random.between(0.5, 2);
      if (!chained || k == 0) continue;
      JointDescription joint{.name = "j" + std::to_string(k)};
      joint.a = static_cast<std::size_t>(1 + k);
      joint.b = static_cast<std::size_t>(2 + k);
      joint.frame_a.position = {0.3, 0, 0};
      joint.frame_b.position = {-0.3, 0, 0};
      described.joints.push_back(joint);
    }
    Stage stage(described);
    double fastest = 0;
    while (stage.time() < 0.6 + 0.8 * count) {
      stage.advance(1 / rate);
      for (int k = 0; k < count; ++k)
        fastest = std::max(fastest, stage.twist(static_cast<NodeId>(2 + k)).linear.norm());
    }
    const bool told = std::ranges::any_of(stage.events(), [](const StageEvent& event) {
      return event.name == "squeezed" || event.name == "overlap" || event.name == "joint_strained";
    });
    most = std::max(most, fastest);
    if (!(fastest > 3.3 * speed)) continue;
    ++exploded;
    CHECK(told);
  }
  MESSAGE(exploded << " of 120 presses explode, the fastest at " << most / speed << " times their speed");
  CHECK(exploded > 20);
  // A light body may get the energy of one four times as heavy.
  CHECK(most < 2.1 * 10 * speed);
}

TEST_CASE("a ball pinched between balls that close leaves with ten times their speed at most, and is told of") {
  Random random(3);
  double most = 0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    StageDescription described = press(Sphere{0.25}, 1000, 0);
    for (const NodeId node : {0, 1}) described.nodes[node].body->shape.solid = Sphere{0.5};
    // The nearer the three are to one line, the faster rigid bodies would make it leave.
    described.nodes[2].rest = {.position = random.vector(0.02)};
    Stage stage(described);
    double fastest = 0;
    while (stage.time() < 0.6) {
      stage.advance(1e-3);
      fastest = std::max(fastest, stage.twist(2).linear.norm());
    }
    most = std::max(most, fastest);
    if (!(fastest > 3 * speed)) continue;
    const auto told = std::ranges::find(stage.events(), "squeezed", &StageEvent::name);
    REQUIRE(told != stage.events().end());
    CHECK(told->nodes == std::vector<NodeId>{2});
    CHECK(told->data.starts_with("{\"speed\": "));
  }
  // It may still touch one of them afterwards.
  CHECK(most > 9.9 * speed);
  CHECK(most < 10.1 * speed);
}
