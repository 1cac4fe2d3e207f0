// FBX clips against closed forms: kinds of keys, orders of rotation, pivots, layers, ways of inheriting scale.

#include "importers/models/fbx_files.h"

#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double degree = std::numbers::pi / 180;
using Affine3 = Eigen::Affine3d;

const Curve<Vec3>& position_of(const Model& model, const std::string& node) {
  for (const Track& track : model.clips.at(0).tracks)
    if (track.node == node && track.property == "position") return std::get<Curve<Vec3>>(track.curve);
  FAIL("no such track");
  return std::get<Curve<Vec3>>(model.clips[0].tracks[0].curve);
}

/// x first, about the fixed axes.
Eigen::Matrix3d turns(const Vec3& degrees, const int (&order)[3]) {
  Eigen::Matrix3d all = Eigen::Matrix3d::Identity();
  for (const int axis : order)
    all = Eigen::AngleAxisd(degrees[axis] * degree, Eigen::Vector3d::Unit(axis)).toRotationMatrix() * all;
  return all;
}
constexpr int xyz[3] = {0, 1, 2};

Affine3 moved(const Vec3& v) {
  return Affine3(Eigen::Translation3d(v));
}

WorldMotion motion_of(const Affine3& matrix) {
  WorldMotion world;
  world.linear = matrix.linear();
  world.motion.pose.position = matrix.translation();
  return world;
}

std::string weights_bits(unsigned right, unsigned next_left) {
  return std::to_string((next_left << 16) | right);
}

/// One node "n" whose x is driven by a curve over 2 s.
Model one_curve(const ScratchFolder& folder, const std::vector<std::pair<double, double>>& keys, unsigned flags,
                const std::string& data = "0,0,218434821,0", const std::string& more = "") {
  FbxText file;
  const int node = file.model("n", "");
  file.curve(file.layer(file.stack(2)), node, "Lcl Translation", "d|X", keys, flags, data, more);
  return load_model(folder.file("one.fbx", file.text()));
}

}  // namespace

TEST_CASE("FBX keys that are constant, constant from the next, linear and cubic with weights keep their kind") {
  const ScratchFolder folder("fbx-kinds");
  const std::vector<std::pair<double, double>> keys{{0, 1}, {1, 4}, {2, 2}};
  const Model constant = one_curve(folder, keys, 0x2);
  const Curve<Vec3>& held = position_of(constant, "n");
  CHECK(held.value(0.999)[0] == 1);
  CHECK(held.value(1)[0] == 4);
  CHECK(held.rate(0.5)[0] == 0);
  CHECK(held.value(2, Side::in)[0] == 2);

  const Model next = one_curve(folder, keys, 0x102);
  CHECK(position_of(next, "n").value(0)[0] == 1);
  CHECK(position_of(next, "n").value(1e-6)[0] == 4);
  CHECK(position_of(next, "n").value(1.5)[0] == 2);

  const Model linear = one_curve(folder, keys, 0x4);
  const Curve<Vec3>& line = position_of(linear, "n");
  CHECK(near(line.value(0.25)[0], 1.75, 1e-15));
  CHECK(near(line.rate(1.5)[0], -2, 1e-14));
  CHECK(std::vector<double>(line.knots().begin(), line.knots().end()) == std::vector<double>{0, 1, 2});

  // Slopes 3 and -6 with handles of 0.7 and 0.2 of each span.
  const Model cubic =
      one_curve(folder, keys, 0x3000408, float_bits(3) + "," + float_bits(-6) + "," + weights_bits(7000, 2000) + ",0");
  const Curve<Vec3>& curve = position_of(cubic, "n");
  for (const double s : {0.1, 0.35, 0.5, 0.8, 0.95}) {
    const double r = 1 - s;
    const auto bezier = [&](double a, double b, double c, double d) {
      return r * r * r * a + 3 * r * r * s * b + 3 * r * s * s * c + s * s * s * d;
    };
    const auto slope = [&](double a, double b, double c, double d) {
      return 3 * (r * r * (b - a) + 2 * r * s * (c - b) + s * s * (d - c));
    };
    const double time = bezier(0, 0.7, 0.8, 1);
    const double y1 = 1 + 3 * 0.7, y2 = 4 + 6 * 0.2;
    CHECK(near(curve.value(time)[0], bezier(1, y1, y2, 4), 1e-6));
    CHECK(near(curve.rate(time)[0], slope(1, y1, y2, 4) / slope(0, 0.7, 0.8, 1), 1e-5));
  }
}

