#pragma once

/// Cutting, joining and moving curves, and getting keys back out of them.
///
/// The result is the same motion, to rounding, with no more keys than asked for: spans keep their polynomials and their
/// eases, cut to the part that is left. Formulas and converted curves (colors mixed in a space, logarithms) stay
/// formulas. For double, Vec2, Vec3, Vec4, Color and Quat unless said otherwise.
///
/// To edit keys, edit them as a curve and take `keys_of` the result, or `fit` (fitting.h) where they cannot be exact.
///
/// All throw std::invalid_argument for times that are not finite, and where loops would play more than a million times.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/keys.h>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace tweenfall {

/// The part from `from` to `to`. Outside the knots, what the curve does there is written down: loops, straight
/// continuations and rests become spans ("baked"). Outside the part the result holds.
/// @throws std::invalid_argument unless from < to.
template <class T>
[[nodiscard]] Curve<T> trimmed(const Curve<T>& curve, double from, double to);

/// The part before `time` and the part after, between the first knot and the last; outside, both hold.
/// @throws std::invalid_argument unless start() < time < end().
template <class T>
[[nodiscard]] std::pair<Curve<T>, Curve<T>> split(const Curve<T>& curve, double time);

/// One curve after the other; outside its knots it continues as `first` does before and as `second` does after.
/// @throws std::invalid_argument unless second.start() is first.end(), to rounding (see `shifted`).
template <class T>
[[nodiscard]] Curve<T> joined(const Curve<T>& first, const Curve<T>& second);

/// The same curve with one more knot, or unchanged where there is a knot already.
/// @throws std::invalid_argument for a curve without spans, and unless start() <= time <= end().
template <class T>
[[nodiscard]] Curve<T> with_knot(const Curve<T>& curve, double time);

/// The same curve without the knots that `redundant_knots` (inspection.h) names. Not for Quat.
template <class T>
[[nodiscard]] Curve<T> without_redundant_knots(const Curve<T>& curve, double tolerance = 0);

/// The curve moved to `seconds` later; its rules outside move with it.
template <class T>
[[nodiscard]] Curve<T> shifted(const Curve<T>& curve, double seconds);

/// The curve stretched in time about `pivot`: what happens at pivot + t happens at pivot + factor t.
/// @throws std::invalid_argument unless factor > 0; `reversed` turns time around.
template <class T>
[[nodiscard]] Curve<T> time_scaled(const Curve<T>& curve, double factor, double pivot = 0);

/// The curve played backwards between its own ends, with its rules outside swapped.
template <class T>
[[nodiscard]] Curve<T> reversed(const Curve<T>& curve);

/// factor * value + offset, component by component. For double, Vec2, Vec3 and Vec4.
template <class T>
[[nodiscard]] Curve<T> value_scaled(const Curve<T>& curve, const T& factor, const T& offset = zero<T>());

/// Keys whose curve is this one, to rounding, to be edited or written down: held, straight and cubic spans, and
/// Bezier spans with weighted handles. For rotations, holds and turns at constant speed by less than half a turn.
/// @throws std::invalid_argument naming the time of a span that no key describes: a higher degree, an ease, a formula.
template <class T>
[[nodiscard]] std::vector<Key<T>> keys_of(const Curve<T>& curve);

/// A span as Bezier points: its ends and, between them, the points that the curve heads for; times in s and values.
template <class T>
struct BezierPoints {
  std::array<double, 4> times;
  std::array<T, 4> values;
};

/// The spans of a curve as Bezier points. For double, Vec2, Vec3, Vec4 and Color.
/// @throws std::invalid_argument as `keys_of` does, except that handles may lie outside their spans.
template <class T>
[[nodiscard]] std::vector<BezierPoints<T>> bezier_points(const Curve<T>& curve);

/// Keys for spans given by Bezier points, each beginning where the one before ends. For double, Vec2, Vec3 and Vec4.
/// @throws std::invalid_argument naming the span: no spans, a gap, a handle outside its span or at its own key.
template <class T>
[[nodiscard]] std::vector<Key<T>> keys_of(std::span<const BezierPoints<T>> spans);

/// The same keys, with every slope stated that a rule would choose, so that slopes can be changed one by one.
template <class T>
[[nodiscard]] std::vector<Key<T>> with_given_slopes(std::span<const Key<T>> keys, const KeyOptions& options = {});

/// The keys with one more at `time`, which leaves the curve as it is; slopes are stated as by `with_given_slopes`.
/// @throws std::invalid_argument naming the key before `time` where two keys cannot describe its span: an ease other
///         than a Bezier or a power up to 3, and for rotations anything but holds and turns at constant speed; and
///         unless `time` lies between the first and the last key.
template <class T>
[[nodiscard]] std::vector<Key<T>> with_key(std::span<const Key<T>> keys, double time, const KeyOptions& options = {});

}  // namespace tweenfall
