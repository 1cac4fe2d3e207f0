#include <tweenfall/curves/calculus.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "curve/spans_between.h"
#include "math/bracketing.h"
#include "math/polynomial.h"
#include "math/polynomial_roots.h"
#include "questions/curve_pieces.h"

namespace tweenfall::questions {
namespace {

// A falling curve is turned upside down, so that everything rises.
struct Inverse {
  Curve<double> curve;
  double sign;
  double least_rate;
  std::vector<CurvePiece<double>> pieces;
  std::vector<double> leaving, arriving;  // values at both ends of each piece, neither falling

  // Time at which the piece takes `level`, which lies between its ends.
  double time_in(std::size_t i, double level) const noexcept {
    const CurvePiece<double>& piece = pieces[i];
    if (!piece.exact())
      return math::crossing([&](double t) { return sign * curve.value(t) - level; }, piece.from, piece.to);
    const auto above = [&](double s) { return sign * math::polynomial_at(piece.c.data(), piece.degree, s) - level; };
    return piece.time_at(math::crossing(above, 0, 1));
  }

  Sample<double> operator()(double value, Side side) const noexcept {
    const double level = sign * value;
    std::size_t i;
    double time;
    if (side == Side::out) {
      const auto after = std::upper_bound(leaving.begin(), leaving.end(), level);
      i = after == leaving.begin() ? 0 : static_cast<std::size_t>(after - leaving.begin()) - 1;
    } else {
      const auto reached = std::lower_bound(arriving.begin(), arriving.end(), level);
      i = reached == arriving.end() ? pieces.size() - 1 : static_cast<std::size_t>(reached - arriving.begin());
    }
    const bool at_end = level >= arriving[i], at_start = level <= leaving[i];
    if (side == Side::out)
      time = at_end ? pieces[i].to : at_start ? pieces[i].from : time_in(i, level);
    else
      time = at_start ? pieces[i].from : at_end ? pieces[i].to : time_in(i, level);
    // A level between the arriving and the leaving value lies in a jump.
    const bool jump = level > arriving[i] || level < leaving[i];
    if (jump && level > leaving.front() && level < arriving.back()) return {time, 0, 0};
    const Side near = time <= pieces.front().from ? Side::out : time >= pieces.back().to ? Side::in : side;
    const Sample<double> s = curve.sample(time, near);
    const double rate = sign * std::max(sign * s.rate, least_rate);
    return {time, 1 / rate, rate == s.rate ? -s.acceleration / (rate * rate * rate) : 0};
  }
};

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

Curve<double> inverse(const Curve<double>& curve) {
  spans::check_times(curve.start(), curve.end());
  auto result = std::make_shared<questions::Inverse>(
      questions::Inverse{curve, 1, 0, questions::curve_pieces(curve, curve.start(), curve.end()), {}, {}});
  const double first = curve.value(curve.start()), last = curve.value(curve.end(), Side::in);
  if (result->pieces.empty() || first == last)
    throw std::invalid_argument("a curve that ends where it begins, at " + spans::text_of(first) + ", has no inverse");
  result->sign = last > first ? 1 : -1;
  result->least_rate = 1e-6 * std::abs(last - first) / curve.duration();
  double before = result->sign * first;
  const double scale = std::max(std::abs(first), std::abs(last));
  const auto rise = [&](double value, double time, double rounding) {
    if (value < before - 1e-14 * scale - rounding)
      throw std::invalid_argument("a curve must not turn to have an inverse; this one does before " +
                                  spans::text_of(time) + " s");
    before = std::max(before, value);
  };
  for (const questions::CurvePiece<double>& piece : result->pieces) {
    rise(result->sign * curve.value(piece.from, Side::out), piece.from, 4 * piece.error);
    result->leaving.push_back(before);
    for (const double s :
         math::polynomial_roots(math::polynomial_derivative(questions::component_polynomial(piece, 0)), 0, 1))
      rise(result->sign * curve.value(piece.time_at(s), s >= 1 ? Side::in : Side::out), piece.time_at(s),
           4 * piece.error);
    rise(result->sign * curve.value(piece.to, Side::in), piece.to, 4 * piece.error);
    result->arriving.push_back(before);
  }
  return Curve<double>([result](double value, Side side) { return (*result)(value, side); }, std::min(first, last),
                       std::max(first, last));
}

}  // namespace tweenfall
