#include "editing/fit_target.h"
#include "curve/hermite_coefficients.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/spans_between.h"
#include "keys/span_slopes.h"
#include "questions/piece_difference.h"
#include "questions/stretch_bound.h"
#include "splines/control_points.h"

namespace tweenfall::editing {
namespace {

template <class T>
inline constexpr bool is_vector = !std::is_same_v<T, Color> && !std::is_same_v<T, Quat>;

template <class T>
bool bitwise_same(const T& a, const T& b) noexcept {
  for (int i = 0; i < spans::dimensions<T>; ++i)
    if (spans::component(a, i) != spans::component(b, i)) return false;
  return true;
}

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
editing::FitTarget<T>::FitTarget(const Curve<T>& curve, double error, const FitOptions& options)
    : curve_(curve), error_(error), options_(options), plain_(editing::is_vector<T> && !options.keys.logarithmic) {
  if (!(error > 0) || !std::isfinite(error))
    throw std::invalid_argument("keys are fitted within an error > 0; it is " + spans::text_of(error));
  spans::check_times(curve.start(), curve.end());
  if constexpr (editing::is_vector<T>) {
    if (plain_) {
      pieces_ = questions::curve_pieces(curve, curve.start(), curve.end());
      for (const auto& piece : pieces_) {
        boundaries_.push_back(piece.from);
        least_error_ = std::max(least_error_, 10 * piece.rounding());
      }
      boundaries_.push_back(curve.end());
    }
  }
  if (!plain_) {
    boundaries_ = spans::seams_between(curve, curve.start(), curve.end());
    least_error_ = 1e-11;
  }
  if (error < least_error_)
    throw std::invalid_argument("an error of " + spans::text_of(error) + " is less than rounding, " +
                                spans::text_of(least_error_) + ", for values of this size");
}

// Slopes that make the sum of squared distances at evenly spaced times the least.
template <class T>
void editing::FitTarget<T>::choose_slopes(Rate<T>& leaving, Rate<T>& arriving, double from, double to,
                                          bool leaving_given) const {
  if constexpr (editing::is_vector<T>) {
    constexpr int count = 32;
    const double h = to - from;
    const T first = curve_.value(from), last = curve_.value(to, Side::in);
    double aa = 0, ab = 0, bb = 0;
    T ra = zero<T>(), rb = zero<T>();
    for (int i = 1; i < count; ++i) {
      const double u = static_cast<double>(i) / count, v = 1 - u;
      const double a = h * u * v * v, b = -h * u * u * v;
      T rest = curve_.value(from + u * h);
      rest = rest - ((1 + 2 * u) * v * v) * first - (u * u * (3 - 2 * u)) * last;
      aa += a * a;
      ab += a * b;
      bb += b * b;
      ra = ra + a * rest;
      rb = rb + b * rest;
    }
    if (leaving_given) {
      arriving = (rb - ab * leaving) / bb;
      return;
    }
    const double determinant = aa * bb - ab * ab;
    leaving = (bb * ra - ab * rb) / determinant;
    arriving = (aa * rb - ab * ra) / determinant;
  } else {
    (void)leaving, (void)arriving, (void)from, (void)to, (void)leaving_given;
  }
}

template <class T>
editing::FittedSpan<T> editing::FitTarget<T>::span(double from, double to, Kind kind, const Rate<T>* leaving) const {
  const Sample<T> a = curve_.sample(from, Side::out), b = curve_.sample(to, Side::in);
  const bool last = to == curve_.end();
  const T after = last && curve_.after() != Outside::hold ? b.value : curve_.value(to, Side::out);
  editing::FittedSpan<T> result{{from, a.value}, {to, after}};
  if (!editing::bitwise_same(after, b.value)) result.to.value_in = b.value;
  if (kind == Kind::linear) {
    result.from.ease = Ease::linear();
    return result;
  }
  Rate<T> out = a.rate, in = b.rate;
  if (kind == Kind::suited) {
    if (leaving) out = *leaving;
    choose_slopes(out, in, from, to, leaving != nullptr);
  }
  result.from.out = Tangent<T>{Tangent<T>::Kind::given, out};
  result.to.in = Tangent<T>{Tangent<T>::Kind::given, in};
  return result;
}

template <class T>
bool editing::FitTarget<T>::is_near(const editing::FittedSpan<T>& span, double error) const {
  const double from = span.from.time, to = span.to.time;
  if constexpr (editing::is_vector<T>) {
    if (plain_) {
      questions::CurvePiece<T> candidate;
      candidate.from = from;
      candidate.to = to;
      const T end = span.to.value_in ? *span.to.value_in : span.to.value;
      const T change = end - span.from.value;
      if (span.from.out) {
        const double h = to - from;
        candidate.degree = 3;
        const T d0 = h * span.from.out->rate, d1 = h * span.to.in->rate;
        spans::cubic_coefficients(span.from.value, change, d0, d1, candidate.c.data());
      } else {
        candidate.degree = 1;
        candidate.c[0] = span.from.value;
        candidate.c[1] = change;
      }
      auto piece = std::partition_point(pieces_.begin(), pieces_.end(),
                                        [from](const questions::CurvePiece<T>& p) { return p.to <= from; });
      for (; piece != pieces_.end() && piece->from < to; ++piece) {
        const questions::CurvePiece<T> part =
            questions::piece_part(*piece, std::max(from, piece->from), std::min(to, piece->to));
        std::vector<T> points = questions::composed(candidate, part);
        points.resize(std::max(points.size(), static_cast<std::size_t>(part.degree) + 1), zero<T>());
        for (std::size_t i = 0; i <= static_cast<std::size_t>(part.degree); ++i) points[i] = points[i] - part.c[i];
        splines::make_control_points(points);
        if (!splines::stays_within(points, std::max(error - 0.5 * least_error_, 0.5 * least_error_))) return false;
      }
      return true;
    }
  }
  const Key<T> keys[2] = {span.from, span.to};
  const Curve<T> candidate = keyed_curve<T>(std::span<const Key<T>>(keys, 2), options_.keys);
  const auto first = std::upper_bound(boundaries_.begin(), boundaries_.end(), from);
  double start = from;
  for (auto knot = first; start < to; ++knot) {
    const double stop = knot == boundaries_.end() ? to : std::min(*knot, to);
    if (!questions::stays_near(curve_, candidate, start, stop, error)) return false;
    start = stop;
  }
  return true;
}

template class editing::FitTarget<double>;
template class editing::FitTarget<Vec2>;
template class editing::FitTarget<Vec3>;
template class editing::FitTarget<Vec4>;
template class editing::FitTarget<Color>;
template class editing::FitTarget<Quat>;

}  // namespace tweenfall
