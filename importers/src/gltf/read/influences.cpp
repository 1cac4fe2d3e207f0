#include "gltf/read/influences.h"

#include "model/model_influences.h"

#include <algorithm>

namespace tweenfall::gltf {

namespace {

struct Set {
  Decoded joints, weights;
};

/// One pair JOINTS_n and WEIGHTS_n; empty when absent or wrong.
std::optional<Set> read_set(const Fields& attributes, const std::string& number, std::size_t vertices,
                            Accessors& accessors) {
  const std::string joints_name = "JOINTS_" + number, weights_name = "WEIGHTS_" + number;
  if (attributes.has(joints_name.c_str()) != attributes.has(weights_name.c_str())) {
    attributes.problems().add(attributes.place(), joints_name + " and " + weights_name + " must come together");
    return std::nullopt;
  }
  const auto joints_index = attributes.index(joints_name.c_str(), accessors.size());
  const auto weights_index = attributes.index(weights_name.c_str(), accessors.size());
  if (!joints_index || !weights_index) return std::nullopt;
  auto joints = accessors.read(*joints_index, attributes.place_of(joints_name), {"VEC4"}, Wanted::indices);
  auto weights = accessors.read(*weights_index, attributes.place_of(weights_name), {"VEC4"}, Wanted::reals);
  if (!joints || !weights) return std::nullopt;
  bool whole = true;
  for (const auto& [name, count] : {std::pair{joints_name, joints->count}, std::pair{weights_name, weights->count}}) {
    if (count == vertices) continue;
    attributes.problems().add(attributes.place_of(name), "has " + std::to_string(count) + " elements for " +
                                                             std::to_string(vertices) + " vertices");
    whole = false;
  }
  if (!whole) return std::nullopt;
  return Set{std::move(*joints), std::move(*weights)};
}

}  // namespace

Influences read_influences(const Fields& attributes, std::size_t vertices, Accessors& accessors,
                           std::size_t& joint_count) {
  std::vector<Set> sets;
  for (std::size_t number = 0; attributes.has(("JOINTS_" + std::to_string(number)).c_str()) ||
                               attributes.has(("WEIGHTS_" + std::to_string(number)).c_str());
       ++number) {
    auto set = read_set(attributes, std::to_string(number), vertices, accessors);
    if (!set) return {};
    sets.push_back(std::move(*set));
  }
  if (sets.empty()) return {};
  models::InfluenceTally tally;
  Influences all;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    std::vector<Influence> pulls;
    for (const Set& set : sets)
      for (std::size_t slot = 0; slot < 4; ++slot) {
        const double weight = set.weights.at(vertex)[slot];
        const auto joint = static_cast<std::uint32_t>(set.joints.at(vertex)[slot]);
        pulls.push_back({joint, weight});
        if (weight > 0) joint_count = std::max(joint_count, std::size_t{joint} + 1);
      }
    all.add(models::summing_to_one(std::move(pulls), tally));
  }
  tally.report(attributes.place(), attributes.problems());
  joint_count = std::max(joint_count, std::size_t{1});
  return all;
}

}  // namespace tweenfall::gltf
