#include "questions/curve_pieces.h"

#include <algorithm>
#include <cmath>

#include "curve/hermite_coefficients.h"
#include "curve/span_part.h"
#include "curve/spans_between.h"
#include "curve/time_bezier.h"
#include "math/polynomial.h"

namespace tweenfall::questions {
namespace {

template <class T>
auto stored(const T& value) noexcept {
  if constexpr (std::is_same_v<T, Color>)
    return value.rgba;
  else
    return value;
}

// A smooth function between two times, as quintics. `sampler(time, side)` gives value, rate and acceleration.
template <class V, class Sampler>
class Quintics {
 public:
  Quintics(std::vector<CurvePiece<V>>& result, const Sampler& sampler, double from, double to)
      : result_(result), sampler_(sampler) {
    double scale = 0;
    // Not evenly spaced, so that an oscillation is not sampled at its zeros only.
    for (int i = 0; i <= first_parts; ++i)
      for (const double off : {0.0, 0.37}) {
        const V v = sampler(std::min(mark(from, to, i) + off / first_parts * (to - from), to), Side::in).value;
        for (int k = 0; k < spans::dimensions<V>; ++k) scale = std::max(scale, std::abs(spans::component(v, k)));
      }
    // A time, and a position in a span, is exact to its last bit only, which matters where the curve is steep.
    time_rounding_ = 1e-15 * std::max({std::abs(from), std::abs(to), to - from});
    for (int i = 0; i < first_parts; ++i) {
      const double a = mark(from, to, i), b = mark(from, to, i + 1);
      if (!(b > a)) continue;
      const std::size_t before = result.size();
      // A function too rough for that many parts is approximated less exactly.
      for (tolerance_ = 1e-12 * scale;; tolerance_ *= 100) {
        budget_ = most_parts;
        add(a, sampler(a, Side::out), b, sampler(b, Side::in), 0);
        if (budget_ > 0 || !(tolerance_ < 1e-4 * scale)) break;
        result.resize(before);
      }
    }
  }

 private:
  static constexpr int first_parts = 8, deepest = 44, most_parts = 2000;

  static double mark(double from, double to, int i) noexcept {
    return i == 0 ? from : i == first_parts ? to : from + (to - from) * i / first_parts;
  }

  CurvePiece<V> quintic(double from, const Sample<V>& a, double to, const Sample<V>& b) const noexcept {
    const double h = to - from;
    const V change = b.value - a.value, d0 = h * a.rate, d1 = h * b.rate;
    const V e0 = (h * h) * a.acceleration, e1 = (h * h) * b.acceleration;
    CurvePiece<V> piece;
    piece.from = from;
    piece.to = to;
    piece.error = tolerance_;
    piece.degree = 5;
    spans::quintic_coefficients(a.value, change, d0, d1, e0, e1, piece.c.data());
    return piece;
  }

  bool agrees(const CurvePiece<V>& piece) const noexcept {
    for (const double s : {0.5, 0.25, 0.75, 0.1, 0.9}) {
      const V ours = math::polynomial_at(piece.c.data(), 5, s);
      const Sample<V> theirs = sampler_(piece.time_at(s), Side::out);
      for (int i = 0; i < spans::dimensions<V>; ++i)
        if (!(std::abs(spans::component(ours, i) - spans::component(theirs.value, i)) <=
              tolerance_ + time_rounding_ * std::abs(spans::component(theirs.rate, i))))
          return false;
    }
    return true;
  }

  void add(double from, const Sample<V>& a, double to, const Sample<V>& b, int depth) {
    CurvePiece<V> piece = quintic(from, a, to, b);
    const double middle = from + 0.5 * (to - from);
    if (agrees(piece)) {
      result_.push_back(piece);
    } else if (depth == deepest || budget_ <= 0 || !(middle > from && middle < to)) {
      // A jump or an infinite rate between neighboring times: nothing beyond the two values is known.
      piece.degree = 1;
      piece.c[1] = b.value - a.value;
      result_.push_back(piece);
    } else {
      --budget_;
      add(from, a, middle, sampler_(middle, Side::in), depth + 1);
      add(middle, sampler_(middle, Side::out), to, b, depth + 1);
    }
  }

