#pragma once

// A curve between two times as plain spans: loops and straight continuations outside the knots written out.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall::spans {

/// Whether a curve is made of spans (or is constant), so that `spans_between` can be used.
template <class T>
[[nodiscard]] bool has_spans(const Curve<T>& curve);

/// Spans from `from` to `to`, without gaps, the first starting and the last ending exactly there.
/// Precondition: has_spans(curve) and from < to, both finite.
/// @throws std::invalid_argument where loops would make more than a million plays.
template <class T>
[[nodiscard]] std::vector<typename SpanOf<T>::type> spans_between(const Curve<T>& curve, double from, double to);

/// Times at which a curve may be less than smooth: knots, and seams of loops, from `from` to `to` with both of these.
template <class T>
[[nodiscard]] std::vector<double> seams_between(const Curve<T>& curve, double from, double to);

/// @throws std::invalid_argument unless both are finite.
void check_times(double from, double to);

}  // namespace tweenfall::spans
