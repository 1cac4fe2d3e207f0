#include "document/shapes/mesh_named.h"

#include "document/report/suggestion.h"

#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace tweenfall::document::shapes {

namespace {

// Appends a mesh transformed by poses, the last one first; mirrored triangles are reversed.
void append_posed(SurfaceMesh& all, const Mesh& mesh, const std::vector<Pose>& poses) {
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  bool mirrored = false;
  for (const Pose& pose : poses) mirrored = mirrored != (pose.scale.prod() < 0);
  all.positions.reserve(all.positions.size() + mesh.positions.size());
  for (Vec3 place : mesh.positions) {
    for (const Pose& pose : poses) place = transform_point(pose, place);
    all.positions.push_back(place);
  }
  all.triangles.reserve(all.triangles.size() + mesh.triangles.size());
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const std::uint32_t a = first + mesh.triangles[i], b = first + mesh.triangles[i + 1],
                        c = first + mesh.triangles[i + 2];
    for (const std::uint32_t corner : {a, mirrored ? c : b, mirrored ? b : c}) all.triangles.push_back(corner);
  }
}

}  // namespace

std::optional<SurfaceMesh> mesh_named(const json::Value& name, Building& building) {
  const StageDescription& stage = building.stage;
  const std::string wanted(name.text());
  const bool is_import = building.imports.contains(wanted);
  const auto found = building.nodes.find(wanted);
  const std::size_t node = found == building.nodes.end() ? no_node : found->second;
  const std::string beginning = wanted + "/";
  SurfaceMesh all;
  bool bent = false;
  std::set<std::string> known(building.imports.begin(), building.imports.end());
  for (const MeshInstance& instance : stage.mesh_instances) {
    const std::string& carrier = stage.nodes[instance.node].name;
    known.insert(carrier);
    if (is_import ? carrier.rfind(beginning, 0) != 0 : instance.node != node) continue;
    if (instance.skin != no_node) {
      bent = true;
      continue;
    }
    std::vector<Pose> poses;
    if (is_import)
      for (std::size_t at = instance.node; at != no_node; at = stage.nodes[at].parent)
        poses.push_back(stage.nodes[at].rest);
    append_posed(all, stage.meshes[instance.mesh], poses);
  }
  if (!all.triangles.empty()) return all;
  if (bent)
    building.problems.add(
        name, "the mesh of " + json::in_quotes(wanted) + " is bent by a skin; a shape needs one that keeps its form");
  else if (is_import || node != no_node)
    building.problems.add(name, json::in_quotes(wanted) + " has no mesh");
  else if (!building.excused(wanted))
    building.problems.add(name, "there is no imported node or file " + json::in_quotes(wanted) +
                                    suggestion(wanted, {known.begin(), known.end()}));
  return std::nullopt;
}

}  // namespace tweenfall::document::shapes
