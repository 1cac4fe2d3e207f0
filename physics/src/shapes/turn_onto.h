#pragma once

#include <tweenfall/curves/values.h>

namespace tweenfall::shapes {

/// The shortest rotation that takes one direction to another, neither zero. For opposite ones, the axis is
/// perpendicular to the first and as near as possible to the coordinate axis along which the first is least.
[[nodiscard]] Quat turn_onto(const Vec3& from, const Vec3& to) noexcept;

}  // namespace tweenfall::shapes
