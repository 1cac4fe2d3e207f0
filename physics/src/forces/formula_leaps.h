#pragma once

#include <tweenfall/curves/expression.h>

#include <string>

namespace tweenfall::forces {

/// Whether a formula of t contains anything that jumps from one value to another.
[[nodiscard]] bool may_leap(const std::string& text);

/// Whether the value changes more from one time to a later one than the rates there allow.
[[nodiscard]] bool leaps(const Expression& formula, double from, double to);

/// The first time in (from, to] at which a formula jumps; infinity for none. The formula is sampled eight times in
/// between: jumps that undo each other between two samples go unseen, and so does one that is no larger than
/// what the formula's rate gives in that time.
[[nodiscard]] double next_leap(const Expression& formula, double from, double to);

}  // namespace tweenfall::forces
