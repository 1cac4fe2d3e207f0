// Bodies and joints in glTF: KHR_implicit_shapes and KHR_physics_rigid_bodies, written, read, and run.

#include "importers/models/model_support.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/recording.h>
#include <tweenfall/physics/stage/stage.h>

#include <nlohmann/json.hpp>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Model bodies_of_all_shapes() {
  Model model;
  model.name = "shapes";
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  SurfaceMesh square;
  square.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  square.triangles = {0, 2, 1, 0, 3, 2};
  const std::vector<std::pair<Solid, bool>> solids{{Sphere{0.3}, false},
                                                   {Box{{0.1, 0.2, 0.3}}, false},
                                                   {Capsule{0.2, 0.4}, false},
                                                   {Cylinder{0.2, 0.1}, false},
                                                   {Cone{0.2, 0.3}, false},
                                                   {TaperedCapsule{0.3, 0.2, 0.4}, false},
                                                   {Hull{ConvexHull(corners)}, false},
                                                   {Plane{{0, 0, 1}, 2}, true},
                                                   {TriangleMesh(square), true}};
  for (const auto& [solid, fixed] : solids) {
    const std::size_t node = model.nodes.size();
    model.nodes.push_back({.name = "n" + std::to_string(node), .rest = {{1.0 * static_cast<double>(node), 0, 0}}});
    ModelBody body{node, {.shape = {solid}, .friction = 0.25, .restitution = 0.5, .fixed = fixed}};
    if (node == 1) {
      body.body.shape.offset = {{0, 0.5, 0}, Quat(0.8, 0, 0.6, 0)};
      body.body.mass = 7;
      body.body.twist = {{1, 2, 3}, {4, 5, 6}};
      body.body.groups = 4;
      body.body.collides_with = ~std::uint64_t{4};
      body.body.friction_combine = Combine::minimum;
    }
    model.bodies.push_back(std::move(body));
  }
  const std::size_t node = model.nodes.size();
  model.nodes.push_back({.name = "club"});
  model.bodies.push_back(
      {node, {.shape = {Compound({{Sphere{0.2}, {{0, 1, 0}}}, {Cylinder{0.05, 0.5}}})}, .restitution = 0.5}});
  return model;
}

Model written_and_read(const Model& model) {
  const ScratchFolder folder("physics-written");
  save_glb(model, folder / "written.glb");
  return load_model(folder / "written.glb");
}

const ModelBody* body_named(const Model& model, const std::string& name) {
  for (const ModelBody& body : model.bodies)
    if (model.nodes[body.node].name == name) return &body;
  return nullptr;
}

/// Three boxes in a row; the joint holds the last two.
Model joined_by(const JointKind& kind) {
  Model model;
  for (int i = 0; i < 3; ++i) {
    model.nodes.push_back({.name = "box" + std::to_string(i), .rest = {{1.0 * i, 2, 0}, Quat(0.8, 0, 0, 0.6)}});
    model.bodies.push_back({static_cast<std::size_t>(i), {.shape = {Box{{0.2, 0.1, 0.1}}}, .mass = 1.0 + i}});
  }
  JointDescription joint;
  joint.name = "joint";
  joint.a = 1;
  joint.b = 2;
  joint.frame_a = {{0.5, 0, 0}, Quat(0.6, 0, 0.8, 0)};
  joint.frame_b = {{-0.5, 0, 0}, Quat(0.6, 0, 0.8, 0)};
  joint.kind = kind;
  model.joints.push_back(joint);
  return model;
}

double apart(const Limits& a, const Limits& b) {
  const double low = a.low == b.low ? 0 : std::abs(a.low - b.low),
               high = a.high == b.high ? 0 : std::abs(a.high - b.high);
  return low + high + std::abs(a.hz - b.hz) + (a.hz > 0 ? std::abs(a.zeta - b.zeta) : 0);
}
double apart(const Motor& a, const Motor& b) {
  return std::abs(a.speed - b.speed) + std::abs(a.position.value_or(99) - b.position.value_or(99)) +
         (a.position ? std::abs(a.hz - b.hz) + std::abs(a.zeta - b.zeta) : 0) +
         (a.max_force == b.max_force ? 0 : std::abs(a.max_force - b.max_force));
}
template <class T>
double apart(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() != b.has_value() ? 1 : a ? apart(*a, *b) : 0;
}

