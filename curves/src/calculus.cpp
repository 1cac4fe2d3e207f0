#include <tweenfall/curves/calculus.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "curve_parts.h"
#include "polynomial_roots.h"

namespace tweenfall {
namespace {

// Gauss and Legendre's rule with five points, for parts that are no polynomial.
double sampled_integral(const Curve<double>& curve, double from, double to) {
  constexpr double nodes[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weights[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                 0.2369268850561891};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += weights[i] * curve.value(middle + half * nodes[i]);
  return half * sum;
}

// Time between from and to at which `f` changes sign; it must have different signs there.
template <class F>
double crossing(const F& f, double from, double to) {
  const bool positive = f(from) > 0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (from + to);
    if (middle <= from || middle >= to) break;
    ((f(middle) > 0) == positive ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

double time_at(const CurvePart& part, double u) {
  return u == 0 ? part.from : u == 1 ? part.to : part.from + u * (part.to - part.from);
}

// Times within the part, ends left out, at which the rate vanishes.
std::vector<double> stationary_times(const Curve<double>& curve, const CurvePart& part) {
  std::vector<double> result;
  if (!part.coefficients.empty()) {
    for (const double u : polynomial_roots(polynomial_derivative(part.coefficients), 0, 1))
      if (u > 0 && u < 1) result.push_back(time_at(part, u));
    return result;
  }
  const auto rate = [&curve](double t) { return curve.rate(t); };
  const double a = curve.rate(part.from, Side::out), b = curve.rate(part.to, Side::in);
  if ((a > 0 && b < 0) || (a < 0 && b > 0)) result.push_back(crossing(rate, part.from, part.to));
  return result;
}

double sign_of(double v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

}  // namespace

double integral(const Curve<double>& curve, double from, double to) {
  if (to < from) return -integral(curve, to, from);
  double sum = 0;
  for (const CurvePart& part : curve_parts(curve, from, to)) {
    if (part.coefficients.empty()) {
      sum += sampled_integral(curve, part.from, part.to);
      continue;
    }
    double mean = 0;
    for (std::size_t i = 0; i < part.coefficients.size(); ++i)
      mean += part.coefficients[i] / static_cast<double>(i + 1);
    sum += mean * (part.to - part.from);
  }
  return sum;
}

Range range(const Curve<double>& curve, double from, double to) {
  if (to < from) std::swap(from, to);
  const double first = curve.value(from);
  Range result{first, first};
  const auto include = [&result](double v) {
    result.low = std::min(result.low, v);
    result.high = std::max(result.high, v);
  };
  for (const CurvePart& part : curve_parts(curve, from, to)) {
    include(curve.value(part.from, Side::out));
    include(curve.value(part.to, Side::in));
    for (const double t : stationary_times(curve, part)) include(curve.value(t));
  }
  return result;
}

std::vector<double> extrema(const Curve<double>& curve) {
  std::vector<double> result;
  if (curve.knots().size() < 2) return result;
  double before = 0;  // sign of the rate just passed
  for (const CurvePart& part : curve_parts(curve, curve.start(), curve.end())) {
    std::vector<double> marks = {part.from};
    for (const double t : stationary_times(curve, part)) marks.push_back(t);
    marks.push_back(part.to);
    for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
      const double sign = sign_of(curve.rate(0.5 * (marks[i] + marks[i + 1])));
      // A stretch at rest has no extreme, nor has what follows it.
      if (before * sign < 0) result.push_back(marks[i]);
      before = sign;
    }
  }
  return result;
}

std::vector<double> solve(const Curve<double>& curve, double level, double from, double to) {
  if (to < from) std::swap(from, to);
  std::vector<double> result;
  const auto add = [&result, from, to](double t) {
    const double same = 1e-12 * (to - from);
    if (result.empty() || t - result.back() > same) result.push_back(t);
  };
  if (from == to && curve.value(from) == level) add(from);
  for (const CurvePart& part : curve_parts(curve, from, to)) {
    if (part.coefficients.empty()) {
      const double a = curve.value(part.from, Side::out) - level, b = curve.value(part.to, Side::in) - level;
      std::vector<double> marks = {part.from};
      for (const double t : stationary_times(curve, part)) marks.push_back(t);
      marks.push_back(part.to);
      if (a == 0) add(part.from);
      for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
        const double v = i == 0 ? a : curve.value(marks[i]) - level;
        const double w = i + 2 == marks.size() ? b : curve.value(marks[i + 1]) - level;
        if (sign_of(v) * sign_of(w) < 0)
          add(crossing([&](double t) { return curve.value(t) - level; }, marks[i], marks[i + 1]));
      }
      if (b == 0) add(part.to);
      continue;
    }
    std::vector<double> c = part.coefficients;
    c[0] -= level;
    if (std::all_of(c.begin(), c.end(), [](double v) { return v == 0; })) {
      // The ends of the rest; a rest that goes on is not cut at a knot.
      const bool goes_on = result.size() > 1 && result.back() == part.from &&
                           curve.value(0.5 * (result[result.size() - 2] + part.from)) == level;
      if (goes_on)
        result.back() = part.to;
      else {
        add(part.from);
        add(part.to);
      }
      continue;
    }
    for (const double u : polynomial_roots(c, 0, 1)) add(time_at(part, u));
  }
  return result;
}

}  // namespace tweenfall
