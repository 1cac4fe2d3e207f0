#pragma once

#include <tweenfall/curves/values.h>

#include <span>

namespace tweenfall::shapes {

/// The directions in which points (at least one) spread least (first) to most (last): columns of unit length,
/// perpendicular and right-handed. The greatest coordinate of the last two is positive.
[[nodiscard]] Mat3 principal_axes(std::span<const Vec3> points) noexcept;
/// The mean of the points.
[[nodiscard]] Vec3 mean_of(std::span<const Vec3> points) noexcept;

}  // namespace tweenfall::shapes
