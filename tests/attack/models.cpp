// Model files changed by byte, and where they are JSON by structure: each is refused in words, or gives a model that
// holds together and can be written.

#include "attack/mutation.h"
#include "attack/shown.h"
#include "attack/written.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace tweenfall::attack {

namespace {

bool text_fits(const std::vector<std::string>& texts) {
  return std::all_of(texts.begin(), texts.end(), is_utf8);
}

std::string fault_of_mesh(const Mesh& mesh) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
  const auto finite = [](const std::vector<Vec3>& all) {
    return std::all_of(all.begin(), all.end(), [](const Vec3& each) { return each.allFinite(); });
  };
  if (!is_utf8(mesh.name)) return "a mesh's name is not UTF-8";
  if (!finite(mesh.positions) || !finite(mesh.normals)) return "a vertex is not finite";
  if (!fits(mesh.normals.size()) || !fits(mesh.texture_coordinates.size()) || !fits(mesh.influences.size())) {
    return "a mesh's lists have different lengths";
  }
  if (mesh.triangles.size() % 3 != 0) return "a triangle is not whole";
  for (const std::uint32_t corner : mesh.triangles) {
    if (corner >= mesh.positions.size()) return "a triangle's corner is no vertex";
  }
  if (mesh.rest_weights.size() != mesh.morphs.size()) return "a morph target has no weight";
  for (const MorphTarget& morph : mesh.morphs) {
    if (!is_utf8(morph.name)) return "a morph target's name is not UTF-8";
    if (morph.position_offsets.size() != mesh.positions.size() || !finite(morph.position_offsets)) {
      return "a morph target does not fit";
    }
  }
  return {};
}

std::string fault_of_instance(const Model& model, const MeshInstance& instance) {
  if (instance.node >= model.nodes.size()) return "an instance's node is not there";
  if (instance.mesh >= model.meshes.size()) return "an instance's mesh is not there";
  if (instance.skin == no_node) return {};
  if (instance.skin >= model.skins.size()) return "an instance's skin is not there";
  const Skin& skin = model.skins[instance.skin];
  if (skin.inverse_binds.size() != skin.joints.size()) return "a joint has no bind";
  for (const std::size_t joint : skin.joints) {
    if (joint >= model.nodes.size()) return "a joint is no node";
  }
  const Influences& influences = model.meshes[instance.mesh].influences;
  for (std::size_t vertex = 0; vertex < influences.size(); ++vertex) {
    for (const Influence& pull : influences[vertex]) {
      if (pull.joint >= skin.joints.size() || !std::isfinite(pull.weight)) return "a vertex is pulled by no joint";
    }
  }
  return {};
}

std::string fault_of_parts(const Model& model) {
  if (!is_utf8(model.name) || !text_fits(model.repairs)) return "a repair's text is not UTF-8";
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (!is_utf8(node.name)) return "a node's name is not UTF-8";
    if (node.parent != no_node && node.parent >= i) return "a node stands before its parent";
    if (!node.rest.position.allFinite() || !node.rest.rotation.coeffs().allFinite() || !node.rest.scale.allFinite()) {
      return "a rest pose is not finite";
    }
  }
  for (const Mesh& mesh : model.meshes) {
    if (const std::string fault = fault_of_mesh(mesh); !fault.empty()) return fault;
  }
  for (const MeshInstance& instance : model.instances) {
    if (const std::string fault = fault_of_instance(model, instance); !fault.empty()) return fault;
  }
  return {};
}

/// The stage that shows a model, its first clip playing.
StageDescription stage_of(const Model& model) {
  StageDescription stage;
  stage.name = model.name;
  for (const Node& node : model.nodes)
    stage.nodes.push_back({.name = node.name, .parent = node.parent, .rest = node.rest});
  stage.clips = model.clips;
  stage.meshes = model.meshes;
  stage.skins = model.skins;
  stage.mesh_instances = model.instances;
  if (!stage.clips.empty()) stage.plays = {Play{.clip = 0}};
  return stage;
}

