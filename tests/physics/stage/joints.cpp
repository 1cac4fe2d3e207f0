#include "support.h"

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/stage/recording.h>

#include <cmath>

namespace tweenfall::jointed_stage {

using namespace tweenfall::test;

namespace {

constexpr double g = 9.81;

NodeDescription ball_at(const std::string& name, const Vec3& place, double mass = 1) {
  return {.name = name, .rest = {.position = place}, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = mass}};
}

/// A joint at a point, between nodes that are roots, at rest.
JointDescription joint_at(const StageDescription& stage, const std::string& name, std::size_t a, std::size_t b,
                          const Vec3& point, const JointKind& kind, const Vec3& axis = Vec3(0, 0, 1)) {
  const JointFrames frames =
      joint_frames(a == no_node ? Pose{} : stage.nodes[a].rest, stage.nodes[b].rest, point, axis);
  return {.name = name, .a = a, .b = b, .frame_a = frames.a, .frame_b = frames.b, .kind = kind};
}

/// A hand that swings back and forth at height 2 and a bob 1 m below it.
StageDescription hung() {
  StageDescription stage;
  stage.nodes = {ball_at("hand", Vec3(0, 2, 0)), ball_at("bob", Vec3(0, 1, 0), 2)};
  stage.joints = {joint_at(stage, "string", 0, 1, Vec3(0, 2, 0), BallJoint{})};
  stage.joints[0].collide = false;
  Clip clip;
  clip.name = "wave";
  clip.duration = 4;
  clip.tracks = {{"hand", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = {0, 2, 0}},
                                     {.time = 1, .value = {0.3, 2, 0}},
                                     {.time = 2, .value = {0, 2.2, 0}},
                                     {.time = 4, .value = {0, 2, 0}}})}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

Rule handed(const std::string& body, double time, const Drive& to) {
  Rule rule;
  rule.bodies = {body};
  rule.when.triggers = {when::At{time}};
  rule.to = to;
  return rule;
}

std::vector<std::string> faults_in(const StageDescription& stage) {
  std::vector<std::string> out;
  for (const StageFault& fault : inspect(stage).faults) {
    CHECK(fault.part == StageFault::Part::joint);
    out.push_back(std::to_string(fault.index) + " " + fault.message);
  }
  return out;
}

}  // namespace

TEST_CASE("a joint holds a free body to a keyed one, and goes on holding when its ends change hands") {
  StageDescription described = hung();
  described.rules = {handed("bob", 1.0, {.hz = 1}), handed("bob", 1.5, Drive::free()),
                     handed("hand", 2.5, Drive::free()), handed("bob", 2.0, Drive::keyed()),
                     handed("bob", 2.25, Drive::free())};
  Stage stage(described);
  const NodeId hand = stage.node("hand"), bob = stage.node("bob");
  int held = 0;
  for (int i = 1; i <= 240 * 3; ++i) {
    stage.advance_to(i / 240.0);
    const std::optional<JointReading> reading = stage.joint("string");
    REQUIRE(reading);
    const bool both_keyed = stage.owner(hand) == Owner::keyed && stage.owner(bob) == Owner::keyed;
    if (both_keyed) {
      // Between two bodies that follow their paths it does nothing, once a step has shown this.
      if (stage.time() > 2 + 1.5 / 240) CHECK(reading->force.norm() == 0);
      continue;
    }
    if (stage.time() > 2 && stage.time() < 2.5) continue;  // it is pulled together again
    CHECK(reading->gap < 1e-4);
    ++held;
    const Motion at = stage.world(bob).motion;
    const Vec3 end = at.pose.position + at.pose.rotation * described.joints[0].frame_b.position;
    CHECK((end - stage.world(hand).motion.pose.position).norm() == doctest::Approx(0).epsilon(1e-4));
  }
  CHECK(held > 400);
  // At the end both fall.
  CHECK(stage.owner(hand) == Owner::free);
  CHECK(stage.handoffs().size() == 5);
}

