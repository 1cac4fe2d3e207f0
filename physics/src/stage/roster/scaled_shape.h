#pragma once

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/physics/shape.h>

namespace tweenfall::staging {

/// The axes that the rest poses of a node and its ancestors give it.
struct RestAxes {
  Mat3 linear = Mat3::Identity(), turn = Mat3::Identity();
  Vec3 scale{1, 1, 1};  ///< those of the chain multiplied
  bool scaled = false;
};

/// For a node. @param parent  its parent's; without a parent, the default
[[nodiscard]] RestAxes rest_axes_below(const RestAxes& parent, const Pose& rest);
[[nodiscard]] RestAxes rest_axes(const Hierarchy& nodes, std::size_t node);

/// The scale of what hangs on a node, along its own axes.
/// @throws std::invalid_argument when the node is sheared: a body keeps its angles
[[nodiscard]] Vec3 rest_scale(const RestAxes& axes);

/// The shape as large as it is drawn on a node of this scale.
/// @throws std::invalid_argument if no solid of its kind has the scaled shape
[[nodiscard]] Shape scaled(const Shape& shape, const Vec3& scale);

}  // namespace tweenfall::staging
