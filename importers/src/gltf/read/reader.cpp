#include "gltf/read/reader.h"

#include "gltf/physics/read_physics.h"
#include "gltf/read/accessors.h"
#include "gltf/read/animations.h"
#include "gltf/read/container.h"
#include "gltf/read/meshes.h"
#include "gltf/read/nodes.h"

#include <iterator>
#include <map>
#include <set>
#include <span>

namespace tweenfall::gltf {

namespace {

/// Assembles the model from the file's parts, once all of them are known to be valid.
class Assembly {
 public:
  Assembly(std::vector<FileNode> nodes, std::vector<FileMesh> meshes, std::vector<Skin> skins,
           models::ModelProblems& problems)
      : nodes_(std::move(nodes)), meshes_(std::move(meshes)), skins_(std::move(skins)), problems_(problems) {}

  void check() const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const FileNode& node = nodes_[i];
      const std::string place = "/nodes/" + std::to_string(i);
      if (!node.mesh) continue;
      const FileMesh& mesh = meshes_[*node.mesh];
      if (!node.weights.empty() && node.weights.size() != mesh.morphs)
        problems_.add(place + "/weights", "has " + std::to_string(node.weights.size()) + " weights for " +
                                              std::to_string(mesh.morphs) + " morph targets");
      if (!node.skin) continue;
      for (const std::size_t joints : mesh.joint_counts)
        if (joints > skins_[*node.skin].joints.size())
          problems_.add("/meshes/" + std::to_string(*node.mesh), "joint " + std::to_string(joints - 1) +
                                                                     " points past the " +
                                                                     std::to_string(skins_[*node.skin].joints.size()) +
                                                                     " joints of skin " + std::to_string(*node.skin));
    }
  }

