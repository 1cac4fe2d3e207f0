#include "support.h"

#include <tweenfall/anim/graph_player.h>
#include <tweenfall/importers/document.h>
#include <tweenfall/importers/inputs.h>
#include <tweenfall/physics/stage/recording.h>

#include <string>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Stage staged(const std::string& name) {
  const auto file = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents" / (name + ".json");
  return Stage(Document::read(file).stage());
}

Vec3 place(const Stage& stage, const std::string& node) {
  return stage.world(stage.node(node)).motion.pose.position;
}

/// How far a node's own up axis leans from the vertical, degrees.
double lean(const Stage& stage, const std::string& node) {
  const Vec3 up = stage.world(stage.node(node)).motion.pose.rotation * Vec3(0, 1, 0);
  return std::acos(std::min(1.0, up.y())) * 180 / 3.14159265358979;
}

}  // namespace

TEST_CASE("the pendulum is let go, comes to rest and is taken back") {
  Stage stage = staged("pendulum");
  stage.advance_to(12);
  REQUIRE(stage.handoffs().size() >= 2);
  CHECK(stage.handoffs()[0].time == 0.4937);
  CHECK(near(stage.handoffs()[0].after.twist.linear, Vec3(-3.130215, -0.076643, 0), 1e-6));
  CHECK(stage.handoffs()[1].cause == Cause::asleep);
}

TEST_CASE("the bouncing ball leaves at its apex and its peaks fall by the square of its restitution") {
  Stage stage = staged("bouncing_ball");
  stage.advance_to(2.56);
  CHECK(stage.owner(stage.node("ball")) == Owner::free);
  CHECK(stage.twist(stage.node("ball")).linear.norm() < 1e-9);
  double peak = 0;
  bool down = false;
  while (stage.time() < 4.4) {
    stage.advance(1.0 / 240);
    const double height = place(stage, "ball").y() - 0.25;
    CHECK(height > -0.03);
    if (height < 0.1) down = true;
    if (down) peak = std::max(peak, height);
  }
  CHECK(peak == doctest::Approx(2.0 * 0.64).epsilon(0.03));
}

TEST_CASE("the hammer drives the row along and keeps to its path") {
  Stage stage = staged("hammer");
  const Vec3 first = place(stage, "box1"), last = place(stage, "box4");
  stage.advance_to(3);
  CHECK(place(stage, "box1").x() > first.x() + 0.1);
  CHECK(place(stage, "box4").x() > last.x() + 0.1);
  CHECK(place(stage, "box5").y() < 0.5);  // the one on top fell
  const NodeId head = stage.node("head");
  CHECK(near(stage.world(head).motion.pose.position, stage.path(head).at(3).pose.position, 1e-12));
  CHECK(stage.reaction(head).norm() > 1);
}

TEST_CASE("the door pushes what stands behind it and loses its sign at the slam") {
  Stage stage = staged("door");
  const Vec3 crate = place(stage, "crate");
  stage.advance_to(5);
  CHECK((place(stage, "crate") - crate).norm() > 0.1);
  CHECK(stage.owner(stage.node("sign")) == Owner::free);
  CHECK(place(stage, "sign").y() < 0.3);
  CHECK(stage.owner(stage.node("door")) == Owner::keyed);
}

TEST_CASE("the bowling ball knocks over turned pins that stood by themselves, and the top spins on") {
  Stage stage = staged("bowling");
  stage.advance_to(0.8);
  for (const char* pin : {"pin1", "pin3", "pin6"}) {
    CHECK(lean(stage, pin) < 0.1);
    CHECK(std::abs(place(stage, pin).y()) < 1e-3);
  }
  CHECK(stage.owner(stage.node("ball")) == Owner::free);
  stage.advance_to(3);
  int down = 0;
  for (const char* pin : {"pin1", "pin2", "pin3", "pin4", "pin5", "pin6"}) {
    down += lean(stage, pin) > 45;
    CHECK(place(stage, pin).y() > -0.01);
  }
  CHECK(down >= 4);
  CHECK(lean(stage, "top") < 30);
  CHECK(stage.twist(stage.node("top")).angular.norm() > 50);
}