TEST_CASE("the force that a joint tells carries what hangs on it, from the first step on") {
  StageDescription described = hung();
  described.plays.clear();
  described.nodes[0].body->drive = Drive::keyed();
  Stage stage(described);
  CHECK(stage.joint("string")->force.norm() == 0);
  stage.advance_to(0.1);
  CHECK(stage.joint("string")->force.y() == doctest::Approx(2 * g).epsilon(1e-6));
  CHECK_THROWS_WITH((void)stage.joint("strnig"), "there is no joint \"strnig\"; did you mean \"string\"?");
}

TEST_CASE("a joint that breaks is told with its bodies, once, and read no more") {
  StageDescription described = hung();
  described.plays.clear();
  described.nodes[0].body->drive = Drive::keyed();
  for (const double part : {0.99, 1.01}) {
    described.joints[0].break_force = 2 * g / part;
    Stage stage(described);
    std::vector<StageEvent> told, contacts;
    stage.on_event([&](const StageEvent& event) { told.push_back(event); });
    stage.on_contact([&](const StageEvent& event) { contacts.push_back(event); });
    stage.advance_to(1);
    CHECK(contacts.empty());
    REQUIRE(told.size() == (part > 1 ? 1 : 0));
    CHECK(stage.joint("string").has_value() == (part < 1));
    if (part < 1) continue;
    CHECK(told[0].name == "joint_broke");
    CHECK(told[0].joint == "string");
    CHECK(told[0].nodes == std::vector<NodeId>{0, 1});
    CHECK(told[0].time == doctest::Approx(1.0 / 240));
    CHECK(stage.world(1).motion.pose.position.y() == doctest::Approx(1 - g / 2).epsilon(0.01));
    // Back before it broke, it holds.
    stage.seek(0);
    CHECK(stage.joint("string"));
  }
}

TEST_CASE("joints that are added while a recording runs are in it, from the frame on in which they are there") {
  StageDescription stage;
  stage.nodes = {ball_at("hook", Vec3(0, 2, 0)), ball_at("bob", Vec3(0, 1, 0), 2), ball_at("other", Vec3(3, 1, 0))};
  stage.nodes[0].body->drive = Drive::keyed();
  stage.nodes[1].body->drive = stage.nodes[2].body->drive = Drive::free();
  Clip clip;
  clip.name = "cues";
  clip.duration = 1;
  clip.events = {{0.25, 0.25, "tie", ""}, {0.5, 0.5, "untie", ""}, {0.75, 0.75, "tie other", ""}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  JointDescription string = joint_at(stage, "string", 0, 1, Vec3(0, 2, 0), DistanceJoint{0, 5});
  JointDescription other = joint_at(stage, "string", 0, 2, Vec3(0, 2, 0), DistanceJoint{0, 5});
  Stage run(stage);
  run.on_event([&](const StageEvent& event) {
    if (event.name == "tie") run.add_joint(string);
    if (event.name == "untie") run.remove_joint("string");
    if (event.name == "tie other") run.add_joint(other);
  });
  const Recording recording = record(run, 1, 100);
  REQUIRE(recording.times.size() == 101);
  REQUIRE(recording.joints.size() == 2);
  const auto there = [&](std::size_t joint, std::size_t frame) {
    return recording.joints[joint].reading[frame].has_value();
  };
  for (const JointRecord& joint : recording.joints) {
    CHECK(joint.name == "string");
    CHECK(joint.a == 0);
    REQUIRE(joint.reading.size() == 101);
  }
  CHECK(recording.joints[0].b == 1);
  CHECK(recording.joints[1].b == 2);
  for (std::size_t frame = 0; frame <= 100; ++frame) {
    CAPTURE(frame);
    if (frame != 25 && frame != 50) CHECK(there(0, frame) == (frame > 25 && frame < 50));
    if (frame != 75) CHECK(there(1, frame) == (frame > 75));
  }
}

TEST_CASE("a joint ends at its instant, off the grid, and what it held flies as if it had ended there") {
  StageDescription described = hung();
  described.plays.clear();
  described.nodes[0].body->drive = Drive::keyed();
  described.joints[0].until = when::At{0.31415};
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    described.step = step;
    Stage stage(described);
    stage.advance_to(0.8);
    CHECK_FALSE(stage.joint("string"));
    REQUIRE(stage.events().size() == 1);
    CHECK(stage.events()[0].name == "joint_ended");
    CHECK(stage.events()[0].time == 0.31415);
    const double fall = 0.8 - 0.31415;
    CHECK(stage.world(1).motion.pose.position.y() == doctest::Approx(1 - g / 2 * fall * fall).epsilon(1e-9));
  }
}

