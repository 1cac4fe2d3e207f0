#include <tweenfall/curves/splines.h>

#include "curve/curve_data.h"
#include "curve/hermite_coefficients.h"
#include "splines/spline_check.h"

namespace tweenfall {

template <class T>
Curve<T> hermite_spline(std::span<const double> times, std::span<const T> values, std::span<const T> rates) {
  splines::check_spline_times(times);
  splines::check_spline_list(values, times.size(), "value");
  splines::check_spline_list(rates, times.size(), "rate");
  std::vector<Span<T>> spans(times.size() - 1);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    Span<T>& span = spans[i];
    span.start = times[i];
    span.duration = times[i + 1] - times[i];
    span.degree = 3;
    span.end = values[i + 1];
    const T change = values[i + 1] - values[i], d0 = span.duration * rates[i], d1 = span.duration * rates[i + 1];
    spans::cubic_coefficients(values[i], change, d0, d1, span.coefficients.data());
  }
  return CurveAccess::from_spans<T>(spans, times.back());
}

template <class T>
Curve<T> quintic_spline(std::span<const double> times, std::span<const T> values, std::span<const T> rates,
                        std::span<const T> accelerations) {
  splines::check_spline_times(times);
  splines::check_spline_list(values, times.size(), "value");
  splines::check_spline_list(rates, times.size(), "rate");
  splines::check_spline_list(accelerations, times.size(), "acceleration");
  std::vector<Span<T>> spans(times.size() - 1);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    Span<T>& span = spans[i];
    const double h = times[i + 1] - times[i];
    span.start = times[i];
    span.duration = h;
    span.degree = 5;
    span.end = values[i + 1];
    const T change = values[i + 1] - values[i], d0 = h * rates[i], d1 = h * rates[i + 1];
    const T e0 = (h * h) * accelerations[i], e1 = (h * h) * accelerations[i + 1];
    spans::quintic_coefficients(values[i], change, d0, d1, e0, e1, span.coefficients.data());
  }
  return CurveAccess::from_spans<T>(spans, times.back());
}

#define TWEENFALL_SPLINE(T)                                                                             \
  template Curve<T> hermite_spline<T>(std::span<const double>, std::span<const T>, std::span<const T>); \
  template Curve<T> quintic_spline<T>(std::span<const double>, std::span<const T>, std::span<const T>,  \
                                      std::span<const T>);
TWEENFALL_SPLINE(double)
TWEENFALL_SPLINE(Vec2)
TWEENFALL_SPLINE(Vec3)
TWEENFALL_SPLINE(Vec4)
#undef TWEENFALL_SPLINE

}  // namespace tweenfall