double apart(const BallJoint&, const BallJoint&) {
  return 0;
}
double apart(const FixedJoint&, const FixedJoint&) {
  return 0;
}
template <class T>
requires std::same_as<T, HingeJoint> || std::same_as<T, SliderJoint>
double apart(const T& a, const T& b) {
  return apart(a.limits, b.limits) + apart(a.motor, b.motor);
}
double apart(const DistanceJoint& a, const DistanceJoint& b) {
  return apart(a.limits, b.limits);
}
double apart(const UniversalJoint& a, const UniversalJoint& b) {
  return apart(a.first_limits, b.first_limits) + apart(a.second_limits, b.second_limits) +
         apart(a.first_motor, b.first_motor) + apart(a.second_motor, b.second_motor);
}
double apart(const SwingTwistJoint& a, const SwingTwistJoint& b) {
  return std::abs(a.swing_y - b.swing_y) + std::abs(a.swing_z - b.swing_z) + apart(a.twist, b.twist);
}
double apart(const WheelJoint& a, const WheelJoint& b) {
  return std::abs(a.hz - b.hz) + std::abs(a.zeta - b.zeta) + apart(a.suspension, b.suspension) +
         apart(a.motor, b.motor);
}
double apart(const SpringJoint& a, const SpringJoint& b) {
  return std::abs(a.length - b.length) + std::abs(a.stiffness - b.stiffness) + std::abs(a.damping - b.damping);
}