TEST_CASE("the walker kicks boxes over and does not break its step") {
  Stage stage = staged("walker");
  stage.advance_to(4.4);
  int moved = 0;
  const StageDescription& description = stage.description();
  for (const NodeDescription& node : description.nodes)
    if (node.name.starts_with("box") &&
        ((place(stage, node.name) - node.rest.position).norm() > 0.1 || lean(stage, node.name) > 20))
      ++moved;
  CHECK(moved >= 4);
  const NodeId foot = stage.node("figure/LeftFoot");
  CHECK(near(stage.world(foot).motion.pose.position, stage.path(foot).at(4.4).pose.position, 1e-12));
}

TEST_CASE("the showcase holds all of it, and runs to the same bits twice") {
  Stage stage = staged("showcase"), again = staged("showcase");
  stage.advance_to(natural_length(stage.description()));
  while (again.time() < stage.time()) again.advance_to(std::min(stage.time(), again.time() + 1.0 / 60));
  CHECK(stage.state_hash() == again.state_hash());
  CHECK(stage.handoffs().size() >= 2);
  CHECK(stage.events().size() > 10);
}

TEST_CASE("the stroller stands, walks and waves as its inputs say, and stands again as before") {
  Stage stage = staged("stroller");
  const auto place_at = [&](double time, const char* node) {
    stage.seek(time);
    return place(stage, node);
  };
  const Vec3 foot = place_at(0.2, "figure/LeftFoot"), hand = place_at(0.2, "figure/RightHand");
  double most = 0;
  for (double time = 0.9; time < 1.5; time += 0.05)
    most = std::max(most, (place_at(time, "figure/LeftFoot") - foot).norm());
  CHECK(most > 0.15);
  CHECK(place_at(2.2, "figure/RightHand").y() > hand.y() + 0.3);
  CHECK(near(place_at(5.9, "figure/LeftFoot"), foot, 1e-9));
  CHECK(near(place_at(5.9, "figure/RightHand"), hand, 1e-6));
}

TEST_CASE("the crane hoists at the speed that its inputs ask for, and lets go where it reaches out") {
  Stage stage = staged("crane"), asked = staged("crane");
  const auto inputs =
      read_inputs(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/inputs/crane.json", asked.description());
  REQUIRE(inputs.size() == 3);
  stage.advance_to(1.4);
  static_cast<void>(advance_with(asked, inputs, 1.4));
  CHECK(place(stage, "crate").y() > place(asked, "crate").y() + 0.04);
  // Its reach takes half a second longer than its two seconds, because its speed comes up within the first.
  stage.advance_to(6);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(near(stage.handoffs()[0].time, 1.5 + 2.5, 1e-9));
}

TEST_CASE("the stroller walks on, greets and halts again when its inputs say so") {
  Stage stage = staged("stroller");
  const auto inputs =
      read_inputs(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/inputs/stroller.json", stage.description());
  REQUIRE(inputs.size() == 4);
  static_cast<void>(advance_with(stage, inputs, 4.3));
  const Vec3 hand = place(stage, "figure/RightHand");
  const GraphPlayer before = stage.graph("figure");
  CHECK(before.passages(0).back().state == 0);
  static_cast<void>(advance_with(stage, std::span(inputs).first(2), 5.3));
  CHECK(stage.graph("figure").passages(0).back().state == 1);
  CHECK(stage.graph("figure").passages(0).back().time == 4.4);
  CHECK(place(stage, "figure/RightHand").y() > hand.y() + 0.3);
  static_cast<void>(advance_with(stage, std::span(inputs).subspan(2), 8));
  CHECK(stage.graph("figure").passages(0).back().state == 0);
}
