#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// Where a solid is in the world, ready for arithmetic.
struct Placed {
  Vec3 center;
  Mat3 axes;  ///< columns: the solid's own axes
};

[[nodiscard]] inline Placed place(const Shape& shape, const Pose& node) noexcept {
  const Quat rotation = node.rotation * shape.offset.rotation;
  return {node.position + node.rotation * shape.offset.position, rotation.toRotationMatrix()};
}

/// Upper bound of how far a solid reaches from its center along a unit direction, m: infinite if it is not known.
[[nodiscard]] double support_along(const Solid& solid, const Mat3& axes, const Vec3& direction);

}  // namespace tweenfall::shapes