/// A glTF text with two balls of 1 kg, the first 1 m above the second's node, and what a joint node on it holds.
std::string two_jointed_balls(const std::string& limits, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_implicit_shapes","KHR_physics_rigid_bodies"],
"extensions":{"KHR_implicit_shapes":{"shapes":[{"type":"sphere","sphere":{"radius":0.1}}]},
"KHR_physics_rigid_bodies":{"physicsJoints":[{"limits":[)" +
         limits + "]" + more + R"(}]}},
"nodes":[{"name":"upper","translation":[0,1,0],"children":[2],"extensions":{"KHR_physics_rigid_bodies":{"motion":{"mass":1},
"collider":{"geometry":{"shape":0}}}}},
{"name":"lower","children":[3],"extensions":{"KHR_physics_rigid_bodies":{"motion":{"mass":1},"collider":{"geometry":{"shape":0}}}}},
{"name":"pivot","translation":[0,-0.5,0],"extensions":{"KHR_physics_rigid_bodies":{"joint":{"connectedNode":3,"joint":0}}}},
{"name":"end","translation":[0,0.5,0]}]})";
}

Model read_text(const std::string& text) {
  const ScratchFolder folder("physics-text");
  return load_model(folder.file("two.gltf", text));
}

std::string lock(const std::string& kind, const std::string& axes) {
  return R"({")" + kind + R"(":[)" + axes + R"(],"min":0,"max":0})";
}

}  // namespace

TEST_CASE("where the mass of a body is, and its inertia, go to glTF and come back; what cannot be is told") {
  Model model = bodies_of_all_shapes();
  MassProperties weighed{3, Vec3(0.1, -0.2, 0.05), Mat3::Zero()};
  weighed.inertia << 0.5, 0.1, 0, 0.1, 0.4, 0.05, 0, 0.05, 0.3;
  for (ModelBody& body : model.bodies)
    if (model.nodes[body.node].name == "n1") body.body.mass_properties = weighed;
  const Model again = written_and_read(model);
  CHECK(again.repairs.empty());
  const ModelBody* same = body_named(again, "n1");
  REQUIRE(same);
  REQUIRE(same->body.mass_properties.has_value());
  CHECK(same->body.mass_properties->mass == 3);
  CHECK((same->body.mass_properties->center - weighed.center).norm() < 1e-12);
  CHECK((same->body.mass_properties->inertia - weighed.inertia).norm() < 1e-6);
  std::string text = two_jointed_balls("");
  const std::string mass = R"("mass":1)";
  text.replace(text.find(mass), mass.size(), mass + R"(,"inertiaDiagonal":[1,1,3])");
  const Model refused = read_text(text);
  CHECK_FALSE(body_named(refused, "upper")->body.mass_properties.has_value());
  CHECK(std::ranges::any_of(refused.repairs, [](const std::string& repair) {
    return repair.find("no body has such an inertia") != std::string::npos;
  }));
}

TEST_CASE("a body of each shape is read from glTF as it was written") {
  const Model model = bodies_of_all_shapes(), again = written_and_read(model);
  CHECK(again.repairs.empty());
  REQUIRE(again.bodies.size() == model.bodies.size());
  for (const ModelBody& body : model.bodies) {
    const std::string& name = model.nodes[body.node].name;
    CAPTURE(name);
    const ModelBody* same = body_named(again, name);
    // A body that never moves is where its collider is.
    if (!same) same = body_named(again, name + " collider");
    REQUIRE(same);
    const Solid &one = body.body.shape.solid, &other = same->body.shape.solid;
    CAPTURE(kind_name(other));
    CHECK(other.index() == one.index());
    CHECK(same->body.fixed == body.body.fixed);
    CHECK(same->body.friction == doctest::Approx(body.body.friction));
    CHECK(same->body.restitution == doctest::Approx(body.body.restitution));
    if (is_scenery(one)) continue;
    const MassProperties a = mass_properties(body.body.shape, 2), b = mass_properties(same->body.shape, 2);
    CHECK((a.center - b.center).norm() < 1e-6);
    CHECK((a.inertia - b.inertia).norm() < 1e-6);
    CHECK(same->body.mass.value_or(0) ==
          doctest::Approx(body.body.mass.value_or(body.body.density * volume(body.body.shape.solid))));
  }
  const BodyDescription& box = body_named(again, "n1")->body;
  CHECK((box.twist.linear - Vec3(1, 2, 3)).norm() < 1e-12);
  CHECK((box.twist.angular - Vec3(4, 5, 6)).norm() < 1e-12);
  CHECK(box.friction_combine == Combine::minimum);
  CHECK((box.groups & box.collides_with) == 0);
  CHECK((box.collides_with & 1) == 1);
  const Bounds plane = bounds({Box{{0.1, 0.1, 0.1}}}, {});
  CHECK(plane.high[0] == doctest::Approx(0.1));
}

TEST_CASE("a joint of each kind is read from glTF as it was written") {
  const Limits hard{-0.5, 1}, soft{-0.25, 0.75, 8, 0.5};
  const Motor spring{.speed = 0, .position = 0.3, .hz = 4, .zeta = 0.7, .max_force = 12},
      wheel{.speed = 3, .max_force = 5};
  const std::vector<JointKind> kinds{BallJoint{},
                                     FixedJoint{},
                                     HingeJoint{},
                                     HingeJoint{hard, wheel},
                                     HingeJoint{soft, spring},
                                     SliderJoint{soft, spring},
                                     SliderJoint{hard, std::nullopt},
                                     DistanceJoint{{0.5, 1.5}},
                                     DistanceJoint{},
                                     UniversalJoint{hard, soft, wheel, std::nullopt},
                                     SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.5, .twist = {-0.2, 0.4}},
                                     SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.8, .twist = {-0.2, 0.4}},
                                     WheelJoint{3, 0.6, hard, wheel},
                                     SpringJoint{0.8, 150, 3}};
  for (const JointKind& kind : kinds) {
    CAPTURE(kind.index());
    const Model model = joined_by(kind), again = written_and_read(model);
    CHECK(again.repairs.empty());
    REQUIRE(again.joints.size() == 1);
    const JointDescription &joint = model.joints.front(), &same = again.joints.front();
    CHECK(again.nodes[same.a].name == "box1");
    CHECK(again.nodes[same.b].name == "box2");
    CHECK((same.frame_a.position - joint.frame_a.position).norm() < 1e-12);
    CHECK((same.frame_b.position - joint.frame_b.position).norm() < 1e-12);
    CHECK(same.frame_a.rotation.angularDistance(joint.frame_a.rotation) < 1e-7);
    CHECK(same.frame_b.rotation.angularDistance(joint.frame_b.rotation) < 1e-7);
    CHECK_FALSE(same.collide);
    REQUIRE(same.kind.index() == kind.index());
    std::visit(
        [&](const auto& wanted) {
          using Kind = std::remove_cvref_t<decltype(wanted)>;
          if constexpr (requires { apart(wanted, wanted); }) CHECK(apart(wanted, std::get<Kind>(same.kind)) < 1e-9);
        },
        kind);
  }
  CHECK(written_and_read(joined_by(GearJoint{})).joints.empty());
}

