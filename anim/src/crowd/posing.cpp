#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "crowd/compiled_clip.h"
#include "crowd/pose_kernels.h"

namespace tweenfall {

namespace crowd {
namespace {

void copy_pose(std::span<const CrowdGroup> from, std::span<CrowdGroup> to) {
  if (from.data() != to.data()) std::copy_n(from.data(), to.size(), to.data());
}

}  // namespace

void blend_with(const PoseKernels& kernels, std::span<const CrowdLayer> layers, std::span<CrowdGroup> out) noexcept {
  if (layers.empty()) return;
  if (std::ranges::any_of(layers, [](const CrowdLayer& layer) { return !layer.mask.empty(); }))
    return kernels.blend_masked(layers.data(), layers.size(), out.size(), out.data());
  const auto has_weight = [](const CrowdLayer& layer) { return layer.weight > least_weight; };
  const auto lead = std::ranges::find_if(layers, has_weight);
  if (lead == layers.end()) return copy_pose(layers[0].pose, out);
  float total = 0;
  for (const CrowdLayer& layer : layers) total += has_weight(layer) ? layer.weight : 0;
  // The others contribute nothing, but would round.
  if (total == lead->weight && std::ranges::none_of(lead + 1, layers.end(), has_weight))
    return copy_pose(lead->pose, out);
  const std::size_t first = static_cast<std::size_t>(lead - layers.begin());
  kernels.blend(layers.data() + first, layers.size() - first, 1 / total, out.size(), out.data());
}

void add_with(const PoseKernels& kernels, std::span<const CrowdGroup> base, std::span<const CrowdGroup> difference,
              float weight, std::span<CrowdGroup> out, std::span<const float> mask) noexcept {
  if (weight == 0) return copy_pose(base, out);
  kernels.add(base.data(), difference.data(), weight, mask.empty() ? nullptr : mask.data(), out.size(), out.data());
}

}  // namespace crowd

std::vector<float> crowd_mask(const JointMask& mask, std::size_t joints) {
  if (mask.size() != 0 && mask.size() != joints)
    throw std::invalid_argument("a mask of " + std::to_string(mask.size()) + " nodes does not fit " +
                                std::to_string(joints) + " joints");
  std::vector<float> lanes(crowd_groups(joints) * CrowdGroup::size, 0.0F);
  for (std::size_t joint = 0; joint < joints; ++joint) lanes[joint] = static_cast<float>(mask[joint]);
  return lanes;
}

void blend(std::span<const CrowdLayer> layers, std::span<CrowdGroup> out) noexcept {
  crowd::blend_with(crowd::fastest_pose_kernels(), layers, out);
}

void difference(std::span<const CrowdGroup> reference, std::span<const CrowdGroup> pose,
                std::span<CrowdGroup> out) noexcept {
  crowd::fastest_pose_kernels().difference(reference.data(), pose.data(), out.size(), out.data());
}

void add(std::span<const CrowdGroup> base, std::span<const CrowdGroup> difference, float weight,
         std::span<CrowdGroup> out, std::span<const float> mask) noexcept {
  crowd::add_with(crowd::fastest_pose_kernels(), base, difference, weight, out, mask);
}

CrowdSkeleton::CrowdSkeleton(const Hierarchy& nodes) : order_(nodes.size()) {
  parents_.reserve(nodes.size());
  std::vector<std::uint32_t> depths;
  depths.reserve(nodes.size());
  for (const Node& node : nodes.nodes()) {
    const bool is_root = node.parent == no_node;
    parents_.push_back(is_root ? outside : static_cast<std::uint32_t>(node.parent));
    depths.push_back(is_root ? 0 : depths[node.parent] + 1);
  }
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::stable_sort(order_, {}, [&](std::uint32_t joint) { return depths[joint]; });
}

void CrowdSkeleton::local_to_world(std::span<const CrowdGroup> pose, std::span<CrowdMatrix> world,
                                   const CrowdMatrix& root) const noexcept {
  const crowd::PoseKernels& kernels = crowd::fastest_pose_kernels();
  kernels.place(pose.data(), parents_.size(), world.data());
  kernels.compose(order_.data(), parents_.data(), parents_.size(), root, world.data());
}

}  // namespace tweenfall
