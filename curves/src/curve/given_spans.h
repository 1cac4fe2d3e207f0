#pragma once

/// The spans given to a curve: checks, and what they have in common, so that the curve stores less.

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "curve/curve_data.h"
#include "rotation/rotation_span.h"

namespace tweenfall::spans {

[[noreturn]] inline void refuse(std::size_t index, double start, const std::string& what) {
  throw std::invalid_argument("span " + std::to_string(index) + " (at " + text_of(start) + " s) " + what);
}

/// How many of the coefficients a span has.
template <class T>
int rows_of(const Span<T>& span) noexcept {
  return span.degree + 1;
}
inline int rows_of(const RotationSpan& span) noexcept {
  return span.form == RotationSpan::Form::nested ? rotation_rows : span.degree + 1;
}

/// Values, rates and accelerations must be finite, also after a warp has scaled them.
template <class SpanType>
void check_size(std::size_t index, const SpanType& s) {
  double value = 0, rate = 0, acceleration = 0;
  for (int k = 0; k < rows_of(s); ++k) {
    const auto& c = s.coefficients[static_cast<std::size_t>(k)];
    for (int i = 0; i < dimensions<std::decay_t<decltype(c)>>; ++i) {
      const double size = std::abs(component(c, i));
      value += size;
      rate += k * size;
      acceleration += k * (k - 1) * size;
    }
  }
  if constexpr (std::is_same_v<SpanType, RotationSpan>) {
    constexpr double most = 1e15;  // beyond it no digit is left below a turn
    const double turn = value + s.spin.cwiseAbs().sum();
    if (!(turn <= most)) refuse(index, s.start, "turns too far to tell where it ends, by more than 1e15 rad");
    // Where the axis of a turn moves, it adds the square of the rate to the acceleration.
    rate += turn;
    acceleration += rate * rate;
  }
  if (s.warp.function) {
    constexpr double room = 1e30;
    value *= room;
    rate *= room;
    acceleration = room * (rate + acceleration);
  }
  const double inverse = 1 / s.duration;
  if (!std::isfinite(value)) refuse(index, s.start, "adds up to values too large for a number");
  if (!std::isfinite(inverse * inverse) || !std::isfinite(rate * inverse) ||
      !std::isfinite(acceleration * (inverse * inverse)))
    refuse(index, s.start, "changes faster than a number can tell, within " + text_of(s.duration) + " s");
}

template <class SpanType>
void check(std::span<const SpanType> spans) {
  if (spans.empty()) throw std::invalid_argument("a curve needs at least one span; none were given");
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SpanType& s = spans[i];
    if (!std::isfinite(s.start)) refuse(i, s.start, "must start at a finite time");
    if (!(s.duration > 0) || !std::isfinite(s.duration))
      refuse(i, s.start, "must have a finite duration > 0 s; it is " + text_of(s.duration));
    if (s.degree < 0 || s.degree > max_degree)
      refuse(i, s.start,
             "must have a degree from 0 to " + std::to_string(max_degree) + "; it is " + std::to_string(s.degree));
    for (int k = 0; k < rows_of(s); ++k)
      if (!all_finite(s.coefficients[static_cast<std::size_t>(k)]))
        refuse(i, s.start,
               "needs finite numbers whose differences are finite too; coefficient " + std::to_string(k) + " is " +
                   text_of(s.coefficients[static_cast<std::size_t>(k)]));
    if (!all_finite(s.end)) refuse(i, s.start, "has a non-finite end value " + text_of(s.end));
    if constexpr (std::is_same_v<SpanType, RotationSpan>)
      if (!all_finite(s.spin)) refuse(i, s.start, "has a non-finite spin " + text_of(s.spin));
    check_size(i, s);
    if (i == 0) continue;
    const double expected = spans[i - 1].start + spans[i - 1].duration;
    // Durations are differences of times, so the sum may be off by the rounding of both.
    const double slack = 4e-16 * (std::abs(s.start) + std::abs(spans[i - 1].start));
    if (!(s.start > spans[i - 1].start) || std::abs(s.start - expected) > slack)
      refuse(i, s.start, "must start where the one before ends, at " + text_of(expected) + " s");
  }
}

/// Whether all spans have coefficients of the same shape, so that one description does for all of them.
template <class SpanType>
bool are_alike(std::span<const SpanType> spans) {
  return std::ranges::all_of(spans, [&](const SpanType& s) {
    if constexpr (std::is_same_v<SpanType, RotationSpan>)
      if (s.form != spans[0].form) return false;
    return s.degree == spans[0].degree && !s.warp.function;
  });
}

/// Whether all spans are linear or cubic turns from one rotation to the next, as made by keys alone.
inline bool are_plain_turns(std::span<const RotationSpan> spans) {
  return are_alike(spans) && std::ranges::all_of(spans, [](const RotationSpan& s) {
           if (s.form != RotationSpan::Form::exponential || !s.spin.isZero(0)) return false;
           for (std::size_t k = 0; k <= static_cast<std::size_t>(s.degree); ++k)
             if (s.coefficients[k][3] != 0) return false;
           return s.coefficients[0].isZero(0);
         });
}

/// Whether each span ends, to the bit, at the value with which the next one starts.
template <class SpanType>
bool are_joined(std::span<const SpanType> spans) {
  for (std::size_t i = 0; i + 1 < spans.size(); ++i)
    if constexpr (std::is_same_v<SpanType, RotationSpan>) {
      if (spans[i].end.coeffs() != spans[i + 1].from.coeffs()) return false;
    } else {
      if (!(spans[i].end == spans[i + 1].coefficients[0])) return false;
    }
  return true;
}

}  // namespace tweenfall::spans
