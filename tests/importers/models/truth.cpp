// Models of other people against poses from other programs (three.js, ufbx, an evaluator of BVH).

#include "importers/models/model_support.h"

#include <map>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

struct Errors {
  double rest = 0, world = 0, vertices = 0, weights = 0;
  double skinned = 0;  // of vertices by the joints of a pose
  double outside = 0;  // by which the quick bounds miss the box
  std::string where;

  void world_at(double error, const std::string& place) {
    if (error > world) {
      world = error;
      where = place;
    }
  }
};

/// Where `world` is for someone at `root`.
WorldMotion seen_from(const WorldMotion& root, const WorldMotion& world) {
  const Mat3 back = root.linear.inverse();
  WorldMotion result;
  result.linear = back * world.linear;
  result.motion.pose.position = back * (world.motion.pose.position - root.motion.pose.position);
  return result;
}

class Comparison {
 public:
  Comparison(const Model& model, const nlohmann::json& truth, bool named_by_index, bool below_root = false)
      : model_(model), truth_(truth), posed_(model), below_root_(below_root) {
    std::map<std::string, int> seen;
    for (const auto& node : truth["nodes"]) {
      std::string name = node["name"].is_string() ? node["name"].get<std::string>() : "";
      if (named_by_index && name.empty()) name = "node_" + std::to_string(node["index"].get<int>());
      if (const int count = ++seen[name]; count > 1) name += "#" + std::to_string(count);
      const std::size_t found = name.empty() ? no_node : posed_.find(name);
      if (found == no_node && !name.empty()) missing_.push_back(name);
      ours_.push_back(found);
    }
  }

  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

  Errors run(bool vertices) {
    Errors errors;
    posed_.rest();
    compare(truth_["rest"], vertices, "rest", errors);
    errors.rest = errors.world;
    errors.world = 0;
    const auto& animations = truth_["animations"];
    for (const auto& animation : animations) {
      const std::size_t i = animation["index"].get<std::size_t>();
      REQUIRE(i < model_.clips.size());
      if (animation.contains("duration"))
        CHECK(model_.clips[i].duration == doctest::Approx(animation["duration"].get<double>()));
      posed_.play(i);
      for (const auto& sample : animation["samples"]) {
        const double time = sample["t"].get<double>();
        posed_.at(time);
        compare(sample, vertices, model_.clips[i].name + " at " + std::to_string(time) + " s", errors);
      }
    }
    return errors;
  }

 private:
  void compare(const nlohmann::json& expected, bool vertices, const std::string& place, Errors& errors) {
    for (std::size_t i = 0; i < ours_.size(); ++i) {
      if (ours_[i] == no_node || i >= expected["world"].size() || expected["world"][i].is_null()) continue;
      const WorldMotion got =
          below_root_ ? seen_from(posed_.world(ours_[0]), posed_.world(ours_[i])) : posed_.world(ours_[i]);
      const WorldMotion wanted = below_root_ ? seen_from(world_of(expected["world"][0]), world_of(expected["world"][i]))
                                             : world_of(expected["world"][i]);
      errors.world_at(world_error(got, wanted), place + ", node " + model_.nodes[ours_[i]].name);
    }
    if (!vertices) return;
    for (std::size_t k = 0; k < expected["meshes"].size(); ++k)
      compare_mesh(truth_["meshes"][k], expected["meshes"][k], errors);
  }

