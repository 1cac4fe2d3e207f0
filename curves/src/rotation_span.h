#pragma once

// Evaluation of the two forms of rotation span.

#include <tweenfall/curves/rotation.h>
#include <tweenfall/curves/span.h>

#include "polynomial.h"

namespace tweenfall {

/// `from` exp(r) with r, r', r'' given: the rotation, its angular velocity and acceleration in the outer axes.
[[nodiscard]] Sample<Quat> sample_exponential(const Quat& from, const Polynomial<Vec4>& r) noexcept;

/// p / |p| with p = (x, y, z, w) and its derivatives; `fallback` where p vanishes.
[[nodiscard]] Sample<Quat> sample_normalized(const Polynomial<Vec4>& p, const Quat& fallback) noexcept;

}  // namespace tweenfall
