#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/inspection.h>

#include <algorithm>
#include <cmath>

#include "curve/spans_between.h"
#include "curve/time_bezier.h"
#include "math/polynomial.h"
#include "math/polynomial_roots.h"
#include "questions/curve_pieces.h"
#include "questions/piece_difference.h"
#include "splines/control_points.h"

namespace tweenfall::questions {
namespace {

template <class T>
auto vector_of(const T& value) noexcept {
  if constexpr (std::is_same_v<T, Color>)
    return value.rgba;
  else
    return value;
}

// Whether third and higher derivatives are known in all spans.
template <class T>
bool knows_all_derivatives(const Curve<T>& curve) {
  const auto& d = CurveAccess::data(curve);
  for (std::size_t i = 0; i < d.warps.size(); ++i)
    if (d.warps[i].function && d.segment(i).degree > 0 && !spans::is_time_bezier(d.warps[i])) return false;
  return d.times != nullptr;
}

// Whether the curve stays near the straight line between two values.
template <class T, class V>
bool near_line(const Curve<T>& curve, const V& first, const V& last, double tolerance) {
  CurvePiece<V> line;
  line.from = curve.start();
  line.to = curve.end();
  line.degree = 1;
  line.c[0] = first;
  line.c[1] = last - first;
  for (const PieceDifference<V>& d :
       piece_differences<V>(curve_pieces(curve, curve.start(), curve.end()), std::vector<CurvePiece<V>>{line})) {
    std::vector<V> points = d.c;
    splines::make_control_points(points);
    if (!splines::stays_within(points, tolerance + d.rounding)) return false;
  }
  return true;
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class T>
std::vector<Continuity> continuity(const Curve<T>& curve, double tolerance) {
  std::vector<Continuity> result;
  const std::span<const double> knots = curve.knots();
  const bool all_known = questions::knows_all_derivatives(curve);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double t = knots[i];
    const Sample<T> in = curve.sample(t, Side::in), out = curve.sample(t, Side::out);
    const double nearest = std::min(i > 0 ? t - knots[i - 1] : curve.duration(),
                                    i + 1 < knots.size() ? knots[i + 1] - t : curve.duration());
    // The error of a derivative that comes from rounding of the values.
    double rounding = 1e-14 * (splines::length_of(questions::vector_of(in.value)) +
                               splines::length_of(questions::vector_of(out.value)));
    const auto same = [&](const auto& a, const auto& b) {
      return splines::length_of(std::decay_t<decltype(a)>(a - b)) <=
             tolerance * std::max(splines::length_of(a), splines::length_of(b)) + rounding;
    };
    int known = -1;
    if (same(questions::vector_of(in.value), questions::vector_of(out.value))) {
      known = 0;
      rounding /= nearest;
      if (same(in.rate, out.rate)) {
        known = 1;
        rounding /= nearest;
        if (same(in.acceleration, out.acceleration)) known = 2;
      }
    }
    if constexpr (!std::is_same_v<T, Color>) {
      bool smooth = known == 2 && all_known;
      for (int order = 3; smooth && order <= max_degree; ++order) {
        rounding /= nearest;
        smooth = same(derivative_at(curve, order, t, Side::in), derivative_at(curve, order, t, Side::out));
      }
      if (smooth) known = 3;
    }
    result.push_back(static_cast<Continuity>(known));
  }
  return result;
}

template <class T>
bool is_flat(const Curve<T>& curve, double tolerance) {
  if (curve.start() == curve.end()) return true;
  const auto first = questions::vector_of(curve.value(curve.start()));
  return questions::near_line(curve, first, first, tolerance);
}

template <class T>
bool is_linear(const Curve<T>& curve, double tolerance) {
  if (curve.start() == curve.end()) return true;
  return questions::near_line(curve, questions::vector_of(curve.value(curve.start())),
                              questions::vector_of(curve.value(curve.end(), Side::in)), tolerance);
}

bool is_monotone(const Curve<double>& curve) {
  if (curve.start() == curve.end()) return true;
  bool rises = false, falls = false;
  double before = curve.value(curve.start());
  const auto step = [&](double value, double rounding) {
    if (value > before + rounding) rises = true;
    if (value < before - rounding) falls = true;
    before = value;
  };
  for (const questions::CurvePiece<double>& piece : questions::curve_pieces(curve, curve.start(), curve.end())) {
    const double rounding = piece.rounding();
    step(curve.value(piece.from), rounding);
    for (const double s :
         math::polynomial_roots(math::polynomial_derivative(questions::component_polynomial(piece, 0)), 0, 1))
      step(math::polynomial_at(piece.c.data(), piece.degree, s), rounding);
    step(curve.value(piece.to, Side::in), rounding);
  }
  return !(rises && falls);
}

template <class T>
std::vector<std::size_t> redundant_knots(const Curve<T>& curve, double tolerance) {
  using V = typename spans::Stored<T>::type;
  std::vector<std::size_t> result;
  const std::vector<Span<T>> spans = curve.spans();
  std::size_t kept = 0;  // the span that is continued
  for (std::size_t i = 1; i < spans.size(); ++i) {
    const Span<T>&a = spans[kept], &b = spans[i];
    bool same = false;
    if (a.degree > 0 && a.warp.function) {
      const double u = (b.start - a.start) / a.duration, width = b.duration / a.duration;
      same = a.warp.function == b.warp.function && a.warp.parameters == b.warp.parameters && a.degree == b.degree &&
             std::abs(a.warp.from + a.warp.width * u - b.warp.from) <= 1e-14 &&
             std::abs(a.warp.width * width - b.warp.width) <= 1e-14;
      for (std::size_t k = 0; same && k <= static_cast<std::size_t>(a.degree); ++k)
        same = splines::length_of(
                   V(questions::vector_of(a.coefficients[k]) - questions::vector_of(b.coefficients[k]))) <= tolerance;
    } else if (b.degree == 0 || !b.warp.function) {
      questions::CurvePiece<V> first, second;
      first.from = a.start;
      first.to = a.start + a.duration;
      first.degree = a.degree;
      second.from = b.start;
      second.to = b.start + b.duration;
      second.degree = b.degree;
      double size = 0;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(a.degree); ++k)
        first.c[k] = questions::vector_of(a.coefficients[k]);
      for (std::size_t k = 0; k <= static_cast<std::size_t>(b.degree); ++k) {
        second.c[k] = questions::vector_of(b.coefficients[k]);
        size += splines::length_of(second.c[k]);
      }
      std::vector<V> points = questions::composed(first, second);
      points.resize(std::max(points.size(), static_cast<std::size_t>(b.degree) + 1), zero<V>());
      for (const V& c : points) size += splines::length_of(c);
      for (std::size_t k = 0; k <= static_cast<std::size_t>(b.degree); ++k) points[k] = points[k] - second.c[k];
      splines::make_control_points(points);
      same = splines::stays_within(points, tolerance + 1e-14 * size);
    }
    if (same)
      result.push_back(i);
    else
      kept = i;
  }
  return result;
}

#define TWEENFALL_INSPECTION(T)                                            \
  template std::vector<Continuity> continuity<T>(const Curve<T>&, double); \
  template bool is_flat<T>(const Curve<T>&, double);                       \
  template bool is_linear<T>(const Curve<T>&, double);                     \
  template std::vector<std::size_t> redundant_knots<T>(const Curve<T>&, double);
TWEENFALL_INSPECTION(double)
TWEENFALL_INSPECTION(Vec2)
TWEENFALL_INSPECTION(Vec3)
TWEENFALL_INSPECTION(Vec4)
TWEENFALL_INSPECTION(Color)
#undef TWEENFALL_INSPECTION

}  // namespace tweenfall
