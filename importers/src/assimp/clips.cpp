#include "assimp/clips.h"

#include "assimp/values.h"
#include "model/model_names.h"

#include <tweenfall/curves/keys.h>

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace tweenfall::assimp {

namespace {

bool usable(const Vec3& value) {
  return value.allFinite();
}
bool usable(const Quat& value) {
  return value.coeffs().allFinite() && value.norm() > 1e-6;
}

class ClipReader {
 public:
  ClipReader(const Model& model, const std::map<std::string, std::size_t>& nodes, models::ModelProblems& problems)
      : model_(model), nodes_(nodes), problems_(problems) {}

  Clip read(const aiAnimation& from, const std::string& name) {
    Clip clip;
    clip.name = name;
    place_ = "clip \"" + name + "\"";
    // Files without a rate of their own give times in seconds.
    const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 1;
    driven_.clear();
    for (unsigned i = 0; i < from.mNumChannels; ++i) add_channel(*from.mChannels[i], ticks, clip);
    for (const Track& track : clip.tracks) {
      const double end = extent(track.curve).second;
      if (std::isfinite(end)) clip.duration = std::max(clip.duration, end);
    }
    return clip;
  }

 private:
  void add_channel(const aiNodeAnim& channel, double ticks, Clip& clip) {
    const std::string name = text_of(channel.mNodeName);
    const auto node = nodes_.find(name);
    if (node == nodes_.end()) {
      problems_.repair(place_, "drives \"" + name + "\", which is no node; the channel was not read");
      return;
    }
    if (!driven_.insert(node->second).second) {
      problems_.repair(place_, "drives \"" + name + "\" twice; the first channel was kept");
      return;
    }
    const std::string& ours = model_.nodes[node->second].name;
    const auto point = [](const aiVectorKey& key) { return vector_of(key.mValue); };
    const auto turn = [](const aiQuatKey& key) { return quaternion_of(key.mValue); };
    add<Vec3>(channel.mPositionKeys, channel.mNumPositionKeys, ticks, point, {ours, "position"}, clip);
    add<Quat>(channel.mRotationKeys, channel.mNumRotationKeys, ticks, turn, {ours, "rotation"}, clip);
    add<Vec3>(channel.mScalingKeys, channel.mNumScalingKeys, ticks, point, {ours, "scale"}, clip);
  }

  struct Target {
    std::string node, property;
  };

  template <class T, class FromKey, class Value>
  void add(const FromKey* from, unsigned count, double ticks, Value value, const Target& target, Clip& clip) {
    std::vector<Key<T>> keys;
    std::size_t left_out = 0;
    for (unsigned i = 0; i < count; ++i) {
      const double time = from[i].mTime / ticks;
      const T at = value(from[i]);
      if (!std::isfinite(time) || !usable(at) || (!keys.empty() && time <= keys.back().time))
        ++left_out;
      else
        keys.push_back({.time = time, .value = at, .ease = straight_});
    }
    if (left_out)
      problems_.repair(place_, target.node + "." + target.property + ": " +
                                   models::counted(left_out, "key is out of order or not finite and was left out",
                                                   "keys are out of order or not finite and were left out"));
    if (!keys.empty())
      clip.tracks.push_back({target.node, target.property, keyed_curve<T>(std::span<const Key<T>>(keys))});
  }

  const Model& model_;
  const std::map<std::string, std::size_t>& nodes_;
  models::ModelProblems& problems_;
  std::set<std::size_t> driven_;
  std::string place_;
  Ease straight_ = Ease::linear();
};

}  // namespace

std::vector<Clip> scene_clips(const aiScene& scene, const Model& model, const std::map<std::string, std::size_t>& nodes,
                              models::ModelProblems& problems) {
  std::vector<Clip> clips;
  models::UniqueNames names;
  ClipReader reader(model, nodes, problems);
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
    const aiAnimation& animation = *scene.mAnimations[i];
    std::string name = text_of(animation.mName);
    if (name.empty()) name = "animation_" + std::to_string(i);
    clips.push_back(reader.read(animation, names.unique(name)));
  }
  return clips;
}

}  // namespace tweenfall::assimp