  std::vector<CurvePiece<V>>& result_;
  const Sampler& sampler_;
  double tolerance_ = 0, time_rounding_ = 0;
  int budget_ = 0;
};

template <class V, class Sampler>
void add_quintics(std::vector<CurvePiece<V>>& result, const Sampler& sampler, double from, double to) {
  Quintics<V, Sampler>(result, sampler, from, to);
}

template <class T, class V>
void add_span(std::vector<CurvePiece<V>>& result, const Span<T>& span, double to) {
  CurvePiece<V> piece;
  piece.from = span.start;
  piece.to = to;
  piece.degree = span.degree;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(span.degree); ++i) piece.c[i] = stored(span.coefficients[i]);
  if (span.degree == 0 || !span.warp.function) {
    result.push_back(piece);
  } else if (spans::is_time_bezier(span.warp)) {
    piece.timed = true;
    piece.x = spans::shown_time_cubic(span.warp, piece.c.data(), piece.degree);
    result.push_back(piece);
  } else {
    const double inverse = 1 / (to - span.start);
    const auto sampler = [&](double time, Side) {
      const double u = time >= to ? 1 : (time - span.start) * inverse;
      const Warp::Result w = span.warp.at(u);
      const math::Polynomial<V> p = math::evaluate_polynomial(piece.c.data(), piece.degree, w.s);
      const V second = p.second * (w.ds * w.ds) + p.first * w.dds;
      return Sample<V>{p.value, p.first * (w.ds * inverse), second * (inverse * inverse)};
    };
    add_quintics(result, sampler, span.start, to);
  }
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class V>
double questions::CurvePiece<V>::position_at(double time) const noexcept {
  if (time <= from) return 0;
  if (time >= to) return 1;
  const double u = (time - from) / (to - from);
  if (!timed) return u;
  double low = 0, high = 1, s = u;
  for (int i = 0; i < 200; ++i) {
    const double miss = ((x[3] * s + x[2]) * s + x[1]) * s - u;
    if (miss == 0) break;
    (miss < 0 ? low : high) = s;
    double next = s - miss / ((3 * x[3] * s + 2 * x[2]) * s + x[1]);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == s || next == low || next == high) break;
    s = next;
  }
  return s;
}

template <class T>
std::vector<questions::CurvePiece<typename spans::Stored<T>::type>> questions::curve_pieces(const Curve<T>& curve,
                                                                                            double from, double to) {
  using V = typename spans::Stored<T>::type;
  spans::check_times(from, to);
  std::vector<questions::CurvePiece<V>> result;
  if (!(to > from)) return result;
  if (spans::has_spans(curve)) {
    const std::vector<Span<T>> spans = spans::spans_between(curve, from, to);
    for (std::size_t i = 0; i < spans.size(); ++i)
      questions::add_span(result, spans[i], i + 1 < spans.size() ? spans[i + 1].start : to);
    return result;
  }
  const std::vector<double> marks = spans::seams_between(curve, from, to);
  const auto sampler = [&](double time, Side side) {
    const Sample<T> s = curve.sample(time, side);
    return Sample<V>{questions::stored(s.value), s.rate, s.acceleration};
  };
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) questions::add_quintics(result, sampler, marks[i], marks[i + 1]);
  return result;
}

template <class V>
std::vector<questions::CurvePiece<V>> questions::as_quintics(const questions::CurvePiece<V>& piece) {
  const double inverse = 1 / (piece.to - piece.from);
  const auto sampler = [&](double time, Side) {
    const double s = piece.position_at(time);
    // The least slope as in time_bezier.h.
    const double slope = std::max((3 * piece.x[3] * s + 2 * piece.x[2]) * s + piece.x[1], 1e-6);
    const double ds = 1 / slope, dds = slope > 1e-6 ? -(6 * piece.x[3] * s + 2 * piece.x[2]) * ds * ds * ds : 0;
    const math::Polynomial<V> p = math::evaluate_polynomial(piece.c.data(), piece.degree, s);
    const V second = p.second * (ds * ds) + p.first * dds;
    return Sample<V>{p.value, p.first * (ds * inverse), second * (inverse * inverse)};
  };
  std::vector<questions::CurvePiece<V>> result;
  questions::add_quintics(result, sampler, piece.from, piece.to);
  return result;
}

#define TWEENFALL_PIECES(T)                                                                                       \
  template std::vector<questions::CurvePiece<spans::Stored<T>::type>> questions::curve_pieces<T>(const Curve<T>&, \
                                                                                                 double, double);
TWEENFALL_PIECES(double)
TWEENFALL_PIECES(Vec2)
TWEENFALL_PIECES(Vec3)
TWEENFALL_PIECES(Vec4)
TWEENFALL_PIECES(Color)
#undef TWEENFALL_PIECES
template struct questions::CurvePiece<double>;
template std::vector<questions::CurvePiece<double>> questions::as_quintics<double>(
    const questions::CurvePiece<double>&);
template struct questions::CurvePiece<Vec2>;
template std::vector<questions::CurvePiece<Vec2>> questions::as_quintics<Vec2>(const questions::CurvePiece<Vec2>&);
template struct questions::CurvePiece<Vec3>;
template std::vector<questions::CurvePiece<Vec3>> questions::as_quintics<Vec3>(const questions::CurvePiece<Vec3>&);
template struct questions::CurvePiece<Vec4>;
template std::vector<questions::CurvePiece<Vec4>> questions::as_quintics<Vec4>(const questions::CurvePiece<Vec4>&);

}  // namespace tweenfall
