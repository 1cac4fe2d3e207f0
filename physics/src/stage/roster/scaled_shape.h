#pragma once

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/physics/shape.h>

namespace tweenfall::staging {

/// The scale that the rest poses of a node and its ancestors give to what hangs on it, along its own axes.
/// @throws std::invalid_argument when they shear it: a body keeps its angles
[[nodiscard]] Vec3 rest_scale(const Hierarchy& nodes, std::size_t node);

/// The shape as large as it is drawn on a node of this scale.
/// @throws std::invalid_argument where no solid of its kind has the scaled shape
[[nodiscard]] Shape scaled(const Shape& shape, const Vec3& scale);

}  // namespace tweenfall::staging
