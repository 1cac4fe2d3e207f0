#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// A plane that may be a mirror.
struct Mirror {
  Vec3 normal;  ///< unit
  Vec3 point;   ///< on the plane, m
};

/// Whether a shape is its own mirror image up to rounding, or as good as that for what reaches no farther than `reach`
/// from the mirror. Meshes, height fields and compounds that are mirrored part onto part are told not to be.
[[nodiscard]] bool is_mirrored_near(const Shape& shape, const Pose& node, const Mirror& mirror, double reach);

}  // namespace tweenfall::shapes