TEST_CASE("joints and shapes on mirrored nodes go through glTF where the matrices have them") {
  Model model = joined_by(HingeJoint{});
  model.nodes[1].rest.scale = {-1, 1, 1};
  model.nodes[2].rest.scale = {2, -2, 2};
  const Model again = written_and_read(model);
  REQUIRE(again.joints.size() == 1);
  const JointDescription &joint = model.joints.front(), &same = again.joints.front();
  CHECK(near(same.frame_a.position, joint.frame_a.position, 1e-12));
  CHECK(near(same.frame_b.position, joint.frame_b.position, 1e-12));
  CHECK(near(same.frame_a.rotation, joint.frame_a.rotation, 1e-7));
  CHECK(near(same.frame_b.rotation, joint.frame_b.rotation, 1e-7));
  const auto frame = std::ranges::find(again.nodes, "joint a", &Node::name);
  REQUIRE(frame != again.nodes.end());
  REQUIRE(frame->parent == same.a);
  const auto linear = [](const Pose& pose) { return Mat3(pose.rotation.toRotationMatrix() * pose.scale.asDiagonal()); };
  const Quat in_world = model.nodes[1].rest.rotation * joint.frame_a.rotation;
  const Mat3 found = linear(again.nodes[same.a].rest) * linear(frame->rest);
  CHECK(near(Mat3(found * Vec3(-1, 1, 1).asDiagonal()), in_world.toRotationMatrix(), 1e-7));
  // Read from any file: frames of two bodies that are one place and one direction have their coordinates at 0.
  const std::string text = two_jointed_balls(lock("linearAxes", "0,1,2"));
  for (const char* mirror : {"-1,1,1", "1,-1,1", "1,-1,-1"}) {
    std::string mirrored = text;
    mirrored.replace(mirrored.find(R"({"name":"upper",)"), 16,
                     R"({"name":"upper","rotation":[0,0.6,0,0.8],"scale":[)" + std::string(mirror) + "],");
    mirrored.replace(mirrored.find(R"({"name":"pivot",)"), 16, R"({"name":"pivot","rotation":[0.6,0,0,0.8],)");
    const Model read = read_text(mirrored);
    REQUIRE(read.joints.size() == 1);
    const auto sized = std::ranges::find(read.nodes, "upper", &Node::name);
    const auto pivot = std::ranges::find(read.nodes, "pivot", &Node::name);
    const Mat3 whole = linear(sized->rest) * linear(pivot->rest);
    const Quat turned = sized->rest.rotation * read.joints[0].frame_a.rotation;
    CHECK(near(turned.toRotationMatrix(), Mat3(whole * sized->rest.scale.asDiagonal()), 1e-6));
  }
}

