#pragma once

#include <tweenfall/curves/values.h>

namespace tweenfall::shapes {

/// The shortest rotation that takes one direction to another, neither zero. Of opposite ones the axis is across the
/// first and nearest to the coordinate axis that this is least along.
[[nodiscard]] Quat turn_onto(const Vec3& from, const Vec3& to) noexcept;

}  // namespace tweenfall::shapes