TEST_CASE("a joint ends at an event of a clip") {
  StageDescription described = hung();
  described.clips[0].events = {{.from = 1.3, .to = 1.3, .name = "let go", .data = {}}};
  described.joints[0].until = when::Event{"let go"};
  Stage stage(described);
  stage.advance_to(1.29);
  CHECK(stage.joint("string"));
  stage.advance_to(1.3);
  CHECK_FALSE(stage.joint("string"));
}

TEST_CASE("a stage with joints runs to the same bits in any frames, and after going back") {
  StageDescription described = hung();
  described.rules = {handed("hand", 1.23456, Drive::free())};
  described.joints[0].break_torque = 1e9;
  Stage whole(described), parts(described);
  whole.advance_to(2);
  while (parts.time() < 2) parts.advance_to(std::min(2.0, parts.time() + 0.0123));
  CHECK(whole.state_hash() == parts.state_hash());
  whole.seek(0.5);
  whole.advance_to(2);
  CHECK(whole.state_hash() == parts.state_hash());
  Stage loose = Stage(hung());
  loose.advance_to(2);
  CHECK(whole.state_hash() != loose.state_hash());
}

TEST_CASE("joints that hold nothing together are refused, each by its number and name") {
  StageDescription stage = hung();
  stage.nodes.push_back({.name = "bare"});
  const JointDescription good = stage.joints[0];
  const auto add = [&](auto change) {
    JointDescription bad = good;
    bad.name = "j" + std::to_string(stage.joints.size());
    change(bad);
    stage.joints.push_back(bad);
  };
  add([](JointDescription& joint) { joint.a = 2; });
  add([](JointDescription& joint) { joint.a = joint.b; });
  add([](JointDescription& joint) { joint.b = 17; });
  add([](JointDescription& joint) { joint.b = no_node; });
  add([](JointDescription& joint) { joint.name = "string"; });
  add([](JointDescription& joint) { joint.kind = HingeJoint{.limits = Limits{1, -1}}; });
  add([](JointDescription& joint) { joint.until = when::At{std::nan("")}; });
  CHECK(faults_in(stage) ==
        std::vector<std::string>{
            "1 the joint \"j1\": \"bare\" has no body to hold",
            "2 the joint \"j2\": it needs two bodies, but both ends are \"bob\"",
            "3 the joint \"j3\": there is no node number 17 to hold",
            "4 the joint \"j4\": its second end needs a body: only the first may be the world",
            "5 the joint \"string\": another joint has this name",
            "6 the joint \"j6\": limits of a hinge must be in order, but the low one is 1 and the high one -1",
            "7 the joint \"j7\": the time until which it holds must be a number"});
  CHECK_THROWS_AS(Stage{stage}, std::invalid_argument);
}

TEST_CASE("a body that leaves takes its joints along, without an event") {
  StageDescription described = hung();
  Stage stage(described);
  stage.advance_to(0.5);
  stage.remove(0);
  CHECK_FALSE(stage.joint("string"));
  stage.advance_to(1);
  CHECK(stage.events().empty());
  CHECK(stage.owner(1) == Owner::free);
}

