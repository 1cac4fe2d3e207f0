#include <tweenfall/anim/skinning.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tweenfall {
namespace skin {
namespace {

// The range of all products of a number of one range with a number of another.
void multiply(Vec3& low, Vec3& high, double least, double most) noexcept {
  const Vec3 a = least * low, b = least * high, c = most * low, d = most * high;
  low = a.cwiseMin(b).cwiseMin(c.cwiseMin(d));
  high = a.cwiseMax(b).cwiseMax(c.cwiseMax(d));
}

}  // namespace
}  // namespace skin

bool MeshBounds::contains(const Vec3& point) const noexcept {
  for (int i = 0; i < 3; ++i)
    if (!(point[i] >= low[i] && point[i] <= high[i])) return false;
  return true;
}

MeshBounds bounds_of(std::span<const Vec3> points) noexcept {
  MeshBounds bounds;
  for (const Vec3& point : points) {
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
  }
  return bounds;
}

SkinBounds::SkinBounds(const Mesh& mesh, std::size_t joints) : rest_weights_(mesh.rest_weights) {
  std::vector<std::size_t> box_of(joints, no_node);
  const std::size_t targets = mesh.morphs.size();
  const auto put = [&](std::size_t joint, std::size_t vertex) {
    std::size_t& box = box_of[joint];
    const Vec3& position = mesh.positions[vertex];
    if (box == no_node) {
      box = boxes_.size();
      boxes_.push_back({static_cast<std::uint32_t>(joint), {position, position}});
      for (std::size_t target = 0; target < targets; ++target) {
        const Vec3& offset = mesh.morphs[target].position_offsets[vertex];
        offsets_.push_back({offset, offset});
      }
    }
    const auto widen = [](Range& range, const Vec3& point) {
      range.low = range.low.cwiseMin(point);
      range.high = range.high.cwiseMax(point);
    };
    widen(boxes_[box].rest, position);
    for (std::size_t target = 0; target < targets; ++target)
      widen(offsets_[box * targets + target], mesh.morphs[target].position_offsets[vertex]);
  };
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    if (mesh.influences.empty() || joints == 1) {
      if (joints == 0) throw std::invalid_argument("skin bounds: there must be a joint that carries the mesh");
      put(0, vertex);
      continue;
    }
    double sum = 0;
    for (const auto& [joint, weight] : mesh.influences[vertex]) {
      if (weight < 0 || joint >= joints)
        throw std::invalid_argument("skin bounds: vertex " + std::to_string(vertex) + " is pulled by joint " +
                                    std::to_string(joint) + " with weight " + number_text(weight) + "; there are " +
                                    std::to_string(joints) + " joints, and no weight is negative");
      sum += weight;
      if (weight > 0) put(joint, vertex);
    }
    least_sum_ = std::min(least_sum_, sum);
    most_sum_ = std::max(most_sum_, sum);
  }
}

MeshBounds SkinBounds::world(std::span<const SkinJoint> joints, std::span<const double> weights) const noexcept {
  constexpr double rounding = 1e-14;
  const std::span<const double> in_force = weights.empty() ? std::span<const double>(rest_weights_) : weights;
  const std::size_t targets = boxes_.empty() ? 0 : offsets_.size() / boxes_.size();
  MeshBounds bounds;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    Range box = boxes_[i].rest;
    for (std::size_t target = 0; target < targets && target < in_force.size(); ++target) {
      Range moved = offsets_[i * targets + target];
      skin::multiply(moved.low, moved.high, in_force[target], in_force[target]);
      box.low += moved.low;
      box.high += moved.high;
    }
    const WorldFrame& frame = joints[boxes_[i].joint].moved;
    const Vec3 middle = frame.point(0.5 * (box.low + box.high));
    const Vec3 half = frame.linear.cwiseAbs() * Vec3(0.5 * (box.high - box.low));
    const Vec3 wide = half + rounding * (half + middle.cwiseAbs() + frame.origin.cwiseAbs());
    bounds.low = bounds.low.cwiseMin(middle - wide);
    bounds.high = bounds.high.cwiseMax(middle + wide);
  }
  if (!boxes_.empty()) skin::multiply(bounds.low, bounds.high, least_sum_, most_sum_);
  return bounds;
}

}  // namespace tweenfall
