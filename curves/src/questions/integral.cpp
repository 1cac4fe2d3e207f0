#include <tweenfall/curves/calculus.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "curve/spans_between.h"
#include "questions/curve_pieces.h"

namespace tweenfall::questions {
namespace {

// Integral of a piece from its start to the position s: the polynomial itself, or by change of variable times x'.
template <class V>
V piece_integral(const CurvePiece<V>& piece, double s) noexcept {
  V sum = zero<V>();
  if (!piece.timed) {
    for (int i = piece.degree; i >= 0; --i) sum = s * (sum + piece.c[static_cast<std::size_t>(i)] / (i + 1));
    return (piece.to - piece.from) * sum;
  }
  const double rate[3] = {piece.x[1], 2 * piece.x[2], 3 * piece.x[3]};
  for (int k = piece.degree + 2; k >= 0; --k) {
    V coefficient = zero<V>();
    for (int j = std::max(0, k - piece.degree); j <= std::min(k, 2); ++j)
      coefficient = coefficient + rate[j] * piece.c[static_cast<std::size_t>(k - j)];
    sum = s * (sum + coefficient / (k + 1));
  }
  return (piece.to - piece.from) * sum;
}

template <class T>
Span<T> integrated(const Span<T>& span, double duration, const T& first) {
  Span<T> result = span;
  result.degree = span.degree + 1;
  result.coefficients[0] = first;
  T sum = zero<T>();
  for (std::size_t i = 0; i <= static_cast<std::size_t>(span.degree); ++i) {
    result.coefficients[i + 1] = (duration / static_cast<double>(i + 1)) * span.coefficients[i];
    sum = sum + result.coefficients[i + 1];
  }
  result.end = first + sum;
  return result;
}

// The area up to any time, where spans cannot hold it: because of degree 6 or a warp.
template <class T>
struct Area {
  Curve<T> curve;
  std::vector<CurvePiece<T>> pieces;
  std::vector<T> before;  // at the start of each piece

  Sample<T> operator()(double time, Side side) const noexcept {
    auto after = std::upper_bound(pieces.begin(), pieces.end(), time,
                                  [](double t, const CurvePiece<T>& piece) { return t < piece.from; });
    const std::size_t i = after == pieces.begin() ? 0 : static_cast<std::size_t>(after - pieces.begin()) - 1;
    const Sample<T> s = curve.sample(time, side);
    return {before[i] + piece_integral(pieces[i], pieces[i].position_at(time)), s.value, s.rate};
  }
};

// Where the curve repeats, the area repeats with an offset; where it holds, the area grows at the held value.
template <class T>
OutsideRule<T> outside_of_area(const Curve<T>& curve, bool early) noexcept {
  const OutsideRule<T>& rule = early ? curve.rule_before() : curve.rule_after();
  if (rule.rule == Outside::repeat) return {Outside::repeat_offset, {}, rule.plays};
  return {Outside::linear, early ? curve.value(curve.start(), Side::in) : curve.value(curve.end(), Side::out)};
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class T>
T integral(const Curve<T>& curve, double from, double to) {
  if (to < from) return -integral(curve, to, from);
  T sum = zero<T>();
  for (const questions::CurvePiece<T>& piece : questions::curve_pieces(curve, from, to))
    sum = sum + questions::piece_integral(piece, 1);
  return sum;
}

template <class T>
Curve<T> antiderivative(const Curve<T>& curve, const T& first) {
  spans::check_times(curve.start(), curve.end());
  if (curve.start() == curve.end()) {
    const T value = curve.value(curve.start());
    Span<T> span{};
    span.start = curve.start();
    span.degree = 1;
    span.coefficients[0] = first;
    span.coefficients[1] = value;
    span.end = first + value;
    return Curve<T>(std::span<const Span<T>>(&span, 1)).with_outside(Outside::linear, Outside::linear);
  }
  const OutsideRule<T> before = questions::outside_of_area(curve, true),
                       after = questions::outside_of_area(curve, false);
  std::vector<Span<T>> spans = curve.spans();
  const bool plain = !spans.empty() && std::all_of(spans.begin(), spans.end(), [](const Span<T>& span) {
    return (!span.warp.function || span.degree == 0) && span.degree < max_degree;
  });
  T sum = first;
  if (plain) {
    for (std::size_t i = 0; i < spans.size(); ++i) {
      spans[i] = questions::integrated(spans[i], curve.knots()[i + 1] - curve.knots()[i], sum);
      spans[i].warp = {};
      sum = spans[i].end;
    }
    return CurveAccess::from_spans<T>(spans, curve.end()).with_outside(before, after);
  }
  auto area = std::make_shared<questions::Area<T>>(
      questions::Area<T>{curve, questions::curve_pieces(curve, curve.start(), curve.end()), {}});
  for (const questions::CurvePiece<T>& piece : area->pieces) {
    area->before.push_back(sum);
    sum = sum + questions::piece_integral(piece, 1);
  }
  return CurveAccess::formula_with_knots<T>([area](double time, Side side) { return (*area)(time, side); },
                                            curve.start(), curve.end(), CurveAccess::breaks(curve))
      .with_outside(before, after);
}

#define TWEENFALL_INTEGRAL(T)                              \
  template T integral<T>(const Curve<T>&, double, double); \
  template Curve<T> antiderivative<T>(const Curve<T>&, const T&);
TWEENFALL_INTEGRAL(double)
TWEENFALL_INTEGRAL(Vec2)
TWEENFALL_INTEGRAL(Vec3)
TWEENFALL_INTEGRAL(Vec4)
#undef TWEENFALL_INTEGRAL

}  // namespace tweenfall
