#pragma once

#include <tweenfall/physics/query.h>

namespace tweenfall::queries {

/// How much of its displacement a shape can go until it meets another, which is not to be a plane where this is one.
[[nodiscard]] std::optional<ShapeHit> first_on_way(const Shape& moving, const Pose& start, const Vec3& displacement,
                                                   const Shape& shape, const Pose& pose);

}  // namespace tweenfall::queries
