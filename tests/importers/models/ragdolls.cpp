// Ragdolls of real skeletons: the sample character, and every skinned model at hand.

#include "random.h"
#include "support.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>
#include <tweenfall/physics/ragdoll/staged_ragdoll.h>
#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <filesystem>
#include <set>

using namespace tweenfall;

namespace {

struct SkinnedFigure {
  Hierarchy hierarchy;
  std::vector<SkinnedMesh> meshes;
  std::vector<Motion> local;
  std::vector<WorldMotion> world;
};

/// All skinned meshes of a model; may be empty.
std::optional<SkinnedFigure> figure_of(const Model& model) {
  SkinnedFigure figure{Hierarchy(model.nodes), {}, {}, {}};
  for (const MeshInstance& instance : model.instances)
    if (instance.skin != no_node && !model.meshes[instance.mesh].influences.empty())
      figure.meshes.push_back({&model.meshes[instance.mesh], &model.skins[instance.skin]});
  if (figure.meshes.empty()) return std::nullopt;
  for (const Node& node : model.nodes) figure.local.push_back({node.rest, {}, Vec3::Zero()});
  figure.world.resize(model.nodes.size());
  figure.hierarchy.world_motions(figure.local, figure.world);
  return figure;
}

/// Lets a figure fall on a floor and collapse; the world steps at 1/60 s.
struct Fall {
  World world;
  std::vector<RagdollBone> bones;
  std::optional<Ragdoll> ragdoll;
  double size = 0, widest = 0, highest = -HUGE_VAL;

  explicit Fall(const SkinnedFigure& figure) : bones(fit_ragdoll(figure.hierarchy, figure.meshes, figure.world)) {
    ragdoll.emplace(world, bones, figure.world);
    double low = HUGE_VAL;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const Bounds box = bounds(bones[i].shape, world.motion(ragdoll->bodies()[i]).pose);
      low = std::min(low, box.low.y());
      size = std::max(size, (box.high - box.low).norm());
    }
    for (const Bounds& box : boxes()) size = std::max(size, box.high.y() - low);
    world.add({.shape = {Plane{Vec3(0, 1, 0), low - 0.2 * size}}, .fixed = true});
    floor = low - 0.2 * size;
  }
  double floor = 0;

  [[nodiscard]] std::vector<Bounds> boxes() const {
    std::vector<Bounds> result;
    for (std::size_t i = 0; i < bones.size(); ++i)
      result.push_back(bounds(bones[i].shape, world.motion(ragdoll->bodies()[i]).pose));
    return result;
  }
  void run(double seconds) {
    for (int i = 0; i < seconds * 60; ++i) {
      world.step(1.0 / 60);
      for (const JointId& joint : world.joints()) widest = std::max(widest, world.reading(joint).gap);
    }
    for (const Bounds& box : boxes()) highest = std::max(highest, box.high.y());
  }
};

}  // namespace

TEST_CASE("the sample character becomes a ragdoll whose bones are its limbs") {
  const Model model = load_model(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/character.glb");
  const std::optional<SkinnedFigure> figure = figure_of(model);
  REQUIRE(figure);
  const std::vector<RagdollBone> bones = fit_ragdoll(figure->hierarchy, figure->meshes, figure->world);
  CHECK(bones.size() >= 11);
  CHECK(bones.size() <= 21);
  double mass = 0;
  int roots = 0;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    mass += bones[i].mass;
    CHECK(bones[i].mass > 0);
    if (bones[i].parent == no_bone)
      ++roots;
    else
      CHECK(bones[i].parent < i);
  }
  CHECK(roots == 1);
  CHECK(mass == doctest::Approx(70).epsilon(1e-12));
  // Most of the skin is within its capsules, or near.
  const Mesh& mesh = *figure->meshes.front().mesh;
  std::vector<Vec3> vertices(mesh.positions.size());
  deform(mesh, {}, figure->meshes.front().skin, 0, figure->world, vertices);
  std::size_t inside = 0;
  for (const Vec3& vertex : vertices)
    for (const RagdollBone& bone : bones) {
      Shape grown = bone.shape;
      auto& capsule = std::get<Capsule>(grown.solid);
      capsule.radius *= 1.25;
      const Pose pose{figure->world[bone.node].motion.pose.position, figure->world[bone.node].motion.pose.rotation};
      if (collide({Sphere{1e-9}}, {.position = vertex}, grown, pose).count == 0) continue;
      ++inside;
      break;
    }
  CHECK(static_cast<double>(inside) > 0.9 * static_cast<double>(vertices.size()));

  CHECK_THROWS_AS(static_cast<void>(fit_ragdoll(figure->hierarchy, figure->meshes, figure->world,
                                                {.limits = {{"no such bone", SwingTwistJoint{}}}})),
                  std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(fit_ragdoll(figure->hierarchy, figure->meshes, figure->world, {.mass = -1})),
                  std::invalid_argument);
  Mesh bare = mesh;
  bare.influences = {};
  const std::vector<SkinnedMesh> unskinned{{&bare, figure->meshes.front().skin}};
  CHECK_THROWS_AS(static_cast<void>(fit_ragdoll(figure->hierarchy, unskinned, figure->world)), std::invalid_argument);
}

