#pragma once

/// Where curves leap from one value to another beside their knots: by formulas (floor, step, mod, ...) and modifiers.

#include <tweenfall/curves/curve.h>

#include <functional>
#include <span>
#include <vector>

namespace tweenfall {

/// A number over time, with its rate by it.
using NumberOverTime = std::function<Sample<double>(double time, Side side)>;

/// Whether more has changed from one place to a later one than the rates there could.
[[nodiscard]] bool leaps(const NumberOverTime& formula, double from, double to);

/// The first place in (from, to] at which a formula leaps; infinity for none. It is looked for between eight looks at
/// what is in between: leaps that undo each other between two looks go unseen, and so does one that is no larger than
/// what the formula's rate makes of that way.
[[nodiscard]] double next_leap(const NumberOverTime& formula, double from, double to);

/// The parts of a curve's formula that may leap at times that are not knots of the curve, which may continue all the
/// same: parts may make up for each other. Empty where it can jump at its knots only.
template <class T>
[[nodiscard]] std::span<const NumberOverTime> leaping(const Curve<T>& curve) noexcept;

/// The same curve, whose formula may leap where these parts do.
template <class T>
[[nodiscard]] Curve<T> with_leaping(const Curve<T>& curve, std::span<const NumberOverTime> parts);

}  // namespace tweenfall
