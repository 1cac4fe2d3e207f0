#include <tweenfall/curves/calculus.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/extrapolation.h"
#include "curve/spans_between.h"
#include "curve/time_bezier.h"
#include "math/polynomial.h"

namespace tweenfall::questions {
namespace {

constexpr int highest_order = 8;

// A polynomial of any degree that the recursion below needs.
struct LongPolynomial {
  int degree = 0;
  std::array<double, 24> c{};

  [[nodiscard]] double at(double s) const noexcept {
    double value = 0;
    for (int i = degree; i >= 0; --i) value = value * s + c[static_cast<std::size_t>(i)];
    return value;
  }
  [[nodiscard]] LongPolynomial derived() const noexcept {
    LongPolynomial result;
    result.degree = std::max(0, degree - 1);
    for (int i = 1; i <= degree; ++i) result.c[static_cast<std::size_t>(i - 1)] = i * c[static_cast<std::size_t>(i)];
    return result;
  }
};

LongPolynomial product(const LongPolynomial& a, const LongPolynomial& b) noexcept {
  LongPolynomial result;
  result.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i)
    for (int k = 0; k <= b.degree; ++k)
      result.c[static_cast<std::size_t>(i + k)] += a.c[static_cast<std::size_t>(i)] * b.c[static_cast<std::size_t>(k)];
  return result;
}

// d^n y / du^n where u = x(s): with y^(n) = N_n / x'^(2n - 1), N_1 = y' and N_(n+1) = N_n' x' - (2n - 1) N_n x''.
double through_handles(const LongPolynomial& y, const LongPolynomial& x, double s, int order) noexcept {
  const LongPolynomial first = x.derived(), second = first.derived();
  LongPolynomial n = y.derived();
  for (int k = 1; k < order; ++k) {
    const LongPolynomial a = product(n.derived(), first);
    LongPolynomial b = product(n, second);
    b.degree = std::max(a.degree, b.degree);
    for (std::size_t i = 0; i < b.c.size(); ++i) b.c[i] = a.c[i] - (2 * k - 1) * b.c[i];
    n = b;
  }
  const double slope = std::max(first.at(s), spans::least_time_slope);
  // At rest together with time: as in `limit_where_time_rests`.
  const double rest = 4 * spans::least_time_slope, bend = second.at(s);
  if (order == 1 && slope == spans::least_time_slope && std::abs(bend) > rest &&
      std::abs(n.at(s) * bend) <= rest * std::abs(n.derived().at(s)) &&
      std::abs(n.at(s) * bend - n.derived().at(s) * first.at(s)) <=
          0.1 * std::abs(n.at(s) * bend) + 1e-9 * std::abs(n.derived().at(s) * bend))
    return n.derived().at(s) / bend;
  double divisor = slope;
  for (int k = 1; k < order; ++k) divisor *= slope * slope;
  return n.at(s) / divisor;
}

template <class T, class Data>
T segment_derivative(const Data& d, std::size_t i, double u, int order) noexcept {
  const spans::Segment segment = d.segment(i);
  T result = zero<T>();
  std::array<T, 4> room;
  const T* c = d.coefficients(i, segment.first, room);
  if (!segment.warped) {
    for (int k = segment.degree; k >= order; --k) {
      double factor = 1;
      for (int j = 0; j < order; ++j) factor *= k - j;
      result = u * result + factor * c[k];
    }
  } else if (segment.degree > 0) {
    const Warp& warp = d.warps[i];
    LongPolynomial x{3, {}};
    std::ranges::copy(spans::time_cubic(warp.parameters[0], warp.parameters[1]), x.c.begin());
    const double s = warp.at(u).s;
    for (int k = 0; k < spans::dimensions<T>; ++k) {
      LongPolynomial y{segment.degree, {}};
      for (int j = 0; j <= segment.degree; ++j) y.c[static_cast<std::size_t>(j)] = spans::component(c[j], k);
      spans::component_of(result, k) = through_handles(y, x, s, order);
    }
    for (int j = 0; j < order; ++j) result = result * warp.width;
  }
  for (int j = 0; j < order; ++j) result = result * segment.inverse;
  return result;
}

[[noreturn]] void refuse_order(int order, const std::string& why) {
  throw std::invalid_argument("the derivative of order " + std::to_string(order) + " is not known: " + why);
}

template <class Data>
void check_order(const Data& d, int order) {
  if (order < 0 || order > highest_order) refuse_order(order, "orders go from 0 to " + std::to_string(highest_order));
  if (order <= 2 || (d.start == d.end && !d.rebuilt)) return;
  if (!d.times) refuse_order(order, "a formula gives two");
  for (std::size_t i = 0; i < d.warps.size(); ++i)
    if (d.warps[i].function && d.segment(i).degree > 0 && !spans::is_time_bezier(d.warps[i]))
      refuse_order(order, "the ease from " + spans::text_of(d.knots()[i]) + " s gives two");
}

// Precondition: the order is known.
template <class T>
T known_derivative(const Curve<T>& curve, int order, double time, Side side) noexcept {
  if (order <= 2) {
    const Sample<T> s = curve.sample(time, side);
    return order == 0 ? s.value : order == 1 ? s.rate : s.acceleration;
  }
  const auto& d = CurveAccess::data(curve);
  if (!d.times) return zero<T>();
  double sign = 1;
  const bool early = time < d.start || (time == d.start && side == Side::in);
  if (early || time > d.end || (time == d.end && side == Side::out)) {
    const OutsideRule<T>& outside = (early ? d.before : d.after).rule;
    if (!spans::loops(outside.rule)) return zero<T>();
    const std::optional<double> over = spans::last_play(outside, d.start, d.end, early);
    if (over && spans::is_beyond(time, side, *over, early)) return zero<T>();
    const auto [local, plays] = spans::played_time(time, d.start, d.end - d.start, side == Side::in);
    time = d.start + local;
    if (spans::is_backward(outside.rule, plays)) {
      time = d.end - local;
      side = side == Side::in ? Side::out : Side::in;
      if (order % 2 != 0) sign = -1;
    }
  }
  std::size_t i = time < d.end ? d.times->locate(std::max(time, d.start)) : d.span_count() - 1;
  double u = std::min((time - d.knots()[i]) / d.times->duration(i), 1.0);
  if (side == Side::in && u == 0 && i > 0) {
    i -= 1;
    u = 1;
  }
  return sign * segment_derivative<T>(d, i, u, order);
}

// Whether the rate beyond an end is constant or a loop of the rates inside.
template <class T>
bool is_plain_outside(const OutsideRule<T>& rule) noexcept {
  return !spans::loops(rule.rule) || (rule.rule != Outside::pingpong && rule.plays == 0);
}

template <class T>
spans::CurveEnd<T> end_of_rate(const Curve<T>& curve, bool early) noexcept {
  const Outside rule = early ? curve.before() : curve.after();
  if (rule == Outside::repeat || rule == Outside::repeat_offset) return {{Outside::repeat}, {}, {}};
  return {{Outside::hold}, early ? curve.rate(curve.start(), Side::in) : curve.rate(curve.end(), Side::out), {}};
}

// The rate as a formula, where spans cannot express it.
template <class T>
Curve<T> formula_of_rate(const Curve<T>& curve, const spans::CurveEnd<T>& before, const spans::CurveEnd<T>& after) {
  const auto sampler = [curve](double time, Side side) {
    const Sample<T> s = curve.sample(time, side);
    return Sample<T>{s.rate, s.acceleration, known_derivative(curve, 3, time, side)};
  };
  const Curve<T> rate = CurveAccess::with_ends(
      CurveAccess::formula_with_knots<T>(sampler, curve.start(), curve.end(), CurveAccess::breaks(curve)), before,
      after);
  if (is_plain_outside(curve.rule_before()) && is_plain_outside(curve.rule_after())) return rate;
  // Otherwise the rate outside comes from the curve itself.
  return CurveAccess::seen_through<T>(
      sampler, curve.start(), curve.end(), CurveAccess::breaks(curve), {curve.before(), {}, curve.rule_before().plays},
      {curve.after(), {}, curve.rule_after().plays},
      [rate](const OutsideRule<T>& early, const OutsideRule<T>& late) { return rate.with_outside(early, late); });
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class T>
T derivative_at(const Curve<T>& curve, int order, double time, Side side) {
  questions::check_order(CurveAccess::data(curve), order);
  spans::check_times(time, time);
  return questions::known_derivative(curve, order, time, side);
}

template <class T>
Curve<T> derivative(const Curve<T>& curve) {
  const spans::CurveEnd<T> before = questions::end_of_rate(curve, true), after = questions::end_of_rate(curve, false);
  if (curve.start() == curve.end() && spans::has_spans(curve))
    return CurveAccess::one_key<T>(zero<T>(), curve.start(), before, after);
  questions::check_order(CurveAccess::data(curve), 3);
  std::vector<Span<T>> spans = curve.spans();
  const bool warped = std::any_of(spans.begin(), spans.end(),
                                  [](const Span<T>& span) { return span.warp.function && span.degree > 0; });
  if (warped || !questions::is_plain_outside(curve.rule_before()) || !questions::is_plain_outside(curve.rule_after()))
    return questions::formula_of_rate(curve, before, after);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    Span<T>& span = spans[i];
    const double inverse = 1 / (curve.knots()[i + 1] - curve.knots()[i]);
    T sum = zero<T>();
    for (int k = 1; k <= span.degree; ++k) {
      const std::size_t at = static_cast<std::size_t>(k);
      span.coefficients[at - 1] = (k * inverse) * span.coefficients[at];
      sum = sum + span.coefficients[at - 1];
    }
    if (span.degree == 0) span.coefficients[0] = sum;
    span.degree = std::max(0, span.degree - 1);
    span.warp = {};
    span.end = sum;
  }
  return CurveAccess::from_spans<T>(spans, curve.end(), before, after);
}

#define TWEENFALL_DERIVATIVE(T)                                    \
  template T derivative_at<T>(const Curve<T>&, int, double, Side); \
  template Curve<T> derivative<T>(const Curve<T>&);
TWEENFALL_DERIVATIVE(double)
TWEENFALL_DERIVATIVE(Vec2)
TWEENFALL_DERIVATIVE(Vec3)
TWEENFALL_DERIVATIVE(Vec4)
#undef TWEENFALL_DERIVATIVE

}  // namespace tweenfall
