#pragma once

// One span between two keys with handles, of any value type.

#include <tweenfall/curves/handles.h>

#include "curve/time_bezier.h"

namespace tweenfall::spans {

/// Gives `span` the coefficients and the warp of a Bezier from `from` that moves by `change`. `first` and `second` are
/// the movements from the first key to its handle and from the second handle to its key, at full widths.
template <class SpanType, class V>
void fill_bezier(SpanType& span, const V& from, const V& change, const V& first, const V& second,
                 const HandleWidths& widths, Overlong rule) {
  const HandleWidths fit = resolved(widths, rule);
  const V one = fit.start == widths.start ? first : V(fit.start / widths.start * first);
  const V two = fit.end == widths.end ? second : V(fit.end / widths.end * second);
  span.degree = 3;
  span.coefficients[0] = from;
  span.coefficients[1] = 3 * one;
  span.coefficients[2] = 3 * (change - two) - 6 * one;
  span.coefficients[3] = change + 3 * one - 3 * (change - two);
  constexpr double third = 1.0 / 3;
  if (fit.start != third || fit.end != third) span.warp = time_bezier_warp(fit.start, 1 - fit.end);
}

}  // namespace tweenfall::spans
