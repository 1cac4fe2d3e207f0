#include "physics/handoff/scenes.h"

#include <tweenfall/curves/expression.h>
#include <tweenfall/physics/stage/detail.h>

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A ball that falls from 2 m through a zone between 0.4 and 0.6 m, and a gate that waits.
StageDescription gate() {
  StageDescription stage;
  stage.nodes = {
      {.name = "zone",
       .rest = {.position = {0, 0.5, 0}},
       .body = BodyDescription{.shape = {Box{{1, 0.1, 1}}}, .sensor = true, .fixed = true}},
      {.name = "ball", .rest = {.position = {0, 2, 0}}, .body = BodyDescription{.shape = {Sphere{0.05}}, .mass = 1.0}},
      {.name = "gate",
       .rest = {.position = {3, 1, 0}},
       .body = BodyDescription{.shape = {Box{{0.1, 1, 1}}}, .mass = 5.0, .drive = Drive::keyed()}},
      {.name = "other",
       .rest = {.position = {0.5, 9, 0}},
       .body = BodyDescription{.shape = {Sphere{0.05}}, .mass = 1.0}}};
  return stage;
}

double time_of_fall(double way) {
  return std::sqrt(2 * way / standard_gravity);
}

}  // namespace

TEST_CASE("what comes into a sensor and leaves it is told at the end of its step, by the sensor and the body") {
  Stage stage(gate());
  std::vector<StageEvent> heard;
  stage.on_event([&](const StageEvent& event) { heard.push_back(event); });
  stage.advance_to(1);
  REQUIRE(heard.size() == 2);
  CHECK(heard[0].name == "entered");
  CHECK(heard[0].nodes == std::vector<NodeId>{0, 1});
  CHECK(heard[0].time >= time_of_fall(1.35));
  CHECK(heard[0].time <= time_of_fall(1.35) + stage.step());
  CHECK(heard[1].name == "left");
  CHECK(heard[1].time >= time_of_fall(1.65));
  CHECK(heard[1].time <= time_of_fall(1.65) + stage.step());
  // A removed body has not left.
  Stage again(gate());
  again.advance_to(time_of_fall(1.5));
  again.remove(1);
  again.advance_to(1);
  CHECK(std::ranges::count(again.events(), std::string("left"), &StageEvent::name) == 0);
}

TEST_CASE("a rule waits for its own body or another to come into a sensor, or to leave it") {
  StageDescription description = gate();
  description.rules = {{.bodies = {"gate"}, .when = {{when::Enter{"zone", "ball"}}}, .to = Drive::free()},
                       {.bodies = {"ball"}, .when = {{when::Leave{"zone", ""}}}, .to = {.hz = 2}},
                       {.bodies = {"other"}, .when = {{when::At{0.1}, when::Enter{"z*", "b*"}}, true}, .to = {.hz = 1}},
                       {.bodies = {"gate"}, .when = {{when::Enter{"zone", ""}}}, .to = {.hz = 5}}};
  Stage stage(description);
  stage.advance_to(1);
  REQUIRE(stage.handoffs().size() == 3);
  const auto taken = [&](std::size_t i) { return std::pair(stage.handoffs()[i].node, stage.handoffs()[i].cause); };
  CHECK(taken(0) == std::pair<std::size_t, Cause>{2, Cause::enter});
  CHECK(taken(1) == std::pair<std::size_t, Cause>{3, Cause::enter});
  CHECK(taken(2) == std::pair<std::size_t, Cause>{1, Cause::leave});
  REQUIRE(stage.unfired_rules().size() == 1);
  CHECK(stage.unfired_rules()[0].reason == "the body did not come into \"zone\" while it waited");
}