TEST_CASE("limits of a joint may be told one by one, along any axis") {
  const std::string places =
      lock("linearAxes", "0") + "," + lock("linearAxes", "2") + "," + lock("linearAxes", "1") + ",";
  const Model hinge = read_text(two_jointed_balls(places + lock("angularAxes", "0") + "," + lock("angularAxes", "1")));
  REQUIRE(hinge.joints.size() == 1);
  const JointDescription& joint = hinge.joints.front();
  REQUIRE(std::holds_alternative<HingeJoint>(joint.kind));
  CHECK(((joint.frame_a.rotation * Vec3(1, 0, 0)) - Vec3(0, 0, 1)).norm() < 1e-12);
  CHECK((joint.frame_a.position - Vec3(0, -0.5, 0)).norm() < 1e-12);
  CHECK((joint.frame_b.position - Vec3(0, 0.5, 0)).norm() < 1e-12);

  const Model slider = read_text(two_jointed_balls(
      lock("linearAxes", "0,2") + R"(,{"linearAxes":[1],"min":-0.5,"max":0.25},)" + lock("angularAxes", "0,1,2")));
  REQUIRE(std::holds_alternative<SliderJoint>(slider.joints.at(0).kind));
  CHECK(std::get<SliderJoint>(slider.joints[0].kind).limits->low == -0.5);
  CHECK(((slider.joints[0].frame_a.rotation * Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm() < 1e-12);

  const Model none = read_text(two_jointed_balls(lock("linearAxes", "0") + "," + lock("angularAxes", "0")));
  CHECK(none.joints.empty());
  REQUIRE_FALSE(none.repairs.empty());
  CHECK(none.repairs.back().find("no joint known here; the joint was left out") != std::string::npos);
}

TEST_CASE("a joint to the world is held the same whichever node names it") {
  const std::string lower = R"({"name":"lower","children":[3],)";
  std::string text = two_jointed_balls(
      lock("linearAxes", "0,1,2") + "," + lock("angularAxes", "1,2") + R"(,{"angularAxes":[0],"min":-0.2,"max":0.7})",
      R"(,"drives":[{"type":"angular","axis":0,"velocityTarget":2,"damping":10}])");
  const std::size_t at = text.find(lower);
  REQUIRE(at != std::string::npos);
  text.erase(at, text.find("{\"name\":\"pivot\"") - at);
  // Only the upper ball is left, and the joint's other end is in the world.
  text.replace(text.find("\"children\":[2]"), 14, "\"children\":[1]");
  text.replace(text.find("\"connectedNode\":3"), 17, "\"connectedNode\":2");
  const Model model = read_text(text);
  REQUIRE(model.joints.size() == 1);
  const JointDescription& joint = model.joints[0];
  CHECK(joint.a == no_node);
  CHECK(model.nodes[joint.b].name == "upper");
  CHECK((joint.frame_a.position - Vec3(0, 0.5, 0)).norm() < 1e-12);
  const auto& hinge = std::get<HingeJoint>(joint.kind);
  CHECK(hinge.limits->low == doctest::Approx(-0.7));
  CHECK(hinge.limits->high == doctest::Approx(0.2));
  CHECK(hinge.motor->speed == doctest::Approx(-2));
}

TEST_CASE("what a recording ran with runs the same out of its glTF") {
  const ScratchFolder folder("physics-run");
  const std::string text = R"({"tweenfall": 1, "name": "chain", "world": {
    "joints": {"pin": {"hinge": {"axis": "z", "limits": [-60, 80]}, "between": "rod", "at": [0, 2, 0]},
               "link": {"ball": {}, "between": ["rod", "ball"], "at": [0.8, 2, 0]}}},
    "nodes": {"floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}},
      "shelf": {"position": [3, 1, 0], "body": {"shape": {"box": {"size": [1, 0.1, 1]}}, "static": true}},
      "rod": {"position": [0.4, 2, 0], "body": {"shape": {"box": {"size": [0.8, 0.1, 0.1]}}, "mass": 2}},
      "ball": {"position": [1.2, 2, 0], "body": {"shape": {"sphere": {"radius": 0.15}}, "mass": 1}}}})";
  const Document document = Document::parse(text, "chain.json", folder.path());
  Stage stage(document.stage());
  save_recording(record(stage, 1, 60), document.stage(), folder / "chain.glb");

  const Document again =
      Document::read(folder.file("again.json", R"({"tweenfall": 1, "import": {"c": "chain.glb"}, "play": []})"));
  CHECK(again.stage().joints.size() == 2);
  // Though the recording has keys for them, too.
  for (const char* name : {"c/floor", "c/shelf"}) {
    CAPTURE(name);
    const auto still =
        std::ranges::find_if(again.stage().nodes, [&](const NodeDescription& node) { return node.name == name; });
    REQUIRE((still != again.stage().nodes.end() && still->body));
    CHECK(still->body->fixed);
  }
  Stage second(again.stage());
  stage.seek(0.3);
  second.seek(0.3);
  for (const std::string name : {"rod", "ball"}) {
    const WorldMotion one = stage.world(stage.node(name)), other = second.world(second.node("c/" + name));
    CHECK(one.motion.twist.linear.norm() > 0.1);
    CHECK((one.motion.pose.position - other.motion.pose.position).norm() < 1e-6);
    CHECK((one.motion.twist.linear - other.motion.twist.linear).norm() < 1e-5);
  }
}

