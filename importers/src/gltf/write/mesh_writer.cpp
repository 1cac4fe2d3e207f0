#include "gltf/write/mesh_writer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace tweenfall::gltf {

namespace {

constexpr std::size_t joints_per_set = 4;

std::vector<double> flat(const std::vector<Vec3>& vectors, std::size_t count) {
  std::vector<double> all;
  all.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = i < vectors.size() ? vectors[i] : Vec3(0, 0, 0);
    all.insert(all.end(), {v[0], v[1], v[2]});
  }
  return all;
}

std::vector<double> flat_units(const std::vector<Vec3>& vectors, std::size_t count) {
  std::vector<Vec3> units(vectors.begin(), vectors.end());
  for (Vec3& v : units) {
    const double length = v.norm();
    v = length > 0 ? Vec3(v / length) : Vec3(0, 1, 0);
  }
  return flat(units, count);
}

std::vector<double> flat_tangents(const std::vector<Vec4>& tangents, std::size_t count) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec4 tangent = i < tangents.size() ? tangents[i] : Vec4(1, 0, 0, 1);
    const double length = tangent.head<3>().norm();
    const Vec3 along = length > 0 ? Vec3(tangent.head<3>() / length) : Vec3(1, 0, 0);
    all.insert(all.end(), {along[0], along[1], along[2], tangent[3] < 0 ? -1.0 : 1.0});
  }
  return all;
}

/// Joints and weights of one vertex as glTF requires: no joint twice, weights that sum to 1 as floats; if they fill
/// more than one set, the strongest come first.
std::vector<Influence> tidy(std::span<const Influence> influences, std::size_t joint_count) {
  std::vector<Influence> out;
  double sum = 0;
  for (const auto& [joint, weight] : influences) {
    if (!(weight > 0) || joint >= joint_count) continue;
    const auto known = std::ranges::find(out, joint, &Influence::joint);
    if (known == out.end())
      out.push_back({joint, weight});
    else
      known->weight += weight;
    sum += weight;
  }
  if (out.empty()) return {{0, 1}};
  if (out.size() > joints_per_set) std::ranges::stable_sort(out, std::ranges::greater{}, &Influence::weight);
  for (Influence& influence : out) influence.weight = static_cast<double>(static_cast<float>(influence.weight / sum));
  const auto largest = std::ranges::max_element(out, {}, &Influence::weight);
  double others = 0;
  for (auto it = out.begin(); it != out.end(); ++it)
    if (it != largest) others += it->weight;
  largest->weight = 1 - others;
  return out;
}

void write_influences(const Mesh& mesh, std::size_t joint_count, Attributes& attributes, BufferWriter& buffer) {
  std::vector<std::vector<Influence>> all(mesh.positions.size());
  std::size_t sets = 1;
  for (std::size_t vertex = 0; vertex < all.size(); ++vertex) {
    const bool given = vertex < mesh.influences.size();
    all[vertex] = tidy(given ? mesh.influences[vertex] : std::span<const Influence>(), joint_count);
    sets = std::max(sets, (all[vertex].size() + joints_per_set - 1) / joints_per_set);
  }
  for (std::size_t set = 0; set < sets; ++set) {
    std::vector<std::uint32_t> joints;
    std::vector<double> weights;
    for (const std::vector<Influence>& of_vertex : all)
      for (std::size_t slot = set * joints_per_set; slot < (set + 1) * joints_per_set; ++slot) {
        const Influence influence = slot < of_vertex.size() ? of_vertex[slot] : Influence{};
        joints.push_back(influence.joint);
        weights.push_back(influence.weight);
      }
    attributes["JOINTS_" + std::to_string(set)] = buffer.add_joints(joints, joint_count);
    attributes["WEIGHTS_" + std::to_string(set)] = buffer.add_floats(weights, "VEC4", false, vertex_target);
  }
}

class MeshWriter {
 public:
  MeshWriter(const Model& model, BufferWriter& buffer) : model_(model), buffer_(buffer) {}

  /// Meshes that one node can have as a single glTF mesh.
  struct Group {
    std::size_t skin;
    std::vector<std::size_t> meshes;
  };