TEST_CASE("a rule waits for a drive to be at its limit, and for a body to be off its path") {
  StageDescription description;
  description.nodes = {{.name = "lift",
                        .body = BodyDescription{
                            .shape = {Sphere{0.1}}, .mass = 2.0, .drive = Drive{.hz = 4, .zeta = 1, .max_force = 15}}}};
  description.rules = {{.bodies = {"lift"}, .when = {{when::Error{0.5}}}, .to = Drive::free()}};
  // It can carry 15 N of 19.62 N: it sinks with (19.62 - 15) / 2 = 2.31 m/s^2, and is 0.5 m off after sqrt(1 / 2.31) s.
  Stage stage(description);
  stage.advance_to(1);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(stage.handoffs()[0].cause == Cause::error);
  CHECK(stage.handoffs()[0].time == doctest::Approx(std::sqrt(1 / 2.31)).epsilon(0.02));

  description.rules = {{.bodies = {"lift"}, .when = {{when::Saturated{0.25}}}, .to = Drive::free()}};
  Stage limited(description);
  limited.advance_to(1);
  REQUIRE(limited.handoffs().size() == 1);
  CHECK(limited.handoffs()[0].cause == Cause::saturated);
  CHECK(limited.handoffs()[0].time > 0.25);
  CHECK(limited.handoffs()[0].time < 0.4);

  description.nodes[0].body->drive->max_force = 30;
  Stage strong(description);
  strong.advance_to(1);
  CHECK(strong.handoffs().empty());
  CHECK(strong.unfired_rules()[0].reason == "its drive was at its limit for 0 s at most; the rule waits for 0.25 s");
}