  void compare_mesh(const nlohmann::json& mesh, const nlohmann::json& expected, Errors& errors) {
    const std::size_t node = ours_[mesh["node"].get<std::size_t>()];
    std::size_t primitive = mesh.value("primitive", std::size_t{0});
    const MeshInstance* instance = nullptr;
    for (const MeshInstance& each : model_.instances)
      if (each.node == node && primitive-- == 0) {
        instance = &each;
        break;
      }
    REQUIRE(instance != nullptr);
    const std::vector<Vec3> points = posed_.vertices(*instance);
    Vec3 low = points[0], high = points[0];
    for (const Vec3& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    const Vec3 wanted_low = point_of(expected["min"]), wanted_high = point_of(expected["max"]);
    const double size = std::max((wanted_high - wanted_low).norm(), 1e-30);
    errors.vertices = std::max({errors.vertices, (low - wanted_low).cwiseAbs().maxCoeff() / size,
                                (high - wanted_high).cwiseAbs().maxCoeff() / size});
    if (mesh.contains("vertices"))
      for (std::size_t i = 0; i < mesh["vertices"].size(); ++i)
        errors.vertices = std::max(
            errors.vertices,
            (points[mesh["vertices"][i].get<std::size_t>()] - point_of(expected["points"][i])).cwiseAbs().maxCoeff() /
                size);
    compare_skinned(*instance, points, wanted_low, wanted_high, size, errors);
    if (!expected.contains("weights")) return;
    const std::vector<double> weights = posed_.weights(*instance);
    REQUIRE(weights.size() == expected["weights"].size());
    for (std::size_t i = 0; i < weights.size(); ++i)
      errors.weights = std::max(errors.weights, std::abs(weights[i] - expected["weights"][i].get<double>()));
  }

  void compare_skinned(const MeshInstance& instance, const std::vector<Vec3>& points, const Vec3& low, const Vec3& high,
                       double size, Errors& errors) {
    const Mesh& mesh = model_.meshes[instance.mesh];
    const std::vector<SkinJoint> joints = posed_.joints(instance);
    const std::vector<double> weights = posed_.weights(instance);
    std::vector<Vec3> skinned(points.size());
    deform(mesh, joints, {.weights = weights}, {.positions = skinned});
    for (std::size_t i = 0; i < points.size(); ++i)
      errors.skinned = std::max(errors.skinned, (skinned[i] - points[i]).cwiseAbs().maxCoeff() / size);
    const MeshBounds quick = SkinBounds(mesh, joints.size()).world(joints, weights);
    errors.outside =
        std::max({errors.outside, (quick.low - low).maxCoeff() / size, (high - quick.high).maxCoeff() / size});
  }

  const Model& model_;
  const nlohmann::json& truth_;
  Posed posed_;
  std::vector<std::size_t> ours_;
  std::vector<std::string> missing_;
  bool below_root_;
};

/// What another program says about a model; each model that is there has one.
nlohmann::json truth_of(const std::filesystem::path& file) {
  const auto path = models_folder() / "truth" / (file.filename().string() + ".json");
  REQUIRE_MESSAGE(std::filesystem::exists(path), "a model without a truth: " << file.string());
  return read_json(path);
}

double tolerance_of(const nlohmann::json& truth, const char* name) {
  return truth["tolerance"].value(name, truth["tolerance"]["world"].get<double>());
}

}  // namespace

TEST_CASE("every glTF model stands, bends and molds where three.js says it does") {
  for (const auto& file : files_in(models_folder() / "gltf", {".gltf", ".glb"})) {
    const nlohmann::json truth = truth_of(file);
    CAPTURE(file.filename().string());
    const Model model = load_model(file);
    Comparison comparison(model, truth, true);
    CHECK(comparison.missing().empty());
    const Errors errors = comparison.run(true);
    CAPTURE(errors.where);
    CHECK(errors.rest <= tolerance_of(truth, "world"));
    CHECK(errors.world <= tolerance_of(truth, "world"));
    CHECK(errors.vertices <= tolerance_of(truth, "verticesRelBbox"));
    CHECK(errors.skinned <= 1e-12);
    CHECK(errors.outside <= tolerance_of(truth, "verticesRelBbox"));
    CHECK(errors.weights <= tolerance_of(truth, "world"));
  }
}

TEST_CASE("every BVH skeleton stands on its frames where an independent evaluator says it does") {
  for (const auto& file : files_in(models_folder() / "bvh", {".bvh"})) {
    const nlohmann::json truth = truth_of(file);
    CAPTURE(file.filename().string());
    const Model model = load_model(file);
    Comparison comparison(model, truth, false);
    CHECK(comparison.missing().empty());
    const Errors errors = comparison.run(false);
    CAPTURE(errors.where);
    CHECK(errors.rest <= tolerance_of(truth, "world"));
    CHECK(errors.world <= tolerance_of(truth, "world"));
  }
}

TEST_CASE("every FBX model stands, bends and molds where ufbx says it does") {
  for (const auto& file : files_in(models_folder() / "fbx", {".fbx"})) {
    const nlohmann::json truth = truth_of(file);
    const std::string name = file.filename().string();
    CAPTURE(name);
    const Model model = load_model(file);
    CHECK(model.clips.size() == truth["animations"].size());
    Comparison comparison(model, truth, false);
    // The authoring program's own cameras are no part of the scene.
    for (const std::string& node : comparison.missing())
      CHECK_MESSAGE((node.starts_with("Producer ") || node == "Camera Switcher"), "not found: " << node);
    const Errors errors = comparison.run(true);
    CAPTURE(errors.where);
    CHECK(errors.rest <= tolerance_of(truth, "world"));
    CHECK(errors.world <= tolerance_of(truth, "world"));
    CHECK(errors.vertices <= tolerance_of(truth, "world"));
    CHECK(errors.skinned <= 1e-12);
    CHECK(errors.outside <= tolerance_of(truth, "world"));
    CHECK(errors.weights <= tolerance_of(truth, "world"));
  }
}

TEST_CASE("Collada models stand, seen from their scene's root, where three.js says they do") {
  for (const auto& file : files_in(models_folder() / "dae", {".dae"})) {
    const nlohmann::json truth = truth_of(file);
    CAPTURE(file.filename().string());
    const Model model = load_model(file);
    Comparison comparison(model, truth, false, true);
    CHECK(comparison.missing().empty());
    const Errors errors = comparison.run(false);
    CAPTURE(errors.where);
    CHECK(errors.rest <= tolerance_of(truth, "world"));
    CHECK(errors.world <= tolerance_of(truth, "world"));
  }
}
