#include "recording/recording_model.h"

#include "figures/figures.h"
#include "figures/shape_mesh.h"
#include "recording/meshes/dressed.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/importers/recording_file.h>

#include <map>
#include <stdexcept>

namespace tweenfall::recordings {

namespace {

Color owner_color(Owner owner, bool fixed) {
  if (fixed) return Color{Vec4(0.3, 0.3, 0.3, 1)};
  if (owner == Owner::keyed) return Color{Vec4(0.05, 0.17, 0.72, 1)};
  return owner == Owner::driven ? Color{Vec4(0.64, 0.05, 0.25, 1)} : Color{Vec4(0.83, 0.3, 0.01, 1)};
}

bool same(const Vec3& a, const Vec3& b) {
  return a == b;
}
bool same(const Quat& a, const Quat& b) {
  return a.coeffs() == b.coeffs();
}
bool same(double a, double b) {
  return a == b;
}

/// Keys frame by frame, joined by straight lines; of constant stretches, only the first and the last.
template <class T, class ValueAt>
Curve<T> baked(const std::vector<double>& times, ValueAt value_at) {
  std::vector<Key<T>> keys;
  for (std::size_t frame = 0; frame < times.size(); ++frame) {
    const T value = value_at(frame);
    const bool repeats =
        frame > 0 && frame + 1 < times.size() && same(value, value_at(frame - 1)) && same(value, value_at(frame + 1));
    if (!repeats) keys.push_back({times[frame], value, Ease::linear()});
  }
  if (keys.size() == 2 && same(keys[0].value, keys[1].value)) keys.pop_back();
  return keyed_curve<T>(std::span<const Key<T>>(keys));
}

void add_tracks(Clip& clip, const NodeRecord& node, const std::vector<double>& times) {
  const auto pose = [&](std::size_t frame) -> const Pose& { return node.world[frame].motion.pose; };
  clip.tracks.push_back({node.name, "position", baked<Vec3>(times, [&](std::size_t i) { return pose(i).position; })});
  clip.tracks.push_back({node.name, "rotation", baked<Quat>(times, [&](std::size_t i) { return pose(i).rotation; })});
  bool scales = false;
  for (std::size_t frame = 1; frame < times.size(); ++frame) scales |= !same(pose(frame).scale, pose(0).scale);
  if (scales)
    clip.tracks.push_back({node.name, "scale", baked<Vec3>(times, [&](std::size_t i) { return pose(i).scale; })});
  if (node.weights.empty() || node.weights.front().empty()) return;
  WeightCurves weights;
  for (std::size_t k = 0; k < node.weights.front().size(); ++k)
    weights.push_back(
        baked<double>(times, [&](std::size_t i) { return k < node.weights[i].size() ? node.weights[i][k] : 0; }));
  clip.tracks.push_back({node.name, "weights", std::move(weights)});
}

/// The stage's own meshes on the recorded nodes.
void add_meshes(Model& model, const StageDescription& stage, std::vector<bool>& dressed) {
  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) index_of.emplace(model.nodes[i].name, i);
  const auto recorded = [&](std::size_t node) {
    if (node >= stage.nodes.size()) return no_node;
    const auto found = index_of.find(stage.nodes[node].name);
    return found == index_of.end() ? no_node : found->second;
  };
  model.meshes = stage.meshes;
  model.skins = stage.skins;
  std::vector<bool> whole(model.skins.size(), true);
  for (std::size_t i = 0; i < model.skins.size(); ++i)
    for (std::size_t& joint : model.skins[i].joints) {
      joint = recorded(joint);
      if (joint == no_node) {
        whole[i] = false;
        joint = 0;
      }
    }
  for (MeshInstance instance : stage.mesh_instances) {
    instance.node = recorded(instance.node);
    const bool skinned = instance.skin < model.skins.size();
    if (instance.node == no_node || instance.mesh >= model.meshes.size() || (skinned && !whole[instance.skin]))
      continue;
    model.instances.push_back(instance);
    dressed[instance.node] = true;
    if (skinned)
      for (const std::size_t joint : model.skins[instance.skin].joints) dressed[joint] = true;
  }
}

/// Bodies, joints and who passes through whom as they are at the recording's start.
void add_physics(Model& model, const Recording& recording, const StageDescription& stage,
                 const std::vector<const NodeDescription*>& described) {
  std::map<std::string_view, std::size_t> index_of;
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
    if (!described[i] || !described[i]->body) continue;
    const BodyDescription& body = *described[i]->body;
    model.bodies.push_back({i, body, !body.fixed && recording.nodes[i].owner.front() == Owner::keyed});
    index_of.emplace(recording.nodes[i].name, i);
  }
  const auto recorded = [&](std::size_t& node) {
    if (node == no_node) return true;
    const auto found = node < stage.nodes.size() ? index_of.find(stage.nodes[node].name) : index_of.end();
    if (found == index_of.end()) return false;
    node = found->second;
    return true;
  };
  for (JointDescription joint : stage.joints)
    if (recorded(joint.a) && recorded(joint.b)) model.joints.push_back(std::move(joint));
  for (auto [a, b] : stage.ignored)
    if (recorded(a) && recorded(b)) model.ignored.emplace_back(a, b);
}

}  // namespace

Model recording_model(const Recording& recording, const StageDescription& stage) {
  check_drawable(recording, stage);
  if (recording.times.empty())
    throw std::invalid_argument("recording \"" + recording.name + "\" has no frames to write");
  if (const auto dressed = with_own_meshes(recording, stage, true))
    return recording_model(dressed->recording, dressed->stage);
  Model model;
  model.name = recording.name.empty() ? stage.name : recording.name;
  Clip clip;
  clip.name = "recording";
  clip.duration = recording.times.back();
  for (const NodeRecord& node : recording.nodes) {
    model.nodes.push_back({.name = node.name, .rest = node.world.front().motion.pose});
    add_tracks(clip, node, recording.times);
  }
  model.clips.push_back(std::move(clip));

  std::vector<bool> dressed(recording.nodes.size(), false);
  add_meshes(model, stage, dressed);
  const auto described = figures::descriptions(recording, stage);
  add_physics(model, recording, stage, described);
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
    if (!described[i] || !described[i]->body || dressed[i]) continue;
    Mesh mesh = figures::shape_mesh(described[i]->body->shape);
    mesh.name = recording.nodes[i].name;
    mesh.base_color = described[i]->color ? *described[i]->color
                                          : owner_color(recording.nodes[i].owner.front(), described[i]->body->fixed);
    model.instances.push_back({.node = i, .mesh = model.meshes.size(), .skin = no_node});
    model.meshes.push_back(std::move(mesh));
  }
  return model;
}

}  // namespace tweenfall::recordings
