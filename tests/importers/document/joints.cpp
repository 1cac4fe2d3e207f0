#include "importers/document/document_files.h"

#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/recording.h>

#include <nlohmann/json.hpp>

namespace tweenfall::document_joints {

using namespace tweenfall::test;

namespace {

const JointDescription& joint_named(const Document& document, const std::string& name) {
  for (const JointDescription& joint : document.stage().joints)
    if (joint.name == name) return joint;
  FAIL("there is no joint " << name);
  return document.stage().joints.front();
}

/// Two boxes, the upper one on a parent that is moved, turned and scaled.
Document with_joint(const std::string& joint, const std::string& rest = {}) {
  return parsed(R"({"tweenfall": 1, "nodes": {
    "crane": {"position": [1, 2, 3], "rotation": {"axis": "z", "angle": 90}, "scale": 2},
    "thigh": {"parent": "crane", "position": [1, 0, 0], "rotation": {"axis": "x", "angle": 30},
              "body": {"shape": {"box": {"size": [0.1, 0.4, 0.1]}}, "mass": 2}},
    "shin": {"position": [1, 2, 3], "body": {"shape": {"box": {"size": [0.2, 0.8, 0.2]}}, "mass": 2}}},
    "world": {"joints": {"knee": )" +
                joint + "}}" + rest + "}");
}

std::string notes_on(const std::string& joint) {
  std::string out;
  const Document document = with_joint(joint);
  for (const Problem& note : document.notes()) {
    const std::string text = note.text();
    if (text.find("/world/joints/") != std::string::npos) out += text.substr(0, text.find('\n')) + "\n";
  }
  return out;
}

}  // namespace

TEST_CASE("every kind of joint means what it says") {
  const Document document = Document::read(data_folder() / "documents/good/everything.json");
  const auto kind = [&](const std::string& name) -> const JointKind& { return joint_named(document, name).kind; };
  REQUIRE(document.stage().joints.size() == 15);
  const JointDescription& shoulder = joint_named(document, "shoulder");
  CHECK(std::holds_alternative<BallJoint>(shoulder.kind));
  CHECK(shoulder.break_force == 500);
  CHECK(shoulder.break_torque == 20);
  CHECK_FALSE(shoulder.collide);
  CHECK(document.stage().nodes[shoulder.a].name == "tower/1");
  CHECK(document.stage().nodes[shoulder.b].name == "ball");
  const HingeJoint knee = std::get<HingeJoint>(kind("knee"));
  CHECK(knee.limits->low == doctest::Approx(-120 * degree));
  CHECK(knee.limits->high == 0);
  CHECK(knee.limits->hz == 0);
  CHECK(knee.motor->speed == doctest::Approx(90 * degree));
  CHECK_FALSE(knee.motor->position);
  CHECK(knee.motor->max_force == 20);
  CHECK(joint_named(document, "knee").collide);
  CHECK(std::get<when::Event>(joint_named(document, "knee").until).name == "late");
  CHECK(std::get<when::At>(joint_named(document, "elbow").until).time == 1.5);
  const HingeJoint elbow = std::get<HingeJoint>(kind("elbow"));
  CHECK(elbow.limits->high == doctest::Approx(90 * degree));
  CHECK(elbow.limits->hz == 5);
  CHECK(elbow.limits->zeta == 0.5);
  CHECK(*elbow.motor->position == doctest::Approx(45 * degree));
  CHECK(elbow.motor->hz == 2);
  CHECK(elbow.motor->zeta == 0.7);
  CHECK(std::isinf(elbow.motor->max_force));
  const SliderJoint rail = std::get<SliderJoint>(kind("rail"));
  CHECK(joint_named(document, "rail").a == no_node);
  CHECK(rail.limits->low == -1);
  CHECK(*rail.motor->position == 0.5);
  CHECK(rail.motor->max_force == 10);
  CHECK(std::holds_alternative<FixedJoint>(kind("weld")));
  CHECK(std::get<DistanceJoint>(kind("rod")).limits.low == 2);
  CHECK(std::get<DistanceJoint>(kind("rod")).limits.high == 2);
  CHECK(std::get<DistanceJoint>(kind("rope")).limits.low == 0);
  CHECK(std::get<DistanceJoint>(kind("drag link")).limits.hz == 4);
  const UniversalJoint cardan = std::get<UniversalJoint>(kind("cardan"));
  CHECK(cardan.first_limits->high == doctest::Approx(45 * degree));
  CHECK(cardan.second_limits->high == doctest::Approx(30 * degree));
  CHECK(cardan.first_motor->speed == 0);
  CHECK(cardan.second_motor->speed == doctest::Approx(10 * degree));
  const SwingTwistJoint hip = std::get<SwingTwistJoint>(kind("hip"));
  CHECK(hip.swing_y == doctest::Approx(30 * degree));
  CHECK(hip.swing_z == doctest::Approx(60 * degree));
  CHECK(hip.twist.low == doctest::Approx(-20 * degree));
  CHECK(hip.max_torque == 40);
  // About the document's x, which is the joint's y.
  CHECK(near(*hip.toward, Quat(std::cos(5 * degree), 0, std::sin(5 * degree), 0), 1e-12));
  const SwingTwistJoint neck = std::get<SwingTwistJoint>(kind("neck"));
  CHECK(neck.swing_y == neck.swing_z);
  CHECK(neck.twist.hz == 8);
  const WheelJoint front = std::get<WheelJoint>(kind("front"));
  CHECK(front.hz == 3);
  CHECK(front.zeta == 0.5);
  CHECK(front.suspension->high == 0.2);
  CHECK(front.motor->speed == doctest::Approx(360 * degree));
  const PulleyJoint hoist = std::get<PulleyJoint>(kind("hoist"));
  CHECK(hoist.pulley_b == Vec3(1, 5, 0));
  CHECK(hoist.ratio == 2);
  CHECK(*hoist.length == 40);
  CHECK(std::get<GearJoint>(kind("cogs")).ratio == -2);
  CHECK(std::get<SpringJoint>(kind("bungee")).stiffness == 1e6);
  CHECK(std::get<SpringJoint>(kind("bungee")).length == 1);
}

TEST_CASE("a joint stands where it is said to in the world with all nodes at rest, whatever their parents") {
  // The thigh lies at (1, 4, 3), turned by 90 degrees about z and then by 30 about its own x.
  const Document document =
      with_joint(R"({"hinge": {"axis": [0, 1, 1]}, "between": ["thigh", "shin"], "at": [1, 3, 3]})");
  const JointDescription& knee = joint_named(document, "knee");
  const Quat turn =
      Quat(Eigen::AngleAxisd(90 * degree, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(30 * degree, Vec3::UnitX()));
  CHECK(near(Vec3(Vec3(1, 4, 3) + turn * knee.frame_a.position), Vec3(1, 3, 3), 1e-12));
  CHECK(near(Vec3(turn * knee.frame_a.rotation * Vec3(1, 0, 0)), Vec3(0, std::sqrt(0.5), std::sqrt(0.5)), 1e-12));
  CHECK(near(knee.frame_b.position, Vec3(0, 1, 0), 1e-12));
  CHECK(near(Vec3(knee.frame_b.rotation * Vec3(1, 0, 0)), Vec3(0, std::sqrt(0.5), std::sqrt(0.5)), 1e-12));
  Stage stage(document.stage());
  const std::optional<JointReading> reading = stage.joint("knee");
  REQUIRE(reading);
  CHECK(reading->gap < 1e-12);
  CHECK(std::abs(reading->position[0]) < 1e-12);
  CHECK(document.notes().empty());
}

TEST_CASE("a joint that says no place lies at the origin of its second node, or at both of those it keeps apart") {
  const JointDescription ball = joint_named(with_joint(R"({"ball": {}, "between": ["shin", "thigh"]})"), "knee");
  CHECK(near(ball.frame_a.position, Vec3(0, 2, 0), 1e-12));
  CHECK(near(ball.frame_b.position, Vec3(0, 0, 0), 1e-12));
  const JointDescription rod =
      joint_named(with_joint(R"({"distance": {"length": 2}, "between": ["shin", "thigh"]})"), "knee");
  CHECK(near(rod.frame_a.position, Vec3(0, 0, 0), 1e-12));
  CHECK(near(rod.frame_b.position, Vec3(0, 0, 0), 1e-12));
}

TEST_CASE("joints that start apart, turned or beyond their limits, and those that hold nothing, are noted") {
  const auto noted = [](const std::string& joint) { return notes_on(joint); };
  CHECK(noted(R"({"ball": {}, "between": ["thigh", "shin"]})") == "");
  CHECK(noted(R"({"ball": {}, "between": ["thigh", "shin"], "at": [[1, 3, 3], [1, 3.5, 3]]})")
            .find("the ends of this joint start 0.5 m apart; they are brought together at once") != std::string::npos);
  CHECK(noted(R"({"distance": {"limits": [0, 0.5]}, "between": ["thigh", "shin"]})")
            .find("starts at 2 m, beyond its limits, 0 to 0.5 m; it is brought back at once (at /world/joints/knee)") !=
        std::string::npos);
  CHECK(noted(R"({"hinge": {"axis": "x", "limits": [20, 30]}, "between": ["thigh", "shin"]})")
            .find("starts at 0 degrees, beyond its limits, 20 to 30 degrees") != std::string::npos);
  CHECK(noted(R"({"distance": {"limits": [0, 2.5]}, "between": ["thigh", "shin"]})") == "");
}

TEST_CASE("defaults of joints are not written, and what is written means the same") {
  const Document document = with_joint(
      R"({"collide": false, "between": ["thigh", "shin"], "wheel": {"suspension": {"hz": 2, "zeta": 0.7, "axis": "y"}, "axis": "x"}})");
  CHECK(document.text().find(R"("knee": {"wheel": {"axis": "x"}, "between": ["thigh", "shin"]})") != std::string::npos);
  const Document again = parsed(document.text());
  CHECK(again.text() == document.text());
  const JointDescription &first = joint_named(document, "knee"), &second = joint_named(again, "knee");
  CHECK(first.frame_a.rotation.coeffs() == second.frame_a.rotation.coeffs());
  CHECK(first.frame_b.position == second.frame_b.position);
  CHECK(std::get<WheelJoint>(first.kind).hz == std::get<WheelJoint>(second.kind).hz);
}

TEST_CASE("a recording tells what each joint bears and how it stands, frame by frame, until it is gone") {
  const Document document = parsed(R"({"tweenfall": 1, "nodes": {
    "lamp": {"position": [0, 1, 0], "body": {"shape": {"sphere": {"radius": 0.1}}, "mass": 2}}},
    "world": {"joints": {
      "rope": {"distance": {"limits": [0, 1]}, "between": "lamp", "at": [[0, 2, 0], [0, 1, 0]], "until": {"at": 0.5}},
      "guide": {"ball": {}, "between": "lamp", "until": {"at": 0}}}}})");
  Stage stage(document.stage());
  const Recording recording = record(stage, 1, 60);
  const nlohmann::json told = nlohmann::json::parse(recording_json(recording));
  const nlohmann::json& rope = told.at("joints").at("rope");
  CHECK(rope.at("nodes") == nlohmann::json::parse(R"(["lamp"])"));
  for (const char* list : {"force", "torque", "position", "rate"})
    CHECK(rope.at(list).size() == recording.times.size());
  CHECK(double(rope["force"][10][1]) == doctest::Approx(2 * 9.81).epsilon(1e-6));
  CHECK(double(rope["position"][10][0]) == doctest::Approx(1).epsilon(1e-6));
  CHECK(rope["force"].back().is_null());
  CHECK(rope["rate"].back().is_null());
  CHECK_FALSE(told["joints"]["guide"].contains("position"));
  REQUIRE(told["events"].size() == 2);
  CHECK(told["events"][1] ==
        nlohmann::json::parse(R"({"time": 0.5, "name": "joint_ended", "nodes": ["lamp"], "joint": "rope"})"));
  Recording cut = recording;
  cut.joints[0].reading.pop_back();
  CHECK_THROWS_WITH_AS(check_recording(cut), doctest::Contains("joint \"rope\" has 60 readings for 61 frames"),
                       std::invalid_argument);
}

}  // namespace tweenfall::document_joints
