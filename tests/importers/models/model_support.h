#pragma once

// A model's clips played through the animation module, to check what was read against other programs' poses.

#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/skinning.h>
#include <tweenfall/importers/model.h>

#include <memory>
#include <vector>

namespace tweenfall::test {

/// Where everything of a model is at one time.
class Posed {
 public:
  explicit Posed(const Model& model)
      : model_(model), nodes_(std::make_shared<const Hierarchy>(model.nodes)), world_(model.nodes.size()) {
    rest();
  }

  void rest() {
    std::vector<Motion> local;
    for (const Node& node : nodes_->nodes()) local.push_back({node.rest, {}, {0, 0, 0}});
    nodes_->world_motions(local, world_);
    looks_.assign(world_.size(), {});
  }

  void play(std::size_t clip) {
    Play play;
    play.clip = clip;
    animation_ = std::make_unique<Animation>(nodes_, model_.clips, std::vector<Play>{play});
  }

  void at(double time) {
    std::vector<Motion> local(world_.size());
    animation_->sample(time, local);
    nodes_->world_motions(local, world_);
    for (std::size_t i = 0; i < world_.size(); ++i) {
      looks_[i].clear();
      for (const Sample<double>& weight : animation_->look(i, time).weights) looks_[i].push_back(weight.value);
    }
  }

  [[nodiscard]] const WorldMotion& world(std::size_t node) const { return world_[node]; }
  [[nodiscard]] std::size_t find(const std::string& name) const { return nodes_->find(name).value_or(no_node); }

  [[nodiscard]] std::vector<double> weights(const MeshInstance& instance) const {
    return looks_[instance.node].empty() ? model_.meshes[instance.mesh].rest_weights : looks_[instance.node];
  }

  [[nodiscard]] std::vector<Vec3> vertices(const MeshInstance& instance) const {
    const Mesh& mesh = model_.meshes[instance.mesh];
    std::vector<Vec3> out(mesh.positions.size());
    const Skin* skin = instance.skin == no_node ? nullptr : &model_.skins[instance.skin];
    const std::vector<double> in_force = weights(instance);
    deform(mesh, in_force, skin, instance.node, world_, out);
    return out;
  }

  /// How each joint of its skin, or its node, has carried it.
  [[nodiscard]] std::vector<SkinJoint> joints(const MeshInstance& instance) const {
    if (instance.skin == no_node) return {skin_joint(world_[instance.node])};
    std::vector<SkinJoint> result(model_.skins[instance.skin].joints.size());
    skin_joints(model_.skins[instance.skin], world_, result);
    return result;
  }

 private:
  const Model& model_;
  std::shared_ptr<const Hierarchy> nodes_;
  std::unique_ptr<Animation> animation_;
  std::vector<WorldMotion> world_;
  std::vector<std::vector<double>> looks_;
};

/// A column-major matrix of sixteen numbers.
inline WorldMotion world_of(const nlohmann::json& matrix) {
  WorldMotion world;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) {
      const double number = matrix[static_cast<std::size_t>(4 * column + row)].get<double>();
      (column < 3 ? world.linear(row, column) : world.motion.pose.position[row]) = number;
    }
  return world;
}

/// Largest difference over the elements of two placements, over max(1, largest element expected).
inline double world_error(const WorldMotion& actual, const WorldMotion& expected) {
  const Vec3 &got = actual.motion.pose.position, &wanted = expected.motion.pose.position;
  if (!got.allFinite() || !actual.linear.allFinite()) return 1e30;
  const double size = std::max({1.0, expected.linear.cwiseAbs().maxCoeff(), wanted.cwiseAbs().maxCoeff()});
  return std::max((actual.linear - expected.linear).cwiseAbs().maxCoeff(), (got - wanted).cwiseAbs().maxCoeff()) / size;
}

inline Vec3 point_of(const nlohmann::json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

/// All files of a folder whose names end like this, in order; empty, and reported loudly, if the folder is absent.
inline std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& endings) {
  std::vector<std::filesystem::path> all;
  if (!std::filesystem::is_directory(folder)) {
    MESSAGE("SKIPPED: no folder " << folder.string());
    return all;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() &&
        (endings.empty() || std::find(endings.begin(), endings.end(), ending) != endings.end()))
      all.push_back(entry.path());
  }
  std::sort(all.begin(), all.end());
  CHECK_MESSAGE(!all.empty(), "no file of these endings in " << folder.string());
  return all;
}

/// A folder of the test's own, gone when the test ends.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("tweenfall-" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tweenfall::test
