#pragma once

// The position on a Bezier span at a given time: the inverse of the handles' own cubic in time.

#include <tweenfall/curves/span.h>

namespace tweenfall {

/// Warp with parameters {x1, x2}: the handles' times as shares of the span, such that time never runs
/// backwards (they may lie outside 0 to 1). Where the tangent is vertical the slope is limited to a million.
[[nodiscard]] Warp time_bezier_warp(double x1, double x2);

/// Whether a warp is one of these; its parameters then begin with x1 and x2.
[[nodiscard]] bool is_time_bezier(const Warp& warp) noexcept;

}  // namespace tweenfall
