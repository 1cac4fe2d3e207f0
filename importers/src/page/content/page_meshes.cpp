#include "page/content/page_meshes.h"

#include <tweenfall/curves/number_text.h>

#include "json/json_string.h"
#include "recording/base64.h"

#include <cstdint>
#include <vector>

namespace tweenfall::page {

namespace {

void append_array(std::string& out, const char* name, const std::string& text) {
  ((((out += ",\"") += name) += "\":\"") += text) += '"';
}

std::string vectors_text(const std::vector<Vec3>& vectors) {
  std::vector<float> numbers;
  numbers.reserve(vectors.size() * 3);
  for (const Vec3& vector : vectors)
    for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(vector[i]));
  return recordings::base64(numbers);
}

void append_mesh(std::string& out, const Mesh& mesh) {
  out += "{\"name\":";
  json::append_string(out, mesh.name);
  append_array(out, "positions", vectors_text(mesh.positions));
  if (!mesh.normals.empty()) append_array(out, "normals", vectors_text(mesh.normals));
  append_array(out, "triangles", recordings::base64(std::span<const std::uint32_t>(mesh.triangles)));
  if (!mesh.influences.empty()) {
    std::vector<std::uint32_t> joints;
    std::vector<float> weights;
    // As many slots for each vertex as the one with the most joints needs.
    const std::size_t slots = mesh.influences.most();
    for (std::size_t vertex = 0; vertex < mesh.influences.size(); ++vertex)
      for (std::size_t slot = 0; slot < slots; ++slot) {
        const auto influences = mesh.influences[vertex];
        const Influence influence = slot < influences.size() ? influences[slot] : Influence{};
        joints.push_back(influence.joint);
        weights.push_back(static_cast<float>(influence.weight));
      }
    append_array(out, "joints", recordings::base64(std::span<const std::uint32_t>(joints)));
    append_array(out, "jointWeights", recordings::base64(weights));
  }
  out += ",\"morphs\":[";
  for (std::size_t i = 0; i < mesh.morphs.size(); ++i) {
    out += i > 0 ? ",{\"name\":" : "{\"name\":";
    json::append_string(out, mesh.morphs[i].name);
    append_array(out, "positions", vectors_text(mesh.morphs[i].position_offsets));
    if (!mesh.morphs[i].normal_offsets.empty())
      append_array(out, "normals", vectors_text(mesh.morphs[i].normal_offsets));
    out += '}';
  }
  out += "],\"restWeights\":[";
  for (std::size_t i = 0; i < mesh.rest_weights.size(); ++i)
    (i > 0 ? out += ',' : out) += number_text(mesh.rest_weights[i]);
  out += "],\"color\":[";
  for (int i = 0; i < 4; ++i) (i > 0 ? out += ',' : out) += short_text(mesh.base_color.rgba[i], 4);
  out += "]}";
}

}  // namespace

void append_page_meshes(std::string& out, const StageDescription& stage,
                        const std::map<std::string, std::size_t>& node_of) {
  // Converts indices of the description's nodes to those of the recording's; -1 for a node that was not recorded.
  const auto recorded = [&](std::size_t node) {
    if (node >= stage.nodes.size()) return std::string("-1");
    const auto found = node_of.find(stage.nodes[node].name);
    return found == node_of.end() ? std::string("-1") : std::to_string(found->second);
  };
  out += ",\n\"meshes\":[";
  for (std::size_t i = 0; i < stage.meshes.size(); ++i) {
    if (i > 0) out += ",\n";
    append_mesh(out, stage.meshes[i]);
  }
  out += "],\n\"skins\":[";
  for (std::size_t i = 0; i < stage.skins.size(); ++i) {
    const Skin& skin = stage.skins[i];
    out += i > 0 ? ",{\"joints\":[" : "{\"joints\":[";
    for (std::size_t j = 0; j < skin.joints.size(); ++j) (j > 0 ? out += ',' : out) += recorded(skin.joints[j]);
    std::vector<float> numbers;
    for (const Skin::InverseBind& bind : skin.inverse_binds) {
      for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) numbers.push_back(static_cast<float>(bind.linear(row, column)));
      for (int row = 0; row < 3; ++row) numbers.push_back(static_cast<float>(bind.translation[row]));
    }
    out += ']';
    append_array(out, "inverseBinds", recordings::base64(numbers));
    out += '}';
  }
  out += "],\n\"instances\":[";
  bool first = true;
  for (const MeshInstance& instance : stage.mesh_instances) {
    if (instance.mesh >= stage.meshes.size()) continue;
    if (!first) out += ',';
    first = false;
    out += "{\"node\":" + recorded(instance.node) + ",\"mesh\":" + std::to_string(instance.mesh) +
           ",\"skin\":" + (instance.skin < stage.skins.size() ? std::to_string(instance.skin) : std::string("-1")) +
           "}";
  }
  out += ']';
}

}  // namespace tweenfall::page
