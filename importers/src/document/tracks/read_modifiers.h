#pragma once

// Modifiers laid over a curve of numbers, or over the components of vectors.

#include <tweenfall/curves/curve.h>

#include "document/report/problems.h"

#include <optional>

namespace tweenfall::document {

// The curve (of double, Vec2, Vec3 or Vec4) with the track's "modifiers" over it, if it has any; empty where one of
// them is faulty.
template <class T>
[[nodiscard]] std::optional<Curve<T>> with_modifiers_of(const json::Value& track, const Curve<T>& curve,
                                                        Problems& problems);

}  // namespace tweenfall::document
