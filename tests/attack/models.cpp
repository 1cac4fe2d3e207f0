// Model files changed by byte, and where they are JSON by structure: each is refused in words, or gives a model that
// holds together and can be written.

#include "attack/mutation.h"
#include "attack/written.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>

#include <unistd.h>

#include <fstream>

namespace tweenfall::attack {

namespace {

class Models final : public Attack {
 public:
  Models(std::uint64_t seed, const std::string& ending) : seed_(seed), ending_(ending) {
    for (const char* folder : {"samples/documents", "tests/data", "../shared/models"}) {
      const std::filesystem::path place = std::filesystem::path(TWEENFALL_SOURCE_DIR) / folder;
      if (!std::filesystem::exists(place)) continue;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
        // What is refused as it is would seldom be taken when changed.
        if (entry.path().string().find("malformed") != std::string::npos) continue;
        if (entry.path().extension() == ending && entry.file_size() < 2'000'000) files_.push_back(entry.path());
      }
    }
    std::sort(files_.begin(), files_.end());
    if (files_.empty()) throw std::invalid_argument("no model with the ending " + ending);
    file_ = std::filesystem::temp_directory_path() / ("tweenfall-attack-" + std::to_string(getpid()) + ending);
  }
  ~Models() override {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }

  std::string show(std::uint64_t number) override { return bytes_of(number); }

  std::string run(std::uint64_t number) override {
    {
      std::ofstream out(file_, std::ios::binary);
      out << bytes_of(number);
    }
    try {
      const Model model = load_model(file_);
      ++taken_;
      return fault_of(model);
    } catch (const ModelError& error) {
      return is_utf8(error.what()) ? "" : "an error's text is not UTF-8";
    } catch (const std::exception& error) {
      return std::string("not refused as a model: ") + error.what();
    }
  }

 private:
  std::string bytes_of(std::uint64_t number) const {
    Random random = random_of(seed_, number);
    std::string bytes = attack::bytes_of(files_[below(random, files_.size())]);
    if (ending_ == ".gltf" && below(random, 2)) {
      nlohmann::ordered_json document = nlohmann::ordered_json::parse(bytes, nullptr, false);
      if (!document.is_discarded()) {
        mutate_structure(random, document);
        return document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
      }
    }
    mutate_bytes(random, bytes);
    return bytes;
  }

  static std::string fault_of(const Model& model) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const Node& node = model.nodes[i];
      if (!is_utf8(node.name)) return "a node's name is not UTF-8";
      if (node.parent != no_node && node.parent >= i) return "a node stands before its parent";
      if (!node.rest.position.allFinite() || !node.rest.rotation.coeffs().allFinite() || !node.rest.scale.allFinite()) {
        return "a rest pose is not finite";
      }
    }
    for (const Mesh& mesh : model.meshes) {
      for (const Vec3& position : mesh.positions) {
        if (!position.allFinite()) return "a vertex is not finite";
      }
      for (const std::uint32_t corner : mesh.triangles) {
        if (corner >= mesh.positions.size()) return "a triangle's corner is no vertex";
      }
    }
    for (const MeshInstance& instance : model.instances) {
      if (instance.mesh >= model.meshes.size()) return "an instance's mesh is not there";
    }
    return written([&] { return Document::from_model(model).text(); });
  }

  std::uint64_t seed_;
  std::string ending_;
  std::vector<std::filesystem::path> files_;
  std::filesystem::path file_;
};

}  // namespace

std::unique_ptr<Attack> attack_models(std::uint64_t seed, const std::string& ending) {
  return std::make_unique<Models>(seed, ending);
}

}  // namespace tweenfall::attack
