#pragma once

#include <tweenfall/curves/values.h>

#include <span>

namespace tweenfall::shapes {

/// The directions in which points, at least one, are spread least (first) to most (last): columns of unit length across
/// each other, right-handed. The greatest coordinate of the last two is positive.
[[nodiscard]] Mat3 principal_axes(std::span<const Vec3> points) noexcept;
/// Where they are in the mean.
[[nodiscard]] Vec3 mean_of(std::span<const Vec3> points) noexcept;

}  // namespace tweenfall::shapes
