#pragma once

/// Few keys for a curve, for samples, or in place of many keys, never farther from them than a stated error.
///
/// The error bounds the whole span, not just sampled places. For numbers and vectors the difference from the cubic is a
/// polynomial (also where handles are weighted: then in the handles' own position), bounded by its Bezier control
/// points; eases and formulas count as the quintics of `calculus.h`, whose own error is deducted from the allowed one.
/// Where keys are mixed in other coordinates (colors, rotations, logarithms) the difference is bounded on ever shorter
/// stretches by its value and rate in the middle and twice the greatest difference of accelerations at the ends and the
/// middle: a sound bound where accelerations do not peak between these. Distances are Euclidean for vectors, of linear
/// red, green, blue and alpha for colors, and angles in radians for rotations.
///
/// Keys lie on the curve, and each reaches as far as the error lets it (longest first): where a shorter span is never
/// worse than a longer one, fewer keys of this kind would not do. Time grows as n log n in the number of spans.

#include <tweenfall/curves/keys.h>

#include <span>
#include <vector>

namespace tweenfall {

/// Where the slopes of fitted keys come from.
enum class FitSlopes {
  own,            ///< those of the curve: as smooth as the curve itself
  least_squares,  ///< those that fit the span best, smooth across keys where possible: for noise and for corners.
                  ///< Numbers and vectors only; for all else `own`
};

struct FitOptions {
  FitSlopes slopes = FitSlopes::own;
  KeyOptions keys = {};  ///< the options with which the keys will be made into a curve
};

/// Keys whose curve stays within `error`, U, of `curve` from its first knot to its last. Straight and held stretches
/// get linear and hold keys.
/// @throws std::invalid_argument unless error > 0 and larger than rounding, and for an endless curve.
template <class T>
[[nodiscard]] std::vector<Key<T>> fit(const Curve<T>& curve, double error, const FitOptions& options = {});

/// The same for samples: keys for the Catmull-Rom curve through them (`catmull_rom` keys at the samples), which they
/// approach within `error` at all times, hence at every sample.
/// @throws std::invalid_argument naming the sample, as keys are refused.
template <class T>
[[nodiscard]] std::vector<Key<T>> fit_samples(std::span<const double> times, std::span<const T> values, double error,
                                              const FitOptions& options = {});

/// Straight keys (`Ease::linear`) within `error`; for rotations, turns at constant speed.
template <class T>
[[nodiscard]] std::vector<Key<T>> fit_linear(const Curve<T>& curve, double error, const FitOptions& options = {});

/// Some of the keys, with slopes stated, whose curve stays within `error` of the curve of all. Where two neighbors are
/// both kept, the span between them stays as it is, ease included; longer spans become cubic, straight or held.
template <class T>
[[nodiscard]] std::vector<Key<T>> reduce(std::span<const Key<T>> keys, double error, const FitOptions& options = {});

}  // namespace tweenfall