TEST_CASE("automatic FBX slopes are those of a parabola through even keys, and level where they are clamped") {
  const ScratchFolder folder("fbx-auto");
  const Model automatic = one_curve(folder, {{0, 0}, {1, 1}, {2, 4}}, 0x108);
  CHECK(near(position_of(automatic, "n").rate(1)[0], 2, 1e-12));
  CHECK(near(position_of(automatic, "n").rate(0)[0], 1, 1e-12));
  const Model clamped = one_curve(folder, {{0, 0}, {1, 1}, {2, 1}}, 0x1108);
  CHECK(near(position_of(clamped, "n").rate(1)[0], 0, 1e-12));
  // Independent of the keys' times: the chord, also between uneven keys. Otherwise half of it gives way to the secants.
  const Model chord = one_curve(folder, {{0, 0}, {0.5, 1}, {2, 4}}, 0x2108);
  CHECK(near(position_of(chord, "n").rate(0.5)[0], 2, 1e-12));
}

TEST_CASE("an FBX curve goes on beyond its keys as it says") {
  const ScratchFolder folder("fbx-beyond");
  const std::vector<std::pair<double, double>> keys{{0.5, 1}, {1, 3}};
  const auto at = [&](const char* type, double time) {
    return position_of(one_curve(folder, keys, 0x4, "0,0,218434821,0",
                                 "Post-Extrapolation: { Type: " + std::string(type) + "\nRepetition: -1 }"),
                       "n")
        .value(time)[0];
  };
  CHECK(at("C", 1.25) == 3);
  CHECK(near(at("K", 1.25), 4, 1e-12));
  CHECK(near(at("R", 1.25), 2, 1e-12));
  CHECK(near(at("M", 1.125), 2.5, 1e-12));
  CHECK(near(at("A", 1.25), 4, 1e-12));
}

TEST_CASE("FBX rotations in all orders, within pre- and post-rotation, about pivots, are the documented product") {
  const ScratchFolder folder("fbx-pivots");
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
  const Vec3 t(1, 2, 3), off(0.1, 0.2, -0.3), pivot(2, -1, 0.5), pre(10, -20, 30), post(-40, 15, 5);
  const Vec3 s_off(0.3, 0, 0.1), s_pivot(-1, 0.4, 2);
  for (int order = 0; order < 6; ++order) {
    CAPTURE(order);
    FbxText file;
    const int node =
        file.model("n", FbxText::whole("RotationActive", 1) + FbxText::whole("RotationOrder", order) +
                            FbxText::vector("Lcl Translation", t) + FbxText::vector("RotationOffset", off) +
                            FbxText::vector("RotationPivot", pivot) + FbxText::vector("PreRotation", pre) +
                            FbxText::vector("PostRotation", post) + FbxText::vector("ScalingOffset", s_off) +
                            FbxText::vector("ScalingPivot", s_pivot) + FbxText::vector("Lcl Scaling", Vec3(1, 2, 3)));
    const int layer = file.layer(file.stack(1));
    file.curve(layer, node, "Lcl Rotation", "d|X", {{0, 0}, {1, 100}}, 0x4);
    file.curve(layer, node, "PreRotation", "d|Y", {{0, -20}, {1, 60}}, 0x4);
    file.curve(layer, node, "Lcl Scaling", "d|Z", {{0, 3}, {1, 1}}, 0x4);
    const Model model = load_model(folder.file("pivots.fbx", file.text()));
    Posed posed(model);
    posed.play(0);
    for (const double time : {0.0, 0.3, 0.75, 1.0}) {
      posed.at(time);
      const Vec3 r(100 * time, 0, 0), p(10, -20 + 80 * time, 30), s(1, 2, 3 - 2 * time);
      Affine3 turn_pre = Affine3::Identity(), turn_own = turn_pre, turn_post = turn_pre, scale = turn_pre;
      turn_pre.linear() = turns(p, xyz);
      turn_own.linear() = turns(r, orders[order]);
      turn_post.linear() = turns(post, xyz);
      scale.linear() = s.asDiagonal();
      const Affine3 wanted = moved(t) * moved(off) * moved(pivot) * turn_pre * turn_own * turn_post.inverse() *
                             moved(-pivot) * moved(s_off) * moved(s_pivot) * scale * moved(-s_pivot);
      CHECK(world_error(posed.world(0), motion_of(wanted)) < 1e-12);
    }
    // The rates are the values' own derivatives.
    const Curve<Vec3>& position = position_of(model, "n");
    const double h = 1e-4;
    for (const double time : {0.2, 0.6}) {
      const Vec3 change = (position.value(time + h) - position.value(time - h)) / (2 * h);
      const Vec3 bend = (position.rate(time + h) - position.rate(time - h)) / (2 * h);
      CHECK(near(position.rate(time), change, 1e-6));
      CHECK(near(position.sample(time).acceleration, bend, 1e-5));
    }
  }
}

