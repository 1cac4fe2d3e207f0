#include <tweenfall/curves/editing.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve_data.h"
#include "span_part.h"
#include "spans_between.h"

namespace tweenfall {
namespace {

// Another time for everything: `later(t)` is the new time of the old t, `earlier` its inverse, both rising.
template <class T, class Later, class Earlier>
Curve<T> retimed(const Curve<T>& curve, const Later& later, const Earlier& earlier, double factor) {
  std::vector<double> knots;
  for (const double knot : curve.knots()) knots.push_back(later(knot));
  std::vector<typename SpanOf<T>::type> spans = curve.spans();
  if (spans.empty())
    return CurveAccess::seen_through<T>(
        [curve, earlier, factor](double time, Side side) {
          Sample<T> s = curve.sample(earlier(time), side);
          s.rate = s.rate / factor;
          s.acceleration = s.acceleration / (factor * factor);
          return s;
        },
        later(curve.start()), later(curve.end()), knots, curve.before(), curve.after(),
        [curve, later, earlier, factor](Outside before, Outside after) {
          return retimed(curve.with_outside(before, after), later, earlier, factor);
        });
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (!(knots[i + 1] > knots[i]))
      throw std::invalid_argument("the knots at " + text_of(curve.knots()[i]) + " s and " +
                                  text_of(curve.knots()[i + 1]) + " s would fall on one time");
    spans[i].start = knots[i];
    spans[i].duration = knots[i + 1] - knots[i];
  }
  const T final = curve.value(curve.end(), Side::out);
  const bool holds = curve.after() == Outside::hold;
  return CurveAccess::from_spans<T>(spans, knots.back(), holds ? &final : nullptr)
      .with_outside(curve.before(), curve.after());
}

}  // namespace

template <class T>
Curve<T> shifted(const Curve<T>& curve, double seconds) {
  check_times(seconds, seconds);
  return retimed(
      curve, [seconds](double t) { return t + seconds; }, [seconds](double t) { return t - seconds; }, 1);
}

template <class T>
Curve<T> time_scaled(const Curve<T>& curve, double factor, double pivot) {
  check_times(factor, pivot);
  if (!(factor > 0)) throw std::invalid_argument("time must be scaled by a factor > 0; it is " + text_of(factor));
  return retimed(
      curve, [factor, pivot](double t) { return pivot + factor * (t - pivot); },
      [factor, pivot](double t) { return pivot + (t - pivot) / factor; }, factor);
}

template <class T>
Curve<T> reversed(const Curve<T>& curve) {
  check_times(curve.start(), curve.end());
  const double mirror = curve.start() + curve.end();
  std::vector<double> knots;
  for (auto knot = curve.knots().rbegin(); knot != curve.knots().rend(); ++knot) knots.push_back(mirror - *knot);
  // The ends stay where they are, whatever the rounding.
  if (knots.size() > 1) {
    knots.front() = curve.start();
    knots.back() = curve.end();
  }
  const std::vector<typename SpanOf<T>::type> spans = curve.spans();
  if (spans.empty())
    return CurveAccess::seen_through<T>(
        [curve, mirror](double time, Side side) {
          Sample<T> s = curve.sample(mirror - time, side == Side::in ? Side::out : Side::in);
          s.rate = -s.rate;
          return s;
        },
        curve.start(), curve.end(), knots, curve.after(), curve.before(),
        [curve](Outside before, Outside after) { return reversed(curve.with_outside(after, before)); });
  std::vector<typename SpanOf<T>::type> result;
  for (std::size_t i = 0; i < spans.size(); ++i)
    result.push_back(span_part(spans[spans.size() - 1 - i], 1, 0, knots[i], knots[i + 1]));
  return CurveAccess::from_spans<T>(result, knots.back()).with_outside(curve.after(), curve.before());
}

template <class T>
Curve<T> value_scaled(const Curve<T>& curve, const T& factor, const T& offset) {
  const auto times_factor = [factor](const T& v) {
    T result = v;
    for (int i = 0; i < dimensions<T>; ++i) component_of(result, i) *= component(factor, i);
    return result;
  };
  if (!all_finite(factor) || !all_finite(offset))
    throw std::invalid_argument("values must be scaled by finite numbers; these are " + text_of(factor) + " and " +
                                text_of(offset));
  std::vector<Span<T>> spans = curve.spans();
  if (spans.empty())
    return CurveAccess::seen_through<T>(
        [curve, times_factor, offset](double time, Side side) {
          const Sample<T> s = curve.sample(time, side);
          return Sample<T>{times_factor(s.value) + offset, times_factor(s.rate), times_factor(s.acceleration)};
        },
        curve.start(), curve.end(), curve.knots(), curve.before(), curve.after(),
        [curve, factor, offset](Outside before, Outside after) {
          return value_scaled(curve.with_outside(before, after), factor, offset);
        });
  for (Span<T>& span : spans) {
    for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k)
      span.coefficients[k] = times_factor(span.coefficients[k]);
    span.coefficients[0] += offset;
    span.end = times_factor(span.end) + offset;
  }
  const T final = times_factor(curve.value(curve.end(), Side::out)) + offset;
  const bool holds = curve.after() == Outside::hold;
  return CurveAccess::from_spans<T>(spans, curve.end(), holds ? &final : nullptr)
      .with_outside(curve.before(), curve.after());
}

#define TWEENFALL_EDITING_TIME(T)                                    \
  template Curve<T> shifted<T>(const Curve<T>&, double);             \
  template Curve<T> time_scaled<T>(const Curve<T>&, double, double); \
  template Curve<T> reversed<T>(const Curve<T>&);
TWEENFALL_EDITING_TIME(double)
TWEENFALL_EDITING_TIME(Vec2)
TWEENFALL_EDITING_TIME(Vec3)
TWEENFALL_EDITING_TIME(Vec4)
TWEENFALL_EDITING_TIME(Color)
TWEENFALL_EDITING_TIME(Quat)
#undef TWEENFALL_EDITING_TIME
template Curve<double> value_scaled<double>(const Curve<double>&, const double&, const double&);
template Curve<Vec2> value_scaled<Vec2>(const Curve<Vec2>&, const Vec2&, const Vec2&);
template Curve<Vec3> value_scaled<Vec3>(const Curve<Vec3>&, const Vec3&, const Vec3&);
template Curve<Vec4> value_scaled<Vec4>(const Curve<Vec4>&, const Vec4&, const Vec4&);

}  // namespace tweenfall