TEST_CASE("pairs pass through each other, in the description and while the stage runs") {
  StageDescription description;
  description.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                       {.name = "ball",
                        .rest = {.position = {0, 0.5, 0}},
                        .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
  description.ignored = {{0, 1}};
  Stage stage(description);
  stage.advance_to(1);
  CHECK(near(stage.world(1).motion.pose.position.y(), 0.5 - standard_gravity / 2, 1e-9));
  stage.seek(0.1);
  CHECK_FALSE(stage.collides(0, 1));
  stage.collide(0, 1);
  stage.advance_to(1);
  CHECK(near(stage.world(1).motion.pose.position.y(), 0.1, 1e-3));
  CHECK_THROWS_AS(stage.ignore(1, 1), std::invalid_argument);
  description.ignored = {{0, 5}};
  CHECK_THROWS_AS(Stage{description}, std::invalid_argument);
}

TEST_CASE("a joint that comes while the stage runs holds, is read by its name, and goes") {
  StageDescription description;
  description.nodes = {
      {.name = "bob", .rest = {.position = {0, 2, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
  Stage stage(description);
  stage.advance_to(0.1234);
  const NodeId late = stage.add(
      {.name = "late", .rest = {.position = {1, 2, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}});
  const JointDescription rope{
      .name = "rope", .b = late, .frame_a = {.position = {1, 3, 0}}, .kind = DistanceJoint{{0, 1}}};
  stage.add_joint(rope);
  CHECK_THROWS_AS(stage.add_joint(rope), std::invalid_argument);
  stage.advance_to(1);
  CHECK(near(stage.world(late).motion.pose.position, Vec3(1, 2, 0), 1e-4));
  CHECK(near(stage.joint("rope")->force.norm(), standard_gravity, 1e-3));
  stage.remove_joint("rope");
  CHECK_FALSE(stage.joint("rope"));
  stage.advance_to(1.2);
  CHECK(stage.world(late).motion.pose.position.y() < 1.9);
  // The name of a removed one is free.
  stage.add_joint({.name = "rope", .a = 0, .b = late, .kind = SpringJoint{1, 10, 0}});
  CHECK(stage.joint("rope"));
  stage.remove(late);
  CHECK_FALSE(stage.joint("rope"));
  const std::uint64_t hash = stage.state_hash();
  stage.seek(0.5);
  stage.seek(1.2);
  CHECK(stage.state_hash() == hash);
}

TEST_CASE("the detail of a stage tells contacts, islands, sleep and boxes by nodes") {
  StageDescription description;
  description.world.sleep_after = 0.2;
  description.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}}};
  for (int i = 0; i < 4; ++i)
    description.nodes.push_back({.name = "box" + std::to_string(i),
                                 .rest = {.position = {i < 2 ? 0.0 : 5.0 * i, i == 1 ? 0.6 : 0.2, 0}},
                                 .body = BodyDescription{.shape = {Box{{0.2, 0.2, 0.2}}}, .mass = 1.0}});
  description.nodes[4].rest.position.y() = 50;
  Stage stage(description);
  stage.advance_to(0.1);
  const StageDetail detail = detail_of(stage);
  REQUIRE(detail.nodes.size() == 5);
  CHECK(detail.nodes[0].island == no_node);
  CHECK(detail.nodes[1].island == 1);
  CHECK(detail.nodes[2].island == 1);
  CHECK(detail.nodes[3].island == 3);
  CHECK(detail.nodes[4].island == 4);
  CHECK(detail.contacts.size() == 12);  // four corners of each of three
  for (const ContactDetail& contact : detail.contacts) {
    CHECK(near(contact.normal, Vec3(0, 1, 0), 1e-6));
    CHECK(contact.impulse > 0);
    CHECK(contact.a < contact.b);
  }
  for (const NodeDetail& node : detail.nodes) {
    CHECK_FALSE(node.asleep);
    const Vec3 place = stage.world(node.node).motion.pose.position;
    CHECK((node.box.low.array() <= place.array()).all());
    CHECK((node.box.high.array() >= place.array()).all());
  }
  stage.advance_to(1);
  CHECK(detail_of(stage).nodes[1].asleep);
  CHECK_FALSE(detail_of(stage).nodes[4].asleep);
}

TEST_CASE("a rule at the peak of the speed acts when the path is as fast as it gets, once for each swing") {
  for (const double step : {1.0 / 60, 1.0 / 240}) {
    StageDescription description;
    description.step = step;
    description.world.gravity.setZero();
    description.nodes = {{.name = "arm"},
                         {.name = "ball",
                          .parent = 0,
                          .rest = {.position = {0, 1, 0}},
                          .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
    // x = cos(5 t): the speed is greatest at a quarter of a swing, 5 m/s.
    description.clips = {{.name = "swing",
                          .duration = 10,
                          .tracks = {{"arm", "position",
                                      parametric(oscillator({.amplitude = 1, .hz = 5 / (2 * pi)}), Curve<double>(0.0),
                                                 Curve<double>(0.0))}}}};
    description.plays = {{.clip = 0}};
    description.rules = {{.bodies = {"ball"}, .when = {{when::SpeedPeak{}}}, .to = Drive::free()}};
    Stage stage(description);
    stage.advance_to(1);
    REQUIRE(stage.handoffs().size() == 1);
    CHECK(stage.handoffs()[0].cause == Cause::speed_peak);
    CHECK(near(stage.handoffs()[0].time, pi / 10, 1e-8));
    CHECK(near(stage.handoffs()[0].after.twist.linear, Vec3(-5, 0, 0), 1e-9));
  }
}

TEST_CASE("an even speed, one that only rises and one that only falls have no peak") {
  const auto handoffs = [](const Curve<double>& x) {
    StageDescription description;
    description.nodes = {{.name = "ball", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}}};
    description.clips = {{.name = "way",
                          .duration = 2,
                          .tracks = {{"ball", "position", parametric(x, Curve<double>(0.0), Curve<double>(0.0))}}}};
    description.plays = {{.clip = 0}};
    description.rules = {{.bodies = {"ball"}, .when = {{when::SpeedPeak{}}}, .to = Drive::free()}};
    Stage stage(description);
    stage.advance_to(1.5);
    return stage.handoffs().size();
  };
  CHECK(handoffs(expression_curve(Expression("2*t"))) == 0);
  CHECK(handoffs(expression_curve(Expression("t^2"))) == 0);
  CHECK(handoffs(expression_curve(Expression("4*t - t^2"))) == 0);
  CHECK(handoffs(expression_curve(Expression("t^2*(1.2 - t/3)"))) == 1);
}

TEST_CASE("the contacts of what goes fast are told where it is after the step, and not where it was") {
  StageDescription description;
  description.step = 1.0 / 60;
  description.nodes = {
      {.name = "floor", .body = BodyDescription{.shape = {Box{{500, 0.5, 500}}}, .friction = 0, .fixed = true}},
      {.name = "sled",
       .rest = {.position = {0, 0.8, 0}},
       .body = BodyDescription{.shape = {Box{{0.4, 0.3, 0.5}}}, .friction = 0, .twist = {.linear = {30, 0, 0}}}},
      {.name = "rider",
       .rest = {.position = {0, 1.2, 0}},
       .body = BodyDescription{.shape = {Box{{0.2, 0.1, 0.2}}}, .friction = 0, .twist = {.linear = {30, 0, 0}}}}};
  Stage stage(description);
  stage.advance_to(1);
  const double x = stage.world(1).motion.pose.position.x();
  CHECK(x > 29);
  int on_rider = 0;
  for (const ContactDetail& contact : detail_of(stage).contacts) {
    const bool rides = contact.a == 2 || contact.b == 2;
    on_rider += rides ? 1 : 0;
    CHECK(std::abs(std::abs(contact.point.x() - x) - (rides ? 0.2 : 0.4)) < 1e-6);
  }
  CHECK(on_rider == 4);
}
