#pragma once

// Rest poses in the space of the whole figure.

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/curves/reflection.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <span>
#include <vector>

namespace tweenfall::pose {

/// The pose of each node, from given local poses; rotations are of unit length. Empty `local`: the nodes' rest poses.
[[nodiscard]] inline std::vector<Pose> figure_poses(const Hierarchy& nodes, std::span<const Pose> local = {}) {
  std::vector<Pose> poses(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Pose own = local.empty() ? nodes[i].rest : local[i];
    own.rotation = normalized(own.rotation);
    poses[i] = nodes[i].parent == no_node ? own : compose(poses[nodes[i].parent], own);
    poses[i].rotation = normalized(poses[i].rotation);
  }
  return poses;
}

/// The same rotation, or the identity if it differs from that only by rounding.
[[nodiscard]] inline Quat tidied(const Quat& q) noexcept {
  if (q.vec().cwiseAbs().maxCoeff() < 1e-12) return {1, 0, 0, 0};
  return q;
}

/// The same number, or the nearest integer if it differs from that only by rounding.
[[nodiscard]] inline double tidied(double number) noexcept {
  const double whole = std::round(number);
  return std::abs(number - whole) < 1e-12 ? whole : number;
}

}  // namespace tweenfall::pose
