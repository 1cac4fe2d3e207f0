#pragma once

// Splines that stand in place of keys.

#include <tweenfall/curves/curve.h>

#include "document/problems.h"

#include <optional>

namespace tweenfall::document {

// The curve of a track's "spline", "bezier" or "b_spline", of double, Vec2, Vec3 or Vec4, its values times `unit`.
// Empty where it has none and where it is faulty, which then is noted. What happens outside is not applied.
template <class T>
[[nodiscard]] std::optional<Curve<T>> read_spline(const JsonValue& track, double unit, Problems& problems);

}  // namespace tweenfall::document
