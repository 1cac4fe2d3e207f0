#include "gltf/read/animations.h"

#include "gltf/read/sampler_curves.h"
#include "model/model_names.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace tweenfall::gltf {

namespace {

class AnimationReader {
 public:
  AnimationReader(const Fields& root, Accessors& accessors, const std::vector<FileNode>& nodes,
                  const std::vector<FileMesh>& meshes)
      : root_(root), accessors_(accessors), nodes_(nodes), meshes_(meshes) {}

  Clip read(const Fields& animation, std::string name) {
    Clip clip;
    clip.name = std::move(name);
    std::set<std::pair<std::size_t, std::string>> driven;
    const std::size_t count = animation.list("channels").size();
    for (std::size_t i = 0; i < count; ++i) {
      const Fields channel = animation.at("channels", i), target = channel.inside("target");
      const std::string path = target.text("path");
      const auto node = target.index("node", nodes_.size());
      if (!node) {
        if (!target.has("node"))
          root_.problems().repair(target.place(), "names no node and was not read (path \"" + path + "\")");
        continue;
      }
      if (!driven.insert({*node, path}).second) {
        root_.problems().repair(target.place(), "drives what an earlier channel drives and was not read");
        continue;
      }
      read_channel(animation, channel, *node, path, clip);
    }
    return clip;
  }

 private:
  void read_channel(const Fields& animation, const Fields& channel, std::size_t node, const std::string& path,
                    Clip& clip) {
    static const std::set<std::string> paths{"translation", "rotation", "scale", "weights"};
    const std::string place = channel.place_of("target");
    if (!paths.contains(path)) {
      root_.problems().add(place + "/path", "\"" + path.substr(0, 40) +
                                                "\" must be \"translation\", \"rotation\", \"scale\" or \"weights\"");
      return;
    }
    const std::size_t width = path == "rotation" ? 4 : path == "weights" ? morphs_of(node) : 3;
    const auto index = channel.required_index("sampler", animation.list("samplers").size());
    if (!index) return;
    if (width == 0) {
      root_.problems().repair(place, "drives morph weights of a node without morph targets and was not read");
      return;
    }
    const Fields fields = animation.at("samplers", *index);
    const auto sampler = read_sampler(fields, path, width);
    if (!sampler) return;
    const std::string& name = nodes_[node].node.name;
    try {
      if (path == "rotation")
        clip.tracks.push_back({name, "rotation", rotation_curve(*sampler)});
      else if (path == "weights")
        clip.tracks.push_back({name, "weights", weight_curves(*sampler)});
      else
        clip.tracks.push_back({name, path == "scale" ? "scale" : "position", vector_curve(*sampler)});
    } catch (const std::invalid_argument& error) {
      root_.problems().add(fields.place(), error.what());
      return;
    }
    clip.duration = std::max(clip.duration, sampler->times.back());
  }

  std::size_t morphs_of(std::size_t node) const {
    return nodes_[node].mesh && *nodes_[node].mesh < meshes_.size() ? meshes_[*nodes_[node].mesh].morphs : 0;
  }

  std::optional<Interpolation> interpolation_of(const Fields& fields) {
    const std::string word = fields.text("interpolation", "LINEAR");
    if (word == "STEP") return Interpolation::step;
    if (word == "LINEAR") return Interpolation::linear;
    if (word == "CUBICSPLINE") return Interpolation::cubic;
    root_.problems().add(fields.place_of("interpolation"),
                         "\"" + word.substr(0, 40) + "\" must be \"STEP\", \"LINEAR\" or \"CUBICSPLINE\"");
    return std::nullopt;
  }

  std::optional<Sampler> read_sampler(const Fields& fields, const std::string& path, std::size_t width) {
    const auto input = fields.required_index("input", accessors_.size());
    const auto output = fields.required_index("output", accessors_.size());
    const auto interpolation = interpolation_of(fields);
    if (!input || !output || !interpolation) return std::nullopt;
    auto times = accessors_.read(*input, fields.place_of("input"), {"SCALAR"}, Wanted::reals);
    const char* type = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
    auto outputs = accessors_.read(*output, fields.place_of("output"), {type}, Wanted::reals);
    if (!times || !outputs) return std::nullopt;
    Sampler sampler{*interpolation, std::move(times->numbers), std::move(outputs->numbers), width};
    const std::size_t per_key = width * (sampler.interpolation == Interpolation::cubic ? 3 : 1);
    if (sampler.outputs.size() != sampler.times.size() * per_key) {
      root_.problems().add(fields.place_of("output"), "holds " + std::to_string(sampler.outputs.size()) +
                                                          " numbers where " + std::to_string(sampler.times.size()) +
                                                          " keys need " + std::to_string(per_key) + " each");
      return std::nullopt;
    }
    if (!put_in_order(sampler, per_key, fields.place_of("input"))) return std::nullopt;
    return sampler;
  }

  /// Times must increase. Of keys at the same time the last is kept, since it applies from then on.
  bool put_in_order(Sampler& sampler, std::size_t per_key, const std::string& place) {
    const std::vector<double>& times = sampler.times;
    Sampler kept{sampler.interpolation, {}, {}, sampler.width};
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (i > 0 && times[i] < times[i - 1]) {
        root_.problems().add(place, "times must increase; key " + std::to_string(i) + " at " + number_text(times[i]) +
                                        " s comes after " + number_text(times[i - 1]) + " s");
        return false;
      }
      if (i + 1 < times.size() && times[i + 1] == times[i]) continue;
      kept.times.push_back(times[i]);
      const auto first = sampler.outputs.begin() + static_cast<std::ptrdiff_t>(i * per_key);
      kept.outputs.insert(kept.outputs.end(), first, first + static_cast<std::ptrdiff_t>(per_key));
    }
    if (kept.times.size() < times.size())
      root_.problems().repair(place, "has several keys at one time; the last of them was kept");
    sampler = std::move(kept);
    return true;
  }

  const Fields& root_;
  Accessors& accessors_;
  const std::vector<FileNode>& nodes_;
  const std::vector<FileMesh>& meshes_;
};

}  // namespace

std::vector<Clip> read_animations(const Fields& root, Accessors& accessors, const std::vector<FileNode>& nodes,
                                  const std::vector<FileMesh>& meshes) {
  std::vector<Clip> clips;
  models::UniqueNames names;
  AnimationReader reader(root, accessors, nodes, meshes);
  for (std::size_t i = 0; i < root.list("animations").size(); ++i) {
    const Fields animation = root.at("animations", i);
    std::string name = animation.text("name");
    if (name.empty()) name = "animation_" + std::to_string(i);
    clips.push_back(reader.read(animation, names.unique(name)));
  }
  return clips;
}

}  // namespace tweenfall::gltf
