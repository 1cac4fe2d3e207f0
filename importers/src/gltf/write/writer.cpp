// save_glb: a Model as binary glTF 2.0.

#include "gltf/physics/written_physics.h"
#include "gltf/write/buffer_writer.h"
#include "gltf/write/mesh_writer.h"
#include "gltf/write/sampler_keys.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/model.h>
#include <tweenfall/importers/whole_file.h>

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string_view>

namespace tweenfall {

namespace gltf {
namespace {

using Json = nlohmann::json;

Json numbers(const Vec3& v) {
  return Json::array({v[0], v[1], v[2]});
}

Json node_json(const Node& node) {
  Json out{{"name", node.name}};
  const Pose& rest = node.rest;
  if (!rest.position.isZero(0)) out["translation"] = numbers(rest.position);
  if (!rest.rotation.vec().isZero(0) || rest.rotation.w() < 0)
    out["rotation"] = Json::array({rest.rotation.x(), rest.rotation.y(), rest.rotation.z(), rest.rotation.w()});
  if (rest.scale != Vec3(1, 1, 1)) out["scale"] = numbers(rest.scale);
  return out;
}

void write_nodes(const Model& model, Json& document) {
  Json nodes = Json::array(), roots = Json::array();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    nodes.push_back(node_json(model.nodes[i]));
    const std::size_t parent = model.nodes[i].parent;
    if (parent == no_node)
      roots.push_back(i);
    else
      nodes[parent]["children"].push_back(i);
  }
  document["scene"] = 0;
  document["scenes"] = Json::array({Json::object()});
  if (!nodes.empty()) {
    document["nodes"] = std::move(nodes);
    document["scenes"][0]["nodes"] = std::move(roots);
  }
}

Json primitive_json(const WrittenPrimitive& primitive) {
  Json out{{"attributes", primitive.attributes}, {"indices", primitive.indices}, {"material", primitive.material}};
  if (!primitive.targets.empty()) out["targets"] = primitive.targets;
  return out;
}

Json mesh_json(const WrittenMesh& mesh) {
  Json out{{"name", mesh.name}};
  for (const WrittenPrimitive& primitive : mesh.primitives) out["primitives"].push_back(primitive_json(primitive));
  if (mesh.target_names.empty()) return out;
  out["weights"] = mesh.weights;
  out["extras"]["targetNames"] = mesh.target_names;
  return out;
}

Json material_json(const std::array<double, 4>& rgba) {
  Json out{{"pbrMetallicRoughness", {{"baseColorFactor", rgba}, {"metallicFactor", 0}, {"roughnessFactor", 0.9}}}};
  if (rgba[3] < 1) out["alphaMode"] = "BLEND";
  return out;
}

void add_meshes(const Model& model, Json& document, BufferWriter& buffer) {
  const WrittenMeshes written = write_meshes(model, buffer);
  for (const ExtraNode& extra : written.extra_nodes) {
    Json& nodes = document["nodes"];
    nodes[extra.parent]["children"].push_back(nodes.size());
    nodes.push_back({{"name", extra.name}});
  }
  for (const auto& [node, worn] : written.worn) {
    Json& wearer = document["nodes"][node];
    wearer["mesh"] = worn.mesh;
    if (worn.skin) wearer["skin"] = *worn.skin;
  }
  for (const WrittenMesh& mesh : written.meshes) document["meshes"].push_back(mesh_json(mesh));
  for (const auto& rgba : written.materials) document["materials"].push_back(material_json(rgba));
}

Json inverse_bind_accessor(const Skin& skin, BufferWriter& buffer) {
  std::vector<double> all;
  for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
    const Skin::InverseBind bind = joint < skin.inverse_binds.size() ? skin.inverse_binds[joint] : Skin::InverseBind{};
    for (int column = 0; column < 3; ++column)
      all.insert(all.end(), {bind.linear(0, column), bind.linear(1, column), bind.linear(2, column), 0});
    all.insert(all.end(), {bind.translation[0], bind.translation[1], bind.translation[2], 1});
  }
  return buffer.add_floats(all, "MAT4");
}

void write_skins(const Model& model, Json& document, BufferWriter& buffer) {
  for (const Skin& skin : model.skins)
    document["skins"].push_back(
        {{"joints", skin.joints}, {"inverseBindMatrices", inverse_bind_accessor(skin, buffer)}});
}

void add_physics(const Model& model, Json& document, BufferWriter& buffer) {
  if (model.bodies.empty() && model.joints.empty()) return;
  const physics::WrittenPhysics written =
      physics::write_physics(model, document["nodes"].size(), document.value("meshes", Json::array()).size(), buffer);
  for (const physics::PlacedNode& placed : written.nodes) {
    Json& nodes = document["nodes"];
    if (placed.parent != no_node)
      nodes[placed.parent]["children"].push_back(nodes.size());
    else if (placed.in_scene)
      document["scenes"][0]["nodes"].push_back(nodes.size());
    nodes.push_back(node_json({.name = placed.name, .rest = placed.pose}));
    if (placed.mesh) nodes.back()["mesh"] = *placed.mesh;
  }
  for (const physics::ColliderMesh& mesh : written.meshes)
    document["meshes"].push_back(
        {{"name", "collider"},
         {"primitives", {{{"attributes", {{"POSITION", mesh.positions}}}, {"indices", mesh.indices}}}}});
  for (const auto& [node, said] : written.of_nodes)
    document["nodes"][node]["extensions"][physics::bodies_extension] = Json::parse(said);
  const auto list = [&](const char* extension, const std::string& contents) {
    if (contents.empty()) return;
    document["extensions"][extension] = Json::parse(contents);
    document["extensionsUsed"].push_back(extension);
  };
  list(physics::shapes_extension, written.shapes);
  list(physics::bodies_extension, written.physics);
}

const char* path_named(const std::string& property) {
  switch (property_named(property)) {
    case Property::position:
      return "translation";
    case Property::rotation:
      return "rotation";
    case Property::scale:
      return "scale";
    case Property::weights:
      return "weights";
    default:
      return nullptr;
  }
}

/// Number of morph targets of the meshes on a node; glTF requires exactly that many weights per key.
std::size_t morph_count(const Model& model, std::size_t node) {
  for (const MeshInstance& instance : model.instances)
    if (instance.node == node) return model.meshes[instance.mesh].morphs.size();
  return 0;
}

Json animation_json(const Model& model, const Clip& clip, const std::map<std::string, std::size_t>& index, double fps,
                    BufferWriter& buffer) {
  Json samplers = Json::array(), channels = Json::array();
  std::set<std::pair<std::size_t, std::string>> taken;
  for (const Track& track : clip.tracks) {
    const char* path = path_named(track.property);
    const auto node = index.find(track.node);
    if (!path || node == index.end() || !taken.insert({node->second, path}).second) continue;
    const SamplerKeys keys = sampler_keys(clip, track, model.nodes[node->second].rest, fps);
    if (keys.times.empty()) continue;
    const bool weights = std::string_view(path) == "weights";
    if (weights && keys.parts != morph_count(model, node->second)) continue;
    const std::string type = weights ? "SCALAR" : keys.parts == 4 ? "VEC4" : "VEC3";
    samplers.push_back({{"input", buffer.add_times(keys.times)},
                        {"output", buffer.add_floats(keys.outputs, type)},
                        {"interpolation", keys.interpolation}});
    channels.push_back({{"sampler", samplers.size() - 1}, {"target", {{"node", node->second}, {"path", path}}}});
  }
  if (channels.empty()) return {};
  return {{"name", clip.name}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}};
}