TEST_CASE("who passes through whom, and who follows a script, goes through glTF") {
  const ScratchFolder folder("physics-ignore");
  // Two balls fall, one through the shelf that it ignores; a third, of another group, falls through all of the first.
  const std::string text = R"({"tweenfall": 1, "name": "sieve", "world": {"ignore": [["shelf", "a"], ["a", "lift"]]},
    "nodes": {
      "shelf": {"body": {"shape": {"box": {"size": [6, 0.2, 1]}}, "static": true}},
      "a": {"position": [-1, 0.4, 0], "body": {"shape": {"sphere": {"radius": 0.2}}}},
      "b": {"position": [0, 0.4, 0], "body": {"shape": {"sphere": {"radius": 0.2}}}},
      "c": {"position": [1, 0.4, 0], "body": {"shape": {"sphere": {"radius": 0.2}}, "groups": ["light"], "collides_with": ["light"]}},
      "d": {"position": [2.5, 0.4, 0], "body": {"shape": {"sphere": {"radius": 0.2}}, "groups": []}},
      "lift": {"position": [2, 1, 0], "body": {"shape": {"box": {"size": [0.2, 0.2, 0.2]}}}}},
    "clips": {"up": {"tracks": {"lift.position": [[0, [2, 1, 0]], [1, [2, 2, 0]]]}}}})";
  const Document document = Document::parse(text, "sieve.json", folder.path());
  Stage stage(document.stage());
  save_recording(record(stage, 1, 60), document.stage(), folder / "sieve.glb");
  const Document again =
      Document::read(folder.file("again.json", R"({"tweenfall": 1, "import": {"s": "sieve.glb"}, "play": []})"));
  Stage second(again.stage());
  const auto node = [&](const char* name) { return second.node(std::string("s/") + name); };
  for (const auto& [one, other] : {std::pair("shelf", "a"),
                                   {"a", "lift"},
                                   {"shelf", "b"},
                                   {"shelf", "c"},
                                   {"a", "b"},
                                   {"b", "c"},
                                   {"b", "lift"},
                                   {"c", "lift"},
                                   {"shelf", "d"},
                                   {"b", "d"}}) {
    const std::string names = std::string(one) + " and " + other;
    CAPTURE(names);
    CHECK(second.collides(node(one), node(other)) == stage.collides(stage.node(one), stage.node(other)));
  }
  CHECK(second.owner(node("lift")) == Owner::keyed);
  second.advance(1);
  CHECK(second.world(node("lift")).motion.pose.position == Vec3(2, 1, 0));
  CHECK(second.world(node("a")).motion.pose.position.y() == doctest::Approx(0.4 - 0.5 * 9.81).epsilon(1e-9));
  CHECK(second.world(node("b")).motion.pose.position.y() == doctest::Approx(0.3).epsilon(1e-3));
  CHECK(second.world(node("c")).motion.pose.position.y() == doctest::Approx(0.4 - 0.5 * 9.81).epsilon(1e-9));
}

TEST_CASE("bodies in glTF that are wrong are told of, and of those that cannot be, the rest is kept") {
  const std::string good = two_jointed_balls(lock("linearAxes", "0,1,2"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  };
  CHECK(read_text(good).joints.size() == 1);
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      (void)read_text(text);
      return "taken";
    } catch (const ModelError& error) {
      return error.what();
    }
  };
  CHECK(refusal(with("\"joint\":0", "\"joint\":9")).find("points past the end") != std::string::npos);
  CHECK(refusal(with("\"radius\":0.1", "\"radius\":-1")).find("radius") != std::string::npos);
  CHECK(refusal(with("\"mass\":1", "\"mass\":\"heavy\"")).find("must be a finite number") != std::string::npos);
  CHECK(refusal(with("\"mass\":1", "\"mass\":-1")).find("at least 0 kg") != std::string::npos);
  CHECK(refusal(with("\"min\":0,\"max\":0", "\"min\":1,\"max\":0")).find("above its \"max\"") != std::string::npos);

  const Model uneven = read_text(with("\"translation\":[0,1,0],", "\"translation\":[0,1,0],\"scale\":[1,2,1],"));
  CHECK(uneven.bodies.size() == 1);
  CHECK(uneven.joints.size() == 1);  // between the other and the world
  const Model kinematic = read_text(with("\"motion\":{\"mass\":1}", "\"motion\":{\"isKinematic\":true}"));
  CHECK(body_named(kinematic, "upper")->body.fixed);
}
