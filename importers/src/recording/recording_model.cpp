#include "recording/recording_model.h"

#include "recording/shape_mesh.h"

#include <tweenfall/curves/keys.h>

#include <map>
#include <string>

namespace tweenfall {

namespace {

/// A key a frame, straight between; one key for what never changes.
template <class T, class Read>
Curve<T> frames(const std::vector<double>& times, const Read& read) {
  std::vector<Key<T>> keys;
  bool changes = false;
  for (std::size_t i = 0; i < times.size(); ++i) {
    keys.push_back({.time = times[i], .value = read(i), .ease = Ease::linear()});
    if constexpr (std::is_same_v<T, Quat>)
      changes = changes || keys[i].value.coeffs() != keys[0].value.coeffs();
    else
      changes = changes || keys[i].value != keys[0].value;
  }
  if (!changes) keys.resize(1);
  return keyed_curve<T>(keys);
}

void add_tracks(const NodeRecord& record, const std::vector<double>& times, Clip& clip) {
  const auto pose = [&](std::size_t i) -> const Pose& { return record.world[i].motion.pose; };
  clip.tracks.push_back(
      {record.name, "position", frames<Vec3>(times, [&](std::size_t i) { return pose(i).position; })});
  clip.tracks.push_back(
      {record.name, "rotation", frames<Quat>(times, [&](std::size_t i) { return pose(i).rotation; })});
  clip.tracks.push_back({record.name, "scale", frames<Vec3>(times, [&](std::size_t i) { return pose(i).scale; })});
  if (record.weights.empty()) return;
  WeightCurves curves;
  for (std::size_t target = 0; target < record.weights.front().size(); ++target)
    curves.push_back(frames<double>(times, [&](std::size_t i) { return record.weights[i][target]; }));
  clip.tracks.push_back({record.name, "weights", std::move(curves)});
}

Color owner_color(const NodeRecord& record) {
  if (!record.color.empty()) return record.color.front();
  const Owner owner = record.owner.empty() ? Owner::keyed : record.owner.front();
  if (owner == Owner::free) return Color{Vec4(0.73, 0.24, 0.01, 1)};
  if (owner == Owner::driven) return Color{Vec4(0.52, 0.02, 0.18, 1)};
  return Color{Vec4(0.04, 0.13, 0.68, 1)};
}

}  // namespace

Model recording_model(const Recording& recording, const StageDescription& stage) {
  Model model;
  model.name = recording.name;
  Clip clip;
  clip.name = recording.name.empty() ? "recording" : recording.name;
  clip.duration = recording.times.empty() ? 0 : recording.times.back();

  std::map<std::string, std::size_t> node_of;
  for (const NodeRecord& record : recording.nodes) {
    node_of.emplace(record.name, model.nodes.size());
    Node node{record.name, no_node, {}};
    if (!record.world.empty()) node.rest = record.world.front().motion.pose;
    model.nodes.push_back(std::move(node));
    if (!recording.times.empty()) add_tracks(record, recording.times, clip);
  }
  if (!clip.tracks.empty()) model.clips.push_back(std::move(clip));

  // The description's nodes by their places in the model; nodes that were not recorded are left out.
  const auto recorded = [&](std::size_t node) {
    const auto found = node < stage.nodes.size() ? node_of.find(stage.nodes[node].name) : node_of.end();
    return found == node_of.end() ? no_node : found->second;
  };
  model.meshes = stage.meshes;
  model.skins = stage.skins;
  for (Skin& skin : model.skins)
    for (std::size_t& joint : skin.joints) joint = recorded(joint);
  std::vector<char> drawn(model.nodes.size(), 0);
  for (MeshInstance instance : stage.mesh_instances) {
    instance.node = recorded(instance.node);
    if (instance.node == no_node) continue;
    drawn[instance.node] = 1;
    if (instance.skin != no_node)
      for (const std::size_t joint : model.skins[instance.skin].joints)
        if (joint != no_node) drawn[joint] = 1;  // a skinned limb shows its own mesh, not its collider
    model.instances.push_back(instance);
  }
  for (std::size_t i = 0; i < stage.nodes.size(); ++i) {
    const std::size_t node = recorded(i);
    if (!stage.nodes[i].body || node == no_node || drawn[node]) continue;
    Mesh mesh = shape_mesh(stage.nodes[i].body->shape);
    mesh.name = stage.nodes[i].name;
    mesh.base_color = owner_color(recording.nodes[node]);
    model.instances.push_back({.node = node, .mesh = model.meshes.size(), .skin = no_node});
    model.meshes.push_back(std::move(mesh));
  }
  return model;
}

}  // namespace tweenfall