TEST_CASE("a ragdoll takes over the figure's pose and motion, and gives it back") {
  const Model model = load_model(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/character.glb");
  std::optional<SkinnedFigure> figure = figure_of(model);
  REQUIRE(figure);
  const std::vector<RagdollBone> bones = fit_ragdoll(figure->hierarchy, figure->meshes, figure->world);
  // Any pose that turns at every joint.
  test::Random random(5);
  for (std::size_t i = 0; i < figure->local.size(); ++i) {
    Motion& motion = figure->local[i];
    motion.pose.rotation = motion.pose.rotation * exp_map(0.3 * random.vector(1));
    motion.twist.angular = random.vector(1);
  }
  figure->local[0].twist.linear = Vec3(1, 2, 3);
  figure->hierarchy.world_motions(figure->local, figure->world);
  World world;
  const Ragdoll ragdoll(world, bones, figure->world);
  std::vector<Motion> back = figure->local;
  for (const RagdollBone& bone : bones) {
    back[bone.node].pose.rotation = Quat(1, 0, 0, 0);
    back[bone.node].twist = {};
  }
  for (const RagdollBone& bone : bones)
    if (bone.parent != no_bone) back[bone.node].twist.linear = figure->local[bone.node].twist.linear;
  ragdoll.pose(world, figure->hierarchy, back);
  std::vector<WorldMotion> again(back.size());
  figure->hierarchy.world_motions(back, again);
  for (const RagdollBone& bone : bones) {
    const Motion &is = again[bone.node].motion, &was = figure->world[bone.node].motion;
    CHECK((is.pose.position - was.pose.position).norm() < 1e-9);
    CHECK(std::abs(is.pose.rotation.dot(was.pose.rotation)) == doctest::Approx(1).epsilon(1e-12));
    CHECK((is.twist.linear - was.twist.linear).norm() < 1e-9);
    CHECK((is.twist.angular - was.twist.angular).norm() < 1e-9);
  }
  // Driven, it follows.
  ragdoll.set_drive(world, Drive::keyed());
  ragdoll.follow(world, figure->world);
  world.step(1.0 / 60);
  for (std::size_t i = 0; i < bones.size(); ++i)
    CHECK(world.motion(ragdoll.bodies()[i]).pose.position == figure->world[bones[i].node].motion.pose.position);
  ragdoll.remove(world);
  CHECK(world.bodies().empty());
  CHECK(world.joints().empty());
}

TEST_CASE("the sample character collapses and keeps together") {
  const Model model = load_model(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/character.glb");
  Fall fall(*figure_of(model));
  const double energy = fall.world.kinetic_energy();
  fall.run(6);
  CHECK(energy == 0);
  CHECK(fall.widest < 0.01);
  CHECK(fall.highest - fall.floor < 0.6 * fall.size);
  CHECK(fall.world.kinetic_energy() < 1);
}

TEST_CASE("a figure on a stage walks, is let go with the velocities of its walk, and collapses") {
  const Model model = load_model(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/character.glb");
  StageDescription described;
  for (const Node& node : model.nodes)
    described.nodes.push_back({.name = node.name, .parent = node.parent, .rest = node.rest});
  described.clips = model.clips;
  const auto named = [](const Clip& clip) { return clip.name == "WalkForward"; };
  const auto walk = std::find_if(model.clips.begin(), model.clips.end(), named);
  REQUIRE(walk != model.clips.end());
  described.plays = {{.clip = static_cast<std::size_t>(walk - model.clips.begin())}};
  described.meshes = model.meshes;
  described.skins = model.skins;
  described.mesh_instances = model.instances;
  const std::vector<RagdollBone> bones = add_ragdoll(described);
  NodeDescription floor;
  floor.name = "floor";
  floor.body.emplace();
  floor.body->shape.solid = Plane{};
  floor.body->fixed = true;
  described.nodes.push_back(floor);
  Rule let_go;
  for (const RagdollBone& bone : bones) let_go.bodies.push_back(described.nodes[bone.node].name);
  let_go.when = {{when::At{0.4}}};
  let_go.to = Drive::free();
  described.rules.push_back(let_go);
  Stage stage(described);
  stage.advance_to(0.4);
  CHECK(stage.handoffs().size() == bones.size());
  for (const HandOff& handoff : stage.handoffs()) {
    CHECK((handoff.after.twist.linear - handoff.before.twist.linear).norm() < 1e-9);
    CHECK((handoff.after.twist.angular - handoff.before.twist.angular).norm() < 1e-9);
  }
  double widest = 0;
  for (int i = 0; i < 60 * 4; ++i) {
    stage.advance_to(0.4 + (i + 1) / 60.0);
    for (const JointDescription& joint : described.joints) {
      const std::optional<JointReading> reading = stage.joint(joint.name);
      REQUIRE(reading);
      widest = std::max(widest, reading->gap);
    }
  }
  CHECK(widest < 0.01);
  for (const RagdollBone& bone : bones) CHECK(stage.world(bone.node).motion.pose.position.y() < 0.6);
}

TEST_CASE("every skinned model at hand becomes a ragdoll that falls without flying apart") {
  const std::filesystem::path folder = test::models_folder();
  if (!std::filesystem::exists(folder)) {
    MESSAGE("SKIPPED: no models in ", folder.string());
    return;
  }
  int figures = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    static const std::set<std::string> endings{".glb", ".gltf", ".fbx"};
    if (!endings.contains(entry.path().extension().string()) ||
        entry.path().string().find("malformed") != std::string::npos)
      continue;
    Model model;
    try {
      model = load_model(entry.path());
    } catch (const ModelError&) {
      continue;
    }
    const std::optional<SkinnedFigure> figure = figure_of(model);
    if (!figure) continue;
    CAPTURE(entry.path().filename().string());
    try {
      Fall fall(*figure);
      ++figures;
      fall.run(2);
      MESSAGE(entry.path().filename().string(), ": ", fall.bones.size(), " bones, joints apart ",
              fall.widest / fall.size, " of its size, ends ", (fall.highest - fall.floor) / fall.size, " high");
      CHECK(fall.widest < 0.05 * fall.size);
      CHECK(fall.highest - fall.floor < 2 * fall.size);
    } catch (const std::invalid_argument& refused) {
      MESSAGE(entry.path().filename().string(), " is refused: ", refused.what());
    }
  }
  CHECK(figures >= 3);
}

TEST_CASE("a word of a document gives an imported figure bodies and joints, and each figure a group of its own") {
  const std::filesystem::path folder = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents";
  const Document document = Document::parse(R"({
    "tweenfall": 1,
    "import": {"one": "character.glb", "two": "character.glb"},
    "nodes": {"floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}}},
    "play": [{"clip": "one/WalkForward"}],
    "world": {"ragdolls": {"one": {"mass": 60, "friction": 0.3, "limits": {"one/Head": {"swing": 20, "twist": 5}}}, "two": {"mass": 20}}},
    "handoff": [{"group": "one", "when": {"at": 0.5}, "to": "free"}]
  })",
                                            "figures.json", folder);
  const StageDescription& described = document.stage();
  std::uint64_t groups[2] = {};
  double mass[2] = {};
  int bodies[2] = {};
  for (const NodeDescription& node : described.nodes) {
    if (!node.body || node.name == "floor") continue;
    const int figure = node.name.starts_with("one/") ? 0 : 1;
    CHECK(node.group == (figure == 0 ? "one" : "two"));
    CHECK(node.body->friction == (figure == 0 ? 0.3 : RagdollBody{}.friction));
    groups[figure] |= node.body->groups;
    CHECK(node.body->collides_with == ~node.body->groups);
    mass[figure] += *node.body->mass;
    ++bodies[figure];
  }
  CHECK(groups[0] != groups[1]);
  CHECK((groups[0] & 1) == 0);
  CHECK(mass[0] == doctest::Approx(60));
  CHECK(mass[1] == doctest::Approx(20));
  CHECK(bodies[0] > 8);
  CHECK(bodies[0] == bodies[1]);
  CHECK(described.joints.size() == static_cast<std::size_t>(bodies[0] + bodies[1] - 2));
  Stage stage(described);
  stage.advance_to(2);
  CHECK(stage.handoffs().size() == static_cast<std::size_t>(bodies[0]));
  for (const NodeDescription& node : described.nodes)
    if (node.body && node.name.starts_with("one/"))
      CHECK(stage.world(stage.node(node.name)).motion.pose.position.y() < 1);
}

TEST_CASE("of two figures on a stage one is taken back to its walk, and the other lies as if alone") {
  const std::filesystem::path folder = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents";
  const auto described = [&](const std::string& rules) {
    return Document::parse(R"({
    "tweenfall": 1,
    "import": {"one": "character.glb", "two": "character.glb"},
    "nodes": {"floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}},
              "away": {"position": [8, 0, 0]}, "two/Character": {"parent": "away"}},
    "play": [{"clip": "one/WalkForward"}, {"clip": "two/WalkForward"}],
    "world": {"ragdolls": {"one": {"mass": 60}, "two": {"mass": 20}}},
    "handoff": [)" + rules + "]}",
                           "figures.json", folder)
        .stage();
  };
  const std::string
      fall_one = R"({"group": "one", "when": {"at": 0.5}, "to": "free"})",
      fall_two = R"({"group": "two", "when": {"at": 0.5}, "to": "free"})",
      rise_one =
          R"({"group": "one", "when": {"at": 1.5}, "to": "keyed", "path": {"clip": "one/WalkForward"}, "settle": {"quintic": 0.4}})";
  Stage both(described(fall_one + "," + fall_two + "," + rise_one)), walking(described("")), other(described(fall_two)),
      loaded(described(fall_one + "," + fall_two + "," + rise_one));
  both.advance_to(1.7);
  loaded.load(both.save());
  for (Stage* each : {&both, &walking, &other, &loaded}) each->advance_to(2.5);
  CHECK(loaded.state_hash() == both.state_hash());
  int one = 0, two = 0;
  for (const NodeDescription& node : both.description().nodes) {
    if (!node.body || node.name == "floor") continue;
    CAPTURE(node.name);
    const Motion now = both.world(both.node(node.name)).motion;
    if (node.name.starts_with("one/")) {
      const Motion walk = walking.world(walking.node(node.name)).motion;
      CHECK((now.pose.position - walk.pose.position).norm() < 1e-9);
      CHECK((now.twist.linear - walk.twist.linear).norm() < 1e-9);
      ++one;
    } else {
      const Motion alone = other.world(other.node(node.name)).motion;
      CHECK(now.pose.position == alone.pose.position);
      CHECK(now.pose.rotation.coeffs() == alone.pose.rotation.coeffs());
      CHECK(now.pose.position.y() < 1);
      ++two;
    }
  }
  CHECK(one > 8);
  CHECK(two == one);
  CHECK(both.handoffs().size() == static_cast<std::size_t>(3 * one));
}
