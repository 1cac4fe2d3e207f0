#pragma once

#include <tweenfall/curves/expression.h>

#include <string>

namespace tweenfall::forces {

/// Whether a formula of t has anything in it that leaps from one value to another.
[[nodiscard]] bool may_leap(const std::string& text);

/// Whether more has changed from one time to a later one than the rates there could.
[[nodiscard]] bool leaps(const Expression& formula, double from, double to);

/// The first time in (from, to] at which a formula leaps; infinity for none. It is looked for between eight looks at
/// the time in between: leaps that undo each other between two looks go unseen, and so does one that is no larger than
/// what the formula's rate makes of that time.
[[nodiscard]] double next_leap(const Expression& formula, double from, double to);

}  // namespace tweenfall::forces
