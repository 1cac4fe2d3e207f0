#pragma once

// Evaluation of the forms of rotation span.

#include <tweenfall/curves/rotation.h>
#include <tweenfall/curves/span.h>

#include "math/polynomial.h"

namespace tweenfall::rotations {

/// `from` exp(r) with r, r', r'' given: the rotation, its angular velocity and acceleration in the outer axes.
[[nodiscard]] Sample<Quat> sample_exponential(const Quat& from, const math::Polynomial<Vec3>& r) noexcept;

/// p / |p| with p = (x, y, z, w) and its derivatives; `fallback` where p vanishes.
[[nodiscard]] Sample<Quat> sample_normalized(const math::Polynomial<Vec4>& p, const Quat& fallback) noexcept;

/// Slerps of slerps: the eight rows of a nested span, at s with derivatives of s carried through.
[[nodiscard]] Sample<Quat> sample_nested(const Vec4* rows, const Warp::Result& s) noexcept;

/// `sample` turned further by exp(s spin).
[[nodiscard]] Sample<Quat> spun(const Sample<Quat>& sample, const Vec3& spin, const Warp::Result& s) noexcept;

}  // namespace tweenfall::rotations
