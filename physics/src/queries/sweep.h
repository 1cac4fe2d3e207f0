#pragma once

#include <tweenfall/physics/query.h>

namespace tweenfall::queries {

/// How far a shape can move along its displacement until it meets another; not both may be planes.
[[nodiscard]] std::optional<ShapeHit> first_on_way(const Shape& moving, const Pose& start, const Vec3& displacement,
                                                   const Shape& shape, const Pose& pose);

}  // namespace tweenfall::queries