TEST_CASE("FBX layers add, replace and mix, by weights that move, angle by angle or by whole rotations") {
  const ScratchFolder folder("fbx-layers");
  const auto model_of = [&](const std::string& properties, const std::string& property) {
    FbxText file;
    const int node = file.model("n", "");
    const int stack = file.stack(1);
    const int base = file.layer(stack);
    const int above = file.layer(stack, properties);
    file.curve(base, node, property, "d|X", {{0, 10}, {1, 30}}, 0x4);
    file.curve(above, node, property, "d|Y", {{0, 40}, {1, 40}}, 0x4);
    file.curve(above, above, "Weight", "d|Weight", {{0, 0}, {1, 100}}, 0x4);
    return load_model(folder.file("layers.fbx", file.text()));
  };
  const auto at_half = [&](int blend) {
    return position_of(model_of(FbxText::whole("BlendMode", blend), "Lcl Translation"), "n").sample(0.5);
  };
  CHECK(near(at_half(0).value, Vec3(20, 20, 0), 1e-12));
  CHECK(near(at_half(0).rate, Vec3(20, 40, 0), 1e-12));
  CHECK(near(at_half(1).value, Vec3(0, 40, 0), 1e-12));
  CHECK(near(at_half(2).value, Vec3(10, 20, 0), 1e-12));
  CHECK(near(at_half(2).rate, Vec3(-10, 40, 0), 1e-12));

  for (const int by_angle : {0, 1}) {
    const Model model =
        model_of(FbxText::whole("BlendMode", 0) + FbxText::whole("RotationAccumulationMode", by_angle), "Lcl Rotation");
    Posed posed(model);
    posed.play(0);
    posed.at(0.5);
    const Eigen::Matrix3d wanted = by_angle ? turns(Vec3(20, 20, 0), xyz)
                                            : Eigen::Matrix3d(turns(Vec3(20, 0, 0), xyz) * turns(Vec3(0, 20, 0), xyz));
    CHECK((posed.world(0).linear - wanted).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("an FBX layer that is muted, or beside one in solo, moves nothing, and is told of") {
  const ScratchFolder folder("fbx-muted");
  const auto model_of = [&](const std::string& first, const std::string& second) {
    FbxText file;
    const int node = file.model("n", FbxText::vector("Lcl Translation", Vec3(7, 0, 0)));
    const int stack = file.stack(1);
    file.curve(file.layer(stack, first), node, "Lcl Translation", "d|X", {{0, 1}, {1, 3}}, 0x4);
    file.curve(file.layer(stack, second), node, "Lcl Translation", "d|X", {{0, 100}, {1, 100}}, 0x4);
    return load_model(folder.file("muted.fbx", file.text()));
  };
  const std::string mute = FbxText::whole("Mute", 1), solo = FbxText::whole("Solo", 1);
  const auto half = [](const Model& model) { return position_of(model, "n").value(0.5)[0]; };
  CHECK(near(half(model_of("", "")), 102, 1e-12));
  CHECK(model_of("", "").repairs.empty());
  const Model upper = model_of("", mute);
  CHECK(near(half(upper), 2, 1e-12));
  REQUIRE(upper.repairs.size() == 1);
  CHECK(upper.repairs[0] == "clip \"move\": its layer \"layer\" is muted; it was left out");
  // Over the node's own value, without the lowest.
  CHECK(near(half(model_of(mute, "")), 107, 1e-12));
  CHECK(near(half(model_of(solo, mute)), 2, 1e-12));
  CHECK(near(half(model_of("", solo + mute)), 107, 1e-12));
}

TEST_CASE("an FBX property that is listed or driven twice is as the file's other readers have it, and told of") {
  const ScratchFolder folder("fbx-twice");
  FbxText file;
  const int node = file.model("n", FbxText::vector("Lcl Translation", Vec3(1, 2, 3)) +
                                       FbxText::vector("Lcl Translation", Vec3(4, 5, 6)) + FbxText::whole("Show", 1) +
                                       FbxText::whole("Show", 1));
  CHECK(near(load_model(folder.file("twice.fbx", file.text())).nodes.at(0).rest.position, Vec3(4, 5, 6), 0));
  const int layer = file.layer(file.stack(1));
  for (const double from : {1.0, 8.0})
    file.curve(layer, node, "Lcl Translation", "d|X", {{0, from}, {1, from + 1}}, 0x4);
  const Model model = load_model(folder.file("twice.fbx", file.text()));
  CHECK(near(position_of(model, "n").value(0.5), Vec3(1.5, 5, 6), 1e-12));
  REQUIRE(model.repairs.size() == 2);
  CHECK(model.repairs[0].ends_with("the Model \"n\" lists \"Lcl Translation\" more than once; the last is used"));
  CHECK(model.repairs[1] ==
        "clip \"move\": \"Lcl Translation\" of \"n\" is driven twice in one layer; the first is used");
}

TEST_CASE("what an FBX clip has before 0 s is told of, by its own times or else by its keys") {
  const ScratchFolder folder("fbx-before");
  const auto repairs_of = [&](const std::string& times) {
    FbxText file;
    const int node = file.model("n", "");
    const int stack = file.object("AnimationStack", "AnimStack::move", "", "Properties70: { " + times + " }");
    file.curve(file.layer(stack), node, "Lcl Translation", "d|X", {{-1, 10}, {2, 40}}, 0x4);
    const Model model = load_model(folder.file("before.fbx", file.text()));
    CHECK(near(position_of(model, "n").value(0.5)[0], 25, 1e-12));
    CHECK(model.clips[0].duration == 2);
    return model.repairs;
  };
  const auto time = [](const std::string& name, double seconds) {
    return "P: \"" + name + "\", \"KTime\", \"Time\", \"\"," + FbxText::ticks(seconds) + "\n";
  };
  const std::vector<std::string> told{"clip \"move\": begins at -1 s; what lies before 0 s is not played"};
  CHECK(repairs_of(time("LocalStart", -1) + time("LocalStop", 2)) == told);
  CHECK(repairs_of(time("ReferenceStart", -1) + time("ReferenceStop", 2)) == told);
  CHECK(repairs_of("") == told);
  CHECK(repairs_of(time("LocalStop", 2)) == told);
  CHECK(repairs_of(time("LocalStart", 0) + time("LocalStop", 2)).empty());
}

TEST_CASE("FBX children take over their parent's scale as their kind says, moving or not") {
  const ScratchFolder folder("fbx-inherit");
  const Vec3 parent_scale(2, 1, 3), child_scale(1, 4, 1), t(1, 2, 3);
  for (const int kind : {0, 1, 2}) {
    CAPTURE(kind);
    FbxText file;
    const int parent = file.model(
        "parent", FbxText::vector("Lcl Rotation", Vec3(0, 0, 30)) + FbxText::vector("Lcl Scaling", parent_scale));
    file.model("child",
               FbxText::whole("InheritType", kind) + FbxText::vector("Lcl Translation", t) +
                   FbxText::vector("Lcl Rotation", Vec3(40, 0, 0)) + FbxText::vector("Lcl Scaling", child_scale),
               parent);
    file.curve(file.layer(file.stack(1)), parent, "Lcl Scaling", "d|Y", {{0, 1}, {1, 5}}, 0x4);
    const Model model = load_model(folder.file("inherit.fbx", file.text()));
    Posed posed(model);
    posed.play(0);
    posed.at(0.5);
    const Eigen::Vector3d s(2, 3, 3);
    const Eigen::Matrix3d a = turns(Vec3(0, 0, 30), xyz), b = turns(Vec3(40, 0, 0), xyz);
    Affine3 wanted;
    wanted.translation() = a * s.cwiseProduct(Eigen::Vector3d(t));
    const Eigen::Vector3d c = child_scale;
    if (kind == 0) wanted.linear() = a * b * s.cwiseProduct(c).asDiagonal();
    if (kind == 1) wanted.linear() = a * s.asDiagonal() * b * c.asDiagonal();
    if (kind == 2) wanted.linear() = a * b * c.asDiagonal();
    CHECK(world_error(posed.world(posed.find("child")), motion_of(wanted)) < 1e-12);
    wanted.translation() = Vec3(0, 0, 0);
    wanted.linear() = a * s.asDiagonal();
    CHECK(world_error(posed.world(posed.find("parent")), motion_of(wanted)) < 1e-12);
  }
}

TEST_CASE("FBX blend shapes move by their channel's per cent, through shapes in between") {
  const ScratchFolder folder("fbx-shapes");
  FbxText file;
  const int node = file.model("n", "");
  const int mesh = file.object("Geometry", "Geometry::g", "Mesh",
                               "Vertices: *9 { a: 0,0,0,1,0,0,0,1,0 }\nPolygonVertexIndex: *3 { a: 0,1,-3 }", node);
  const int blend = file.object("Deformer", "Deformer::b", "BlendShape", "", mesh);
  const int plain =
      file.object("Deformer", "SubDeformer::up", "BlendShapeChannel", "FullWeights: *1 { a: 100 }", blend);
  const int steps =
      file.object("Deformer", "SubDeformer::way", "BlendShapeChannel", "FullWeights: *2 { a: 50,100 }", blend);
  const auto shape = [&](const char* name, const char* offset, int channel) {
    file.object("Geometry", std::string("Geometry::") + name, "Shape",
                "Indexes: *1 { a: 2 }\nVertices: *3 { a: " + std::string(offset) + " }", channel);
  };
  shape("up", "0,0,8", plain);
  shape("half", "4,0,0", steps);
  shape("whole", "4,4,0", steps);
  const int layer = file.layer(file.stack(1));
  file.curve(layer, plain, "DeformPercent", "d|DeformPercent", {{0, 0}, {1, 100}}, 0x4);
  file.curve(layer, steps, "DeformPercent", "d|DeformPercent", {{0, 0}, {1, 100}}, 0x4);
  const Model model = load_model(folder.file("shapes.fbx", file.text()));
  REQUIRE(model.instances.size() == 1);
  Posed posed(model);
  posed.play(0);
  const auto tip = [&](double time) {
    posed.at(time);
    return posed.vertices(model.instances[0]).at(2);
  };
  CHECK(near(tip(0), Vec3(0, 1, 0), 1e-15));
  CHECK(near(tip(0.25), Vec3(2, 1, 2), 1e-12));
  CHECK(near(tip(0.75), Vec3(4, 3, 6), 1e-12));
  CHECK(near(tip(1), Vec3(4, 5, 8), 1e-12));
}
