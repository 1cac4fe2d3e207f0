#pragma once

/// What a curve is like: how smooth at its keys, whether flat, straight or monotone, which keys it does not need,
/// where it differs from another, and straight lines that stay near it.
///
/// Answers come from polynomials and their Bezier control points, which bound them between the keys too; nothing is
/// judged from samples, but eases and formulas are replaced by the quintics of `calculus.h`. Distances of vectors are
/// Euclidean, of colors those of their linear red, green, blue and alpha. For double, Vec2, Vec3, Vec4 and Color.
///
/// All that look at the whole curve throw std::invalid_argument for an endless one.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall {

/// The highest derivative up to which all are the same on both sides.
enum class Continuity { jump = -1, value = 0, rate = 1, acceleration = 2, smooth = 3 };

/// How smooth a curve is at each of its knots; at the first and the last, against its continuation outside.
/// Spans without a known third derivative are never `smooth`.
/// @param tolerance  relative: derivatives within this share of the larger are the same
template <class T>
[[nodiscard]] std::vector<Continuity> continuity(const Curve<T>& curve, double tolerance = 1e-9);

/// Whether a curve stays within `tolerance`, U, of its first value from its first knot to its last.
template <class T>
[[nodiscard]] bool is_flat(const Curve<T>& curve, double tolerance = 0);

/// Whether it stays within `tolerance` of the straight line in time between its ends.
template <class T>
[[nodiscard]] bool is_linear(const Curve<T>& curve, double tolerance = 0);

/// Whether it never falls, or never rises, between its first knot and its last.
[[nodiscard]] bool is_monotone(const Curve<double>& curve);

/// Indices of the knots, ends excepted, without which the curve would be the same within `tolerance`, U: the span
/// that arrives, continued, is the one that leaves. Each is judged with those before it left out.
template <class T>
[[nodiscard]] std::vector<std::size_t> redundant_knots(const Curve<T>& curve, double tolerance = 0);

struct Interval {
  double from, to;  ///< s
};

/// The times from `from` to `to` at which two curves are more than `tolerance`, U, apart, in order; single times do not
/// count. With tolerance 0, differences beyond rounding (1e-14 of the size; 4e-12 for eases and formulas).
template <class T>
[[nodiscard]] std::vector<Interval> differences(const Curve<T>& a, const Curve<T>& b, double from, double to,
                                                double tolerance = 0);

template <class T>
struct PolylinePoint {
  double time;
  T value;
};

/// Points on the curve such that the straight lines between them are never more than `error`, U, from the curve at the
/// same time, as proved by control points. A jump is two points at one time.
/// @throws std::invalid_argument unless error > 0.
template <class T>
[[nodiscard]] std::vector<PolylinePoint<T>> polyline(const Curve<T>& curve, double from, double to, double error);

}  // namespace tweenfall