TEST_CASE("what starts apart, turned or beyond its limits is found, and what starts as held is not") {
  StageDescription stage;
  stage.nodes = {ball_at("a", Vec3(0, 1, 0)), ball_at("b", Vec3(1, 1, 0))};
  const Vec3 middle(0.5, 1, 0);
  const auto add = [&](const JointKind& kind, const Quat& turn = Quat(1, 0, 0, 0), const Vec3& away = Vec3(0, 0, 0)) {
    JointDescription joint = joint_at(stage, "j" + std::to_string(stage.joints.size()), 0, 1, middle, kind);
    joint.frame_b.rotation = joint.frame_b.rotation * turn;
    joint.frame_b.position += away;
    stage.joints.push_back(joint);
  };
  const auto about = [](const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); };
  add(BallJoint{});
  add(BallJoint{}, about(Vec3(0, 1, 0), 2));
  add(BallJoint{}, Quat(1, 0, 0, 0), Vec3(0, 0.3, 0));
  add(FixedJoint{}, about(Vec3(0, 1, 0), 0.25));
  add(HingeJoint{.limits = Limits{-0.2, 0.1}}, about(Vec3(1, 0, 0), 0.05));
  add(HingeJoint{.limits = Limits{-0.2, 0.1}}, about(Vec3(1, 0, 0), 0.5));
  add(HingeJoint{}, about(Vec3(0, 0, 1), 0.125));
  add(SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.2, .twist = {-1, 1}}, about(Vec3(0, 1, 0), 0.4));
  add(SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.2, .twist = {-1, 1}}, about(Vec3(0, 0, 1), 0.4));
  add(DistanceJoint{.limits = {0, 0.5}}, Quat(1, 0, 0, 0), Vec3(0, 0.75, 0));
  const StageInspection found = inspect(stage);
  REQUIRE(found.faults.empty());
  REQUIRE(found.open_joints.size() == 3);
  CHECK(found.open_joints[0].joint == 2);
  CHECK(found.open_joints[0].gap == doctest::Approx(0.3));
  CHECK(found.open_joints[1].joint == 3);
  CHECK(found.open_joints[1].turn == doctest::Approx(0.25));
  CHECK(found.open_joints[2].joint == 6);
  CHECK(found.open_joints[2].turn == doctest::Approx(0.125));
  REQUIRE(found.passed_limits.size() == 3);
  CHECK(found.passed_limits[0].joint == 5);
  CHECK(found.passed_limits[0].position == doctest::Approx(0.5));
  CHECK(found.passed_limits[1].joint == 8);
  CHECK(found.passed_limits[1].coordinate == 2);
  CHECK(found.passed_limits[1].high == doctest::Approx(0.2));
  CHECK(found.passed_limits[2].joint == 9);
  CHECK(found.passed_limits[2].length);
}

TEST_CASE("joints that turn each other out of what they allow are told, whatever their kind") {
  const auto strained = [](const JointKind& one, const JointKind& other, const Quat& turn) {
    StageDescription stage;
    stage.world.gravity.setZero();
    stage.nodes = {ball_at("a", Vec3(0, 0, 0))};
    for (const JointKind& kind : {one, other}) {
      JointDescription joint{.name = stage.joints.empty() ? "one" : "other", .b = 0, .kind = kind};
      if (!stage.joints.empty()) joint.frame_a.rotation = turn;
      stage.joints.push_back(joint);
    }
    Stage running(stage);
    running.advance_to(0.5);
    return std::ranges::count(running.events(), "joint_strained", &StageEvent::name);
  };
  const Quat about_y(std::cos(0.4), 0, std::sin(0.4), 0), none = Quat::Identity();
  const SwingTwistJoint limb{.swing_y = 0.1, .swing_z = 0.1, .twist = {-1, 1}};
  CHECK(strained(FixedJoint{}, FixedJoint{}, about_y) > 0);
  CHECK(strained(HingeJoint{}, HingeJoint{}, about_y) > 0);
  CHECK(strained(SliderJoint{}, SliderJoint{}, about_y) > 0);
  CHECK(strained(limb, limb, about_y) > 0);
  CHECK(strained(FixedJoint{}, FixedJoint{}, none) == 0);
  CHECK(strained(HingeJoint{}, FixedJoint{}, none) == 0);
  CHECK(strained(UniversalJoint{}, HingeJoint{}, none) == 0);
  CHECK(strained(limb, limb, Quat(std::cos(0.05), 0, std::sin(0.05), 0)) == 0);
}

}  // namespace tweenfall::jointed_stage