void write_animations(const Model& model, Json& document, BufferWriter& buffer, double fps) {
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) index.emplace(model.nodes[i].name, i);
  const auto node_named = [&](std::string_view name) -> const Node* {
    const auto found = index.find(std::string(name));
    return found == index.end() ? nullptr : &model.nodes[found->second];
  };
  for (const Clip& clip : model.clips) {
    Json animation = animation_json(model, with_whole_tracks(clip, node_named), index, fps, buffer);
    if (!animation.is_null()) document["animations"].push_back(std::move(animation));
  }
}

void write_buffer(BufferWriter& buffer, Json& document) {
  buffer.finish();
  for (std::size_t i = 0; i < buffer.accessors().size(); ++i) {
    const BufferView& view = buffer.views()[i];
    Json& view_json = document["bufferViews"].emplace_back(
        Json{{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.length}});
    if (view.target) view_json["target"] = view.target;
    const Accessor& accessor = buffer.accessors()[i];
    Json& accessor_json = document["accessors"].emplace_back(Json{
        {"bufferView", i}, {"componentType", accessor.component}, {"count", accessor.count}, {"type", accessor.type}});
    if (accessor.low.empty()) continue;
    accessor_json["min"] = accessor.low;
    accessor_json["max"] = accessor.high;
  }
  if (!buffer.accessors().empty()) document["buffers"] = Json::array({{{"byteLength", buffer.bytes().size()}}});
}

void append_word(std::string& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(word >> shift & 0xFF));
}

std::string container(const Json& document, const std::vector<unsigned char>& binary) {
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::uint64_t length = 12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
  if (length > 0xFFFFFFFFu) throw std::runtime_error("binary glTF ends at 4 GiB");
  std::string out;
  out.reserve(length);
  append_word(out, glb_magic);
  append_word(out, 2);
  append_word(out, static_cast<std::uint32_t>(length));
  append_word(out, static_cast<std::uint32_t>(text.size()));
  append_word(out, json_chunk);
  out += text;
  if (binary.empty()) return out;
  append_word(out, static_cast<std::uint32_t>(binary.size()));
  append_word(out, bin_chunk);
  out.append(binary.begin(), binary.end());
  return out;
}

}  // namespace
}  // namespace gltf

void save_glb(const Model& model, const std::filesystem::path& file, double fps) {
  if (!(fps > 0)) throw std::runtime_error("frames per second must be above 0, not " + number_text(fps));
  std::string content;
  try {
    nlohmann::json document{{"asset", {{"version", "2.0"}, {"generator", "tweenfall"}}}};
    gltf::BufferWriter buffer;
    gltf::write_nodes(model, document);
    gltf::add_meshes(model, document, buffer);
    gltf::add_physics(model, document, buffer);
    gltf::write_skins(model, document, buffer);
    gltf::write_animations(model, document, buffer, fps);
    gltf::write_buffer(buffer, document);
    content = gltf::container(document, buffer.bytes());
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  write_whole_file(file, content);
}

}  // namespace tweenfall
