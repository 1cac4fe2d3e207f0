#include <tweenfall/curves/editing.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/span_part.h"
#include "curve/spans_between.h"

namespace tweenfall::editing {
namespace {

template <class T, class Scale>
OutsideRule<T> with_slope(OutsideRule<T> rule, const Scale& scaled) {
  if (rule.slope) rule.slope = scaled(*rule.slope);
  return rule;
}

template <class T, class Scale>
spans::CurveEnd<T> with_slopes(spans::CurveEnd<T> end, const Scale& scaled) {
  end.rule = with_slope(end.rule, scaled);
  if (end.slope) end.slope = scaled(*end.slope);
  return end;
}

// Multiplies slopes by a factor.
template <class T>
auto times(double factor) {
  return [factor](const Rate<T>& slope) { return Rate<T>(factor * slope); };
}

// The curve with all its times moved: `later(t)` is the new time of the old t, `earlier` its inverse, both increasing.
template <class T, class Later, class Earlier>
Curve<T> retimed(const Curve<T>& curve, const Later& later, const Earlier& earlier, double factor) {
  spans::Breaks breaks = CurveAccess::breaks(curve);
  for (std::vector<double>* times : {&breaks.knots, &breaks.keys})
    for (double& time : *times) time = later(time);
  const std::vector<double>& knots = breaks.knots;
  std::vector<typename SpanOf<T>::type> spans = curve.spans();
  if (spans.empty())
    return CurveAccess::seen_through<T>(
        [curve, earlier, factor](double time, Side side) {
          Sample<T> s = curve.sample(earlier(time), side);
          s.rate = s.rate / factor;
          s.acceleration = s.acceleration / (factor * factor);
          return s;
        },
        later(curve.start()), later(curve.end()), breaks, with_slope(curve.rule_before(), times<T>(1 / factor)),
        with_slope(curve.rule_after(), times<T>(1 / factor)),
        [curve, later, earlier, factor](const OutsideRule<T>& before, const OutsideRule<T>& after) {
          return retimed(curve.with_outside(with_slope(before, times<T>(factor)), with_slope(after, times<T>(factor))),
                         later, earlier, factor);
        });
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (!(knots[i + 1] > knots[i]))
      throw std::invalid_argument("the knots at " + spans::text_of(curve.knots()[i]) + " s and " +
                                  spans::text_of(curve.knots()[i + 1]) + " s would fall on one time");
    spans[i].start = knots[i];
    spans[i].duration = knots[i + 1] - knots[i];
  }
  const auto& data = CurveAccess::data(curve);
  return CurveAccess::from_spans<T>(spans, knots.back(), with_slopes(data.before, times<T>(1 / factor)),
                                    with_slopes(data.after, times<T>(1 / factor)));
}

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
Curve<T> shifted(const Curve<T>& curve, double seconds) {
  spans::check_times(seconds, seconds);
  return editing::retimed(
      curve, [seconds](double t) { return t + seconds; }, [seconds](double t) { return t - seconds; }, 1);
}

template <class T>
Curve<T> time_scaled(const Curve<T>& curve, double factor, double pivot) {
  spans::check_times(factor, pivot);
  if (!(factor > 0))
    throw std::invalid_argument("time must be scaled by a factor > 0; it is " + spans::text_of(factor));
  return editing::retimed(
      curve, [factor, pivot](double t) { return pivot + factor * (t - pivot); },
      [factor, pivot](double t) { return pivot + (t - pivot) / factor; }, factor);
}

template <class T>
Curve<T> reversed(const Curve<T>& curve) {
  spans::check_times(curve.start(), curve.end());
  const double mirror = curve.start() + curve.end();
  spans::Breaks breaks = CurveAccess::breaks(curve);
  for (std::vector<double>* times : {&breaks.knots, &breaks.keys}) {
    std::reverse(times->begin(), times->end());
    for (double& time : *times) time = mirror - time;
    // The ends stay where they are, whatever the rounding.
    if (times->size() > 1) {
      times->front() = curve.start();
      times->back() = curve.end();
    }
  }
  const std::vector<double>& knots = breaks.knots;
  const std::vector<typename SpanOf<T>::type> spans = curve.spans();
  if (spans.empty())
    return CurveAccess::seen_through<T>(
        [curve, mirror](double time, Side side) {
          Sample<T> s = curve.sample(mirror - time, side == Side::in ? Side::out : Side::in);
          s.rate = -s.rate;
          return s;
        },
        curve.start(), curve.end(), breaks, editing::with_slope(curve.rule_after(), editing::times<T>(-1)),
        editing::with_slope(curve.rule_before(), editing::times<T>(-1)),
        [curve](const OutsideRule<T>& before, const OutsideRule<T>& after) {
          return reversed(curve.with_outside(editing::with_slope(after, editing::times<T>(-1)),
                                             editing::with_slope(before, editing::times<T>(-1))));
        });
  std::vector<typename SpanOf<T>::type> result;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    result.push_back(spans::span_part(spans[spans.size() - 1 - i], 1, 0, knots[i], knots[i + 1]));
    result.back().starts_at_key = i == 0 || spans[spans.size() - i].starts_at_key;
  }
  const auto& data = CurveAccess::data(curve);
  return CurveAccess::from_spans<T>(result, knots.back(), editing::with_slopes(data.after, editing::times<T>(-1)),
                                    editing::with_slopes(data.before, editing::times<T>(-1)));
}

template <class T>
Curve<T> value_scaled(const Curve<T>& curve, const T& factor, const T& offset) {
  const auto times_factor = [factor](const T& v) {
    T result = v;
    for (int i = 0; i < spans::dimensions<T>; ++i) spans::component_of(result, i) *= spans::component(factor, i);
    return result;
  };
  if (!spans::all_finite(factor) || !spans::all_finite(offset))
    throw std::invalid_argument("values must be scaled by finite numbers; these are " + spans::text_of(factor) +
                                " and " + spans::text_of(offset));
  std::vector<Span<T>> spans = curve.spans();
  if (spans.empty())
    return CurveAccess::converted<T>(curve, [times_factor, offset](const Curve<T>& whole, double time, Side side) {
      const Sample<T> s = whole.sample(time, side);
      return Sample<T>{times_factor(s.value) + offset, times_factor(s.rate), times_factor(s.acceleration)};
    });
  for (Span<T>& span : spans) {
    for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k)
      span.coefficients[k] = times_factor(span.coefficients[k]);
    span.coefficients[0] += offset;
    span.end = times_factor(span.end) + offset;
  }
  const auto scaled_end = [&](const spans::CurveEnd<T>& end) {
    spans::CurveEnd<T> result = editing::with_slopes(end, times_factor);
    if (result.value) result.value = times_factor(*result.value) + offset;
    return result;
  };
  const auto& data = CurveAccess::data(curve);
  return CurveAccess::from_spans<T>(spans, curve.end(), scaled_end(data.before), scaled_end(data.after));
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
