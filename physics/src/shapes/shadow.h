#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// The area a shape shows along a direction, m^2. Parts of a compound count one by one.
/// @param direction  unit, node axes
[[nodiscard]] double shadow_of(const Shape& shape, const Vec3& direction);

}  // namespace tweenfall::shapes
