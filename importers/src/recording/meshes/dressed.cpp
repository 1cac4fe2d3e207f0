#include "recording/meshes/dressed.h"

#include <algorithm>
#include <utility>

namespace tweenfall::recordings {

void Dressed::add(NodeRecord node, std::string name, Mesh mesh) {
  stage.meshes.push_back(std::move(mesh));
  add_shown(std::move(node), std::move(name), stage.meshes.size() - 1);
}

void Dressed::add_shown(NodeRecord node, std::string name, std::size_t mesh) {
  while (std::ranges::any_of(recording.nodes, [&](const NodeRecord& other) { return other.name == name; }))
    name += " (shown)";
  node.name = name;
  node.twist.resize(recording.times.size());
  node.owner.resize(recording.times.size(), Owner::free);
  node.world.resize(recording.times.size());
  NodeDescription place;
  place.name = std::move(name);
  stage.mesh_instances.push_back({.node = stage.nodes.size(), .mesh = mesh, .skin = no_node});
  stage.nodes.push_back(std::move(place));
  recording.nodes.push_back(std::move(node));
}

std::optional<Dressed> with_own_meshes(const Recording& recording, const StageDescription& stage, bool particles) {
  const bool softs = !recording.softs.empty() && recording.softs.size() == stage.softs.size();
  const bool dots = particles && !recording.particles.empty();
  if (recording.times.empty() || (!softs && recording.vehicles.empty() && !dots)) return {};
  Dressed out{recording, stage};
  if (softs) add_soft_meshes(out);
  add_wheel_meshes(out);
  if (dots) {
    add_particle_meshes(out);
    out.recording.particles.clear();
  }
  out.recording.softs.clear();
  out.recording.vehicles.clear();
  return out;
}

}  // namespace tweenfall::recordings
