#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// How large a shape looks along a direction: the area of its shadow, m^2. Parts of a compound count each by itself.
/// @param direction  unit, node axes
[[nodiscard]] double shadow_of(const Shape& shape, const Vec3& direction);

}  // namespace tweenfall::shapes
