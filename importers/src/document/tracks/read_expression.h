#pragma once

// Expressions of t from checked texts.

#include <tweenfall/anim/track.h>
#include <tweenfall/curves/expression.h>

#include "document/report/problems.h"

#include <optional>

namespace tweenfall::document {

// The curve of a track's "expression", with its "parameters": a number for one text, a vector for a list.
// Empty where it is faulty, which is reported at the place within the text.
[[nodiscard]] std::optional<TrackCurve> read_expression(const json::Value& track, Problems& problems);

// Reports a fault of an expression at its place within the text.
void add_fault_of_expression(const json::Value& text, const ExpressionError& fault, Problems& problems);

}  // namespace tweenfall::document