  void put_into(Model& model) {
    const std::vector<std::size_t> order = parents_first(nodes_);
    std::vector<std::size_t> place(nodes_.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    for (const std::size_t i : order) {
      Node node = nodes_[i].node;
      if (node.parent != no_node) node.parent = place[node.parent];
      model.nodes.push_back(std::move(node));
    }
    for (FileMesh& mesh : meshes_) {
      first_.push_back(model.meshes.size());
      model.meshes.insert(model.meshes.end(), std::make_move_iterator(mesh.primitives.begin()),
                          std::make_move_iterator(mesh.primitives.end()));
      counts_.push_back(mesh.primitives.size());
    }
    for (Skin& skin : skins_) {
      for (std::size_t& joint : skin.joints) joint = place[joint];
      model.skins.push_back(std::move(skin));
    }
    for (const std::size_t i : order) hang(nodes_[i], place[i], model);
    for (ModelBody& body : model.bodies) body.node = place[body.node];
    for (JointDescription& joint : model.joints) {
      if (joint.a != no_node) joint.a = place[joint.a];
      joint.b = place[joint.b];
    }
  }

 private:
  void hang(const FileNode& node, std::size_t index, Model& model) {
    if (!node.mesh || !node.in_scene) return;
    for (std::size_t k = 0; k < counts_[*node.mesh]; ++k) {
      std::size_t mesh = first_[*node.mesh] + k;
      if (!node.weights.empty() && node.weights != model.meshes[mesh].rest_weights) {
        mesh = copy_with_weights(mesh, node.weights, model);
      }
      model.instances.push_back({index, mesh, node.skin.value_or(no_node)});
    }
  }

  /// A node's own weights override those of its mesh, which other nodes may share.
  std::size_t copy_with_weights(std::size_t mesh, const std::vector<double>& weights, Model& model) {
    const auto known = copies_.find({mesh, weights});
    if (known != copies_.end()) return known->second;
    constexpr std::size_t most_copied = std::size_t{1} << 24;
    copied_ += model.meshes[mesh].positions.size() * (1 + weights.size());
    if (copied_ > most_copied) {
      problems_.repair("/nodes", "too many nodes have morph weights of their own; some show their mesh's");
      return mesh;
    }
    Mesh own = model.meshes[mesh];
    own.rest_weights = weights;
    model.meshes.push_back(std::move(own));
    return copies_[{mesh, weights}] = model.meshes.size() - 1;
  }

  std::vector<FileNode> nodes_;
  std::vector<FileMesh> meshes_;
  std::vector<Skin> skins_;
  models::ModelProblems& problems_;
  std::map<std::pair<std::size_t, std::vector<double>>, std::size_t> copies_;
  std::size_t copied_ = 0;
  std::vector<std::size_t> first_, counts_;
};

void tell_of_textures(const Fields& root) {
  std::size_t textured = 0;
  for (std::size_t i = 0; i < root.list("materials").size(); ++i)
    textured += root.at("materials", i).inside("pbrMetallicRoughness").has("baseColorTexture");
  if (textured)
    root.problems().repair("/materials", "textures are not read; " +
                                             models::counted(textured, "material shows its base color factor alone",
                                                             "materials show their base color factor alone"));
}

/// Whether a track only holds its node where it is: many programs write such tracks for nodes that never move.
bool holds_still(const Track& track, const Pose& rest) {
  constexpr double rounding = 1e-6;  // of single precision
  const auto stays = [](const auto& curve, const auto& is_rest) {
    const std::span<const double> knots = curve.knots();
    if (knots.empty()) return is_rest(curve.value(0));
    for (std::size_t i = 0; i < knots.size(); ++i)
      for (const double part : {0.0, 0.25, 0.5, 0.75})
        if (!is_rest(curve.value(knots[i] + part * (i + 1 < knots.size() ? knots[i + 1] - knots[i] : 0)))) return false;
    return true;
  };
  if (const auto* turn = std::get_if<Curve<Quat>>(&track.curve))
    return stays(*turn, [&](const Quat& at) { return at.angularDistance(rest.rotation) < rounding; });
  const auto* vector = std::get_if<Curve<Vec3>>(&track.curve);
  const Vec3& own = track.property == "scale" ? rest.scale : rest.position;
  return vector && stays(*vector, [&](const Vec3& at) { return (at - own).norm() < rounding * (1 + own.norm()); });
}

/// By node: whether a clip moves it or an ancestor.
std::vector<char> moved_by(const std::vector<Clip>& clips, const std::vector<FileNode>& nodes) {
  std::map<std::string_view, const Pose*> rests;
  for (const FileNode& node : nodes) rests.emplace(node.node.name, &node.node.rest);
  std::set<std::string_view> names;
  for (const Clip& clip : clips)
    for (const Track& track : clip.tracks) {
      const auto rest = rests.find(track.node);
      if (track.property == "weights" || (rest != rests.end() && holds_still(track, *rest->second))) continue;
      names.insert(track.node);
    }
  std::vector<char> moved(nodes.size(), 0);
  for (const std::size_t i : parents_first(nodes)) {
    const std::size_t parent = nodes[i].node.parent;
    moved[i] = names.contains(nodes[i].node.name) || (parent != no_node && moved[parent]) ? 1 : 0;
  }
  return moved;
}

}  // namespace

Model read(std::string_view bytes, const std::filesystem::path& file, models::ModelProblems& problems) {
  const Container container = open_container(bytes, file, problems);
  // In a broken container every part would be reported as a fault of its own.
  const auto where = [&](const std::string& place) { return place_in(container, place); };
  problems.throw_if_any(file, where);
  const Fields root(container.document.root(), "", problems);
  Accessors accessors(container, problems);
  std::vector<FileNode> nodes = read_nodes(root);
  std::vector<FileMesh> meshes = read_meshes(root, accessors);
  std::vector<Skin> skins = read_skins(root, accessors);
  Model model;
  model.clips = read_animations(root, accessors, nodes, meshes);
  const physics::FileScene scene{root, nodes, meshes, moved_by(model.clips, nodes)};
  model.bodies = physics::read_bodies(scene);
  model.joints = physics::read_joints(scene, model.bodies);
  tell_of_textures(root);
  Assembly assembly(std::move(nodes), std::move(meshes), std::move(skins), problems);
  assembly.check();
  problems.throw_if_any(file, where);
  assembly.put_into(model);
  return model;
}

}  // namespace tweenfall::gltf
