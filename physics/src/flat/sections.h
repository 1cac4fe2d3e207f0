#pragma once

#include "flat/axes.h"

namespace tweenfall::flat {

/// What a plane cuts out of a shape on a node that lies in it. @throws std::invalid_argument telling what cannot be cut
[[nodiscard]] planar::Shape section_of(const Shape& shape, const Axes& axes);

/// Lies in the plane and turns in it: positions and rates off it, up to rounding, are none.
[[nodiscard]] bool lies_in(const Axes& axes, const Vec3& v);
[[nodiscard]] bool turns_in(const Axes& axes, const Vec3& v);

}  // namespace tweenfall::flat
