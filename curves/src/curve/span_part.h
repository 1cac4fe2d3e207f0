#pragma once

// A stretch of a span as a span of its own, forwards or backwards.

#include <tweenfall/curves/curve.h>

#include "curve/components.h"
#include "math/polynomial.h"

namespace tweenfall::spans {

/// What a span holds at its position u, 0 to 1; its end exactly at 1.
template <class T>
[[nodiscard]] T span_value(const Span<T>& span, double u) noexcept {
  if (u == 1) return span.end;
  const double s = span.warp.function ? span.warp.at(u).s : u;
  if constexpr (std::is_same_v<T, Color>) {
    std::array<Vec4, max_degree + 1> c;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k) c[k] = span.coefficients[k].rgba;
    return Color{math::polynomial_at(c.data(), span.degree, s)};
  } else {
    return math::polynomial_at(span.coefficients.data(), span.degree, s);
  }
}

/// The linear warp, with which a rotation span of any form can be cut and reversed.
inline Warp::Result straight_warp(double u, const std::array<double, 4>&) noexcept {
  return {u, 1, 0};
}

/// The span's positions from u0 to u1, backwards where u1 < u0, over [start, end].
template <class T>
[[nodiscard]] Span<T> span_part(const Span<T>& span, double u0, double u1, double start, double end) {
  Span<T> part = span;
  part.start = start;
  part.duration = end - start;
  if (u0 == 0 && u1 == 1) return part;
  part.end = span_value(span, u1);
  if (span.warp.function) {
    part.warp.from = span.warp.from + span.warp.width * u0;
    part.warp.width = span.warp.width * (u1 - u0);
    return part;
  }
  T* c = part.coefficients.data();
  if constexpr (std::is_same_v<T, Color>) {
    std::array<Vec4, max_degree + 1> rgba;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k) rgba[k] = c[k].rgba;
    math::substitute(rgba.data(), span.degree, u0, u1 - u0);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k) c[k].rgba = rgba[k];
  } else {
    math::substitute(c, span.degree, u0, u1 - u0);
  }
  if (u0 == 1) c[0] = span.end;
  return part;
}

[[nodiscard]] inline RotationSpan span_part(const RotationSpan& span, double u0, double u1, double start, double end) {
  RotationSpan part = span;
  part.start = start;
  part.duration = end - start;
  if (u0 == 0 && u1 == 1) return part;
  const Curve<Quat> whole{std::span<const RotationSpan>(&span, 1)};
  part.end = u1 == 0   ? whole.value(whole.start())
             : u1 == 1 ? span.end
                       : whole.value(whole.start() + u1 * whole.duration(), Side::in);
  if (!span.warp.function) part.warp.function = &straight_warp;
  part.warp.from = span.warp.from + span.warp.width * u0;
  part.warp.width = span.warp.width * (u1 - u0);
  return part;
}

}  // namespace tweenfall::spans
