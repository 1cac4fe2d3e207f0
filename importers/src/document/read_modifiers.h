#pragma once

// Modifiers laid over a curve of numbers.

#include <tweenfall/curves/curve.h>

#include "document/problems.h"

#include <optional>

namespace tweenfall::document {

// The curve with the track's "modifiers" over it, if it has any; nothing where one of them is faulty.
[[nodiscard]] std::optional<Curve<double>> with_modifiers_of(const JsonValue& track, const Curve<double>& curve,
                                                             Problems& problems);

}  // namespace tweenfall::document