class Models final : public Attack {
 public:
  Models(std::uint64_t seed, const std::string& ending)
      : seed_(seed), ending_(ending), folder_(folder_of_process(getpid())) {
    for (const char* folder : {"samples/documents", "tests/data", "../shared/models"}) {
      const std::filesystem::path place = std::filesystem::path(TWEENFALL_SOURCE_DIR) / folder;
      if (!std::filesystem::exists(place)) continue;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
        // A model that is refused unchanged would seldom be accepted when changed.
        if (entry.path().string().find("malformed") != std::string::npos) continue;
        if (entry.path().extension() == ending && entry.file_size() < 2'000'000) files_.push_back(entry.path());
      }
    }
    std::sort(files_.begin(), files_.end());
    if (files_.empty()) throw std::invalid_argument("no model with the ending " + ending);
  }
  ~Models() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string show(std::uint64_t number) override { return made(number).bytes; }

  std::string run(std::uint64_t number) override {
    const Case made = Models::made(number);
    const std::filesystem::path file = beside_its_companions(made.from) / ("case" + ending_);
    {
      std::ofstream out(file, std::ios::binary);
      out << made.bytes;
    }
    try {
      const Model model = load_model(file);
      ++taken_;
      return fault_of(model);
    } catch (const ModelError& error) {
      return is_utf8(error.what()) ? "" : "an error's text is not UTF-8";
    } catch (const std::exception& error) {
      return std::string("not refused as a model: ") + error.what();
    }
  }

 private:
  struct Case {
    std::string bytes;
    std::filesystem::path from;
  };

  Case made(std::uint64_t number) const {
    Random random = random_of(seed_, number);
    const std::filesystem::path& from = files_[below(random, files_.size())];
    std::string bytes = attack::bytes_of(from);
    if (ending_ == ".gltf" && below(random, 2)) {
      nlohmann::ordered_json document = nlohmann::ordered_json::parse(bytes, nullptr, false);
      if (!document.is_discarded()) {
        mutate_structure(random, document);
        return {document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), from};
      }
    }
    mutate_bytes(random, bytes);
    return {bytes, from};
  }

  /// A folder of our own that contains everything beside `file`: buffers, images, materials.
  std::filesystem::path beside_its_companions(const std::filesystem::path& file) const {
    const auto number = static_cast<std::size_t>(std::find(files_.begin(), files_.end(), file) - files_.begin());
    std::filesystem::path folder = folder_ / std::to_string(number);
    if (std::filesystem::exists(folder)) return folder;
    std::filesystem::create_directories(folder);
    for (const auto& entry : std::filesystem::directory_iterator(file.parent_path())) {
      if (!entry.is_regular_file() || entry.file_size() > 4'000'000 || entry.path().extension() == ending_) continue;
      std::filesystem::copy_file(entry.path(), folder / entry.path().filename());
    }
    return folder;
  }

  std::string fault_of(const Model& model) const {
    if (std::string fault = fault_of_parts(model); !fault.empty()) return fault;
    if (std::string fault = fault_of_document(model); !fault.empty()) return "as a document: " + fault;
    try {
      if (std::string fault = fault_of_run(stage_of(model), 0.1); !fault.empty()) return fault;
    } catch (const std::invalid_argument& error) {
      if (!is_utf8(error.what())) return "a refusal's text is not UTF-8";
    }
    return fault_of_copy(model);
  }

  static std::string fault_of_document(const Model& model) {
    try {
      return fault_of_json(Document::from_model(model).text());
    } catch (const DocumentError& error) {
      return is_utf8(error.what()) ? "" : "an error's text is not UTF-8";
    }
  }

  /// Reads again what is written as binary glTF.
  std::string fault_of_copy(const Model& model) const {
    const std::filesystem::path copy = folder_ / "copy.glb";
    try {
      save_glb(model, copy);
    } catch (const std::runtime_error&) {
      return {};  // numbers beyond floats
    } catch (const std::invalid_argument&) {
      return {};
    }
    try {
      return load_model(copy).nodes.size() == model.nodes.size() ? "" : "a copy has other nodes";
    } catch (const ModelError& error) {
      return std::string("a copy cannot be read: ") + error.what();
    }
  }

  std::uint64_t seed_;
  std::string ending_;
  std::vector<std::filesystem::path> files_;
  std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<Attack> attack_models(std::uint64_t seed, const std::string& ending) {
  return std::make_unique<Models>(seed, ending);
}

}  // namespace tweenfall::attack
