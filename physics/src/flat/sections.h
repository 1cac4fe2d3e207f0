#pragma once

#include "flat/axes.h"

namespace tweenfall::flat {

/// The section of a shape on a node that lies in the plane. @throws std::invalid_argument saying what cannot be cut
[[nodiscard]] planar::Shape section_of(const Shape& shape, const Axes& axes);

/// Whether a vector lies in the plane, or turns in it: parts out of it, up to rounding, are zero.
[[nodiscard]] bool lies_in(const Axes& axes, const Vec3& v);
[[nodiscard]] bool turns_in(const Axes& axes, const Vec3& v);

}  // namespace tweenfall::flat
