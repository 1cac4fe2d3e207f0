#pragma once

/// Calculus on curves, from their polynomials rather than from samples: derivatives, integrals, range, extremes,
/// the times at which a value is taken, and the inverse.
///
/// Polynomial spans and Bezier spans with weighted handles are answered exactly, to rounding (the latter by a
/// change of variable). Eases with other warps, formulas and converted curves are replaced by piecewise quintics that
/// agree with them within 1e-12 of their size at the points checked; times found there are then refined on the curve
/// itself. Loops and straight continuations outside the knots count like everything else.
///
/// All throw std::invalid_argument for a time that is not finite, and where loops would play more than a million times.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall {

/// Integral from `from` to `to`, U s; negative when to < from. For double, Vec2, Vec3, Vec4.
template <class T>
[[nodiscard]] T integral(const Curve<T>& curve, double from, double to);

/// The curve whose rate is `curve` and which begins, at its start, with `first`, U s. Its spans are one degree higher,
/// so it is made of spans where those of `curve` are unwarped and of degree 4 at most, else a formula. Outside its
/// knots it is exact where `curve` holds, and as long as `curve` repeats; otherwise it goes on straight.
/// @throws std::invalid_argument for an endless curve.
template <class T>
[[nodiscard]] Curve<T> antiderivative(const Curve<T>& curve, const T& first = zero<T>());

/// Derivative of any order at a time, U/s^order; order 0 is the value.
/// @throws std::invalid_argument for an order < 0 or > 8, and for one above 2 where the curve is a formula or an ease
/// without higher derivatives.
template <class T>
[[nodiscard]] T derivative_at(const Curve<T>& curve, int order, double time, Side side = Side::out);

/// The rate as a curve, over the same knots and at all times outside them. Made of spans where those of `curve` are
/// unwarped and `curve` holds, goes on straight or repeats for ever outside its knots; otherwise a formula.
/// @throws std::invalid_argument where the third derivative is not known (see `derivative_at`).
template <class T>
[[nodiscard]] Curve<T> derivative(const Curve<T>& curve);

struct Range {
  double low, high;
};
/// Least and greatest value between `from` and `to`.
[[nodiscard]] Range range(const Curve<double>& curve, double from, double to);

/// Times inside the knots at which the rate passes through zero, in order; none on flat stretches.
[[nodiscard]] std::vector<double> extrema(const Curve<double>& curve);

/// All times from `from` to `to` at which the curve equals `level`, in order. Where it stays on the level for a while,
/// the two ends of that stretch.
[[nodiscard]] std::vector<double> solve(const Curve<double>& curve, double level, double from, double to);

/// The same for the level 0 over all knots.
[[nodiscard]] std::vector<double> roots(const Curve<double>& curve);

/// The time at which a rising or falling curve takes a value, as a curve over values with exact rates, from its least
/// to its greatest value; outside these it holds. Where the curve rests, `Side::in` gives the first time and
/// `Side::out` the last; across a jump the time stays the same.
/// @throws std::invalid_argument unless the curve has an end and is monotone and not constant, saying where it turns.
[[nodiscard]] Curve<double> inverse(const Curve<double>& curve);

}  // namespace tweenfall