  WrittenMeshes write() {
    std::map<std::size_t, std::vector<Group>> worn;
    for (const MeshInstance& instance : model_.instances) {
      const Mesh& mesh = model_.meshes[instance.mesh];
      if (mesh.positions.empty() || mesh.triangles.empty()) continue;
      const std::size_t skin = mesh.influences.empty() ? no_node : instance.skin;
      auto& groups = worn[instance.node];
      const auto fits = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
        const Mesh& other = model_.meshes[group.meshes.front()];
        return group.skin == skin && other.morphs.size() == mesh.morphs.size() &&
               other.rest_weights == mesh.rest_weights;
      });
      if (fits == groups.end())
        groups.push_back({skin, {instance.mesh}});
      else
        fits->meshes.push_back(instance.mesh);
    }
    for (const auto& [node, groups] : worn)
      for (std::size_t i = 0; i < groups.size(); ++i) dress(i == 0 ? node : child_of(node, i + 1), groups[i]);
    return std::move(out_);
  }

 private:
  std::size_t child_of(std::size_t node, std::size_t number) {
    out_.extra_nodes.push_back({node, model_.nodes[node].name + "/mesh" + std::to_string(number)});
    return model_.nodes.size() + out_.extra_nodes.size() - 1;
  }

  void dress(std::size_t node, const Group& group) {
    const auto key = std::make_pair(group.skin, group.meshes);
    auto known = written_.find(key);
    if (known == written_.end()) known = written_.emplace(key, add_mesh(group)).first;
    Worn& worn = out_.worn[node];
    worn.mesh = known->second;
    if (group.skin != no_node) worn.skin = group.skin;
  }

  std::size_t add_mesh(const Group& group) {
    const Mesh& first = model_.meshes[group.meshes.front()];
    WrittenMesh mesh;
    mesh.name = first.name;
    for (const std::size_t index : group.meshes) mesh.primitives.push_back(primitive(index, group.skin));
    if (!first.morphs.empty()) {
      mesh.weights = first.rest_weights;
      mesh.weights.resize(first.morphs.size(), 0);
      for (const MorphTarget& target : first.morphs) mesh.target_names.push_back(target.name);
    }
    out_.meshes.push_back(std::move(mesh));
    return out_.meshes.size() - 1;
  }

  WrittenPrimitive primitive(std::size_t index, std::size_t skin) {
    const Mesh& mesh = model_.meshes[index];
    const std::size_t count = mesh.positions.size();
    WrittenPrimitive out;
    out.attributes["POSITION"] = buffer_.add_floats(flat(mesh.positions, count), "VEC3", true, vertex_target);
    if (!mesh.normals.empty())
      out.attributes["NORMAL"] = buffer_.add_floats(flat_units(mesh.normals, count), "VEC3", false, vertex_target);
    if (!mesh.tangents.empty() && !mesh.normals.empty())
      out.attributes["TANGENT"] = buffer_.add_floats(flat_tangents(mesh.tangents, count), "VEC4", false, vertex_target);
    if (!mesh.texture_coordinates.empty()) {
      std::vector<double> all;
      for (const Vec2& v : mesh.texture_coordinates) all.insert(all.end(), {v[0], v[1]});
      all.resize(2 * count, 0);
      out.attributes["TEXCOORD_0"] = buffer_.add_floats(all, "VEC2", false, vertex_target);
    }
    if (skin != no_node) write_influences(mesh, model_.skins[skin].joints.size(), out.attributes, buffer_);
    out.indices = buffer_.add_indices(mesh.triangles, count);
    out.material = material(mesh.base_color);
    for (const MorphTarget& target : mesh.morphs) {
      Attributes offsets;
      offsets["POSITION"] = buffer_.add_floats(flat(target.position_offsets, count), "VEC3", true, vertex_target);
      if (!target.normal_offsets.empty() && !mesh.normals.empty())
        offsets["NORMAL"] = buffer_.add_floats(flat(target.normal_offsets, count), "VEC3", false, vertex_target);
      if (!target.tangent_offsets.empty() && out.attributes.contains("TANGENT"))
        offsets["TANGENT"] = buffer_.add_floats(flat(target.tangent_offsets, count), "VEC3", false, vertex_target);
      out.targets.push_back(std::move(offsets));
    }
    return out;
  }

  std::size_t material(const Color& color) {
    std::array<double, 4> rgba;
    for (int i = 0; i < 4; ++i) rgba[static_cast<std::size_t>(i)] = std::clamp(color.rgba[i], 0.0, 1.0);
    const auto known = materials_.find(rgba);
    if (known != materials_.end()) return known->second;
    out_.materials.push_back(rgba);
    return materials_[rgba] = out_.materials.size() - 1;
  }

  const Model& model_;
  BufferWriter& buffer_;
  std::map<std::pair<std::size_t, std::vector<std::size_t>>, std::size_t> written_;
  std::map<std::array<double, 4>, std::size_t> materials_;
  WrittenMeshes out_;
};

}  // namespace

WrittenMeshes write_meshes(const Model& model, BufferWriter& buffer) {
  return MeshWriter(model, buffer).write();
}

}  // namespace tweenfall::gltf
