#include <tweenfall/curves/splines.h>

#include <algorithm>

#include "curve/curve_data.h"
#include "splines/spline_check.h"

namespace tweenfall::splines {
namespace {

// From control values of the unit interval to power basis: the binomials times the forward differences.
template <class T>
void power_from_control(T* c, int degree) {
  for (int order = 1; order <= degree; ++order)
    for (int i = degree; i >= order; --i) c[i] = c[i] - c[i - 1];
  double binomial = 1;
  for (int i = 1; i <= degree; ++i) {
    binomial = binomial * (degree - i + 1) / i;
    c[i] = binomial * c[i];
  }
}

void check_count(std::size_t degree, std::size_t control) {
  if (control <= degree)
    refuse_spline("of degree " + std::to_string(degree) + " needs " + std::to_string(degree + 1) +
                  " control points or more; " + std::to_string(control) + " were given");
}

void check_degree(std::size_t degree) {
  if (degree < 1 || degree > static_cast<std::size_t>(max_degree))
    refuse_spline("has a degree from 1 to " + std::to_string(max_degree) + "; here it is " + std::to_string(degree));
}

// The blossom of the knot interval [knots[k], knots[k + 1]] at `at_start` times its start, then its end: a control
// value of the interval's own Bezier form. Source: Ramshaw, "Blossoms are polar forms", 1989; de Boor's recursion.
template <class T>
T blossom(int degree, std::span<const double> knots, const T* control, std::size_t k, int at_start) {
  const std::size_t p = static_cast<std::size_t>(degree);
  std::array<T, max_degree + 1> d;
  for (std::size_t j = 0; j <= p; ++j) d[j] = control[k - p + j];
  for (std::size_t r = 1; r <= p; ++r) {
    const double u = static_cast<int>(r) <= at_start ? knots[k] : knots[k + 1];
    for (std::size_t j = p; j >= r; --j) {
      const double low = knots[k - p + j], high = knots[k + 1 + j - r];
      const double share = (u - low) / (high - low);
      d[j] = (1 - share) * d[j - 1] + share * d[j];
    }
  }
  return d[p];
}

}  // namespace
}  // namespace tweenfall::splines

namespace tweenfall {

template <class T>
Curve<T> bezier_spline(std::span<const double> times, std::span<const T> control) {
  splines::check_spline_times(times);
  const std::size_t segments = times.size() - 1, each = control.size() / segments;
  splines::check_spline_list(control, each * segments, "control value");
  splines::check_degree(each == 0 ? 0 : each - 1);
  std::vector<Span<T>> spans(segments);
  for (std::size_t i = 0; i < segments; ++i) {
    Span<T>& span = spans[i];
    span.start = times[i];
    span.duration = times[i + 1] - times[i];
    span.degree = static_cast<int>(each) - 1;
    for (std::size_t k = 0; k < each; ++k) span.coefficients[k] = control[i * each + k];
    span.end = control[(i + 1) * each - 1];
    splines::power_from_control(span.coefficients.data(), span.degree);
  }
  return CurveAccess::from_spans<T>(spans, times.back());
}

template <class T>
Curve<T> b_spline(int degree, std::span<const double> knots, std::span<const T> control) {
  splines::check_degree(degree < 0 ? 0 : static_cast<std::size_t>(degree));
  const std::size_t p = static_cast<std::size_t>(degree), n = control.size();
  splines::check_count(p, n);
  splines::check_spline_list(control, n, "control point");
  splines::check_spline_list(knots, n + p + 1, "knot");
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i] < knots[i - 1])
      splines::refuse_spline("needs knots that do not decrease; number " + std::to_string(i) + ", " +
                             spans::text_of(knots[i]) + ", lies before " + spans::text_of(knots[i - 1]));
    if (i > p && knots[i] == knots[i - p - 1])
      splines::refuse_spline("of degree " + std::to_string(degree) + " can have a knot " + std::to_string(p + 1) +
                             " times at most; " + spans::text_of(knots[i]) + " occurs more often");
  }
  if (!(knots[n] > knots[p]))
    splines::refuse_spline("needs knot number " + std::to_string(n) + ", " + spans::text_of(knots[n]) +
                           ", to lie after number " + std::to_string(p) + ", " + spans::text_of(knots[p]));
  std::vector<Span<T>> spans;
  for (std::size_t k = p; k < n; ++k) {
    if (!(knots[k + 1] > knots[k])) continue;
    Span<T> span{};
    span.start = knots[k];
    span.duration = knots[k + 1] - knots[k];
    span.degree = degree;
    for (int j = 0; j <= degree; ++j)
      span.coefficients[static_cast<std::size_t>(j)] = splines::blossom(degree, knots, control.data(), k, degree - j);
    span.end = span.coefficients[p];
    splines::power_from_control(span.coefficients.data(), degree);
    spans.push_back(span);
  }
  return CurveAccess::from_spans<T>(spans, knots[n]);
}

std::vector<double> clamped_knots(int degree, std::size_t control, double start, double end) {
  splines::check_degree(degree < 0 ? 0 : static_cast<std::size_t>(degree));
  const std::size_t p = static_cast<std::size_t>(degree);
  splines::check_count(p, control);
  splines::check_spline_times(std::array{start, end});
  std::vector<double> knots(control + p + 1, start);
  const std::size_t stretches = control - p;
  for (std::size_t i = 1; i < stretches; ++i)
    knots[p + i] = start + static_cast<double>(i) / static_cast<double>(stretches) * (end - start);
  std::fill(knots.begin() + static_cast<std::ptrdiff_t>(control), knots.end(), end);
  return knots;
}

#define TWEENFALL_SPLINE(T)                                                        \
  template Curve<T> bezier_spline<T>(std::span<const double>, std::span<const T>); \
  template Curve<T> b_spline<T>(int, std::span<const double>, std::span<const T>);
TWEENFALL_SPLINE(double)
TWEENFALL_SPLINE(Vec2)
TWEENFALL_SPLINE(Vec3)
TWEENFALL_SPLINE(Vec4)
#undef TWEENFALL_SPLINE

}  // namespace tweenfall
