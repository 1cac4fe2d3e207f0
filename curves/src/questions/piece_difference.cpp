#include "questions/piece_difference.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "splines/control_points.h"

namespace tweenfall::questions {
namespace {

template <class V>
void add_difference(std::vector<PieceDifference<V>>& result, const CurvePiece<V>& a, const CurvePiece<V>& b,
                    double sign) {
  PieceDifference<V> d{a, composed(b, a), 0};
  const std::size_t n = std::max(d.c.size(), static_cast<std::size_t>(a.degree) + 1);
  d.c.resize(n, zero<V>());
  for (std::size_t i = 0; i < n; ++i) {
    const V own = i <= static_cast<std::size_t>(a.degree) ? a.c[i] : zero<V>();
    d.c[i] = sign * (own - d.c[i]);
  }
  d.rounding = a.rounding() + b.rounding();
  result.push_back(std::move(d));
}

template <class V>
void add_common(std::vector<PieceDifference<V>>& result, const CurvePiece<V>& a, const CurvePiece<V>& b) {
  if (!b.timed) {
    add_difference(result, a, b, 1);
    return;
  }
  if (!a.timed) {
    add_difference(result, b, a, -1);
    return;
  }
  double apart = 0;
  for (std::size_t i = 0; i < 4; ++i) apart = std::max(apart, std::abs(a.x[i] - b.x[i]));
  if (apart <= 1e-14) {
    CurvePiece<V> plain = b;
    plain.timed = false;
    CurvePiece<V> lead = a;
    lead.timed = false;
    add_difference(result, lead, plain, 1);
    result.back().piece = a;
    return;
  }
  for (const CurvePiece<V>& quintic : as_quintics(b))
    add_difference(result, piece_part(a, quintic.from, quintic.to), quintic, 1);
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class V>
questions::CurvePiece<V> questions::piece_part(const questions::CurvePiece<V>& piece, double from, double to) {
  if (from <= piece.from && to >= piece.to) return piece;
  questions::CurvePiece<V> part = piece;
  const double s0 = piece.position_at(from), s1 = piece.position_at(to);
  part.from = from;
  part.to = to;
  math::substitute(part.c.data(), piece.degree, s0, s1 - s0);
  if (piece.timed) {
    math::substitute(part.x.data(), 3, s0, s1 - s0);
    const double width = part.x[1] + part.x[2] + part.x[3];
    part.x = {0, part.x[1] / width, part.x[2] / width, part.x[3] / width};
  }
  return part;
}

template <class V>
std::vector<V> questions::composed(const questions::CurvePiece<V>& b, const questions::CurvePiece<V>& a) {
  const double length = b.to - b.from;
  const double offset = (a.from - b.from) / length, width = (a.to - a.from) / length;
  std::vector<V> result(b.c.begin(), b.c.begin() + b.degree + 1);
  math::substitute(result.data(), b.degree, offset, width);
  if (!a.timed) return result;
  // Horner's rule on polynomials.
  std::vector<V> sum = {result.back()};
  for (std::size_t i = result.size() - 1; i-- > 0;) {
    std::vector<V> next(sum.size() + 3, zero<V>());
    for (std::size_t k = 0; k < sum.size(); ++k)
      for (std::size_t j = 1; j < 4; ++j) next[k + j] = next[k + j] + a.x[j] * sum[k];
    next[0] = next[0] + result[i];
    sum = std::move(next);
  }
  return sum;
}

template <class V>
std::vector<questions::PieceDifference<V>> questions::piece_differences(
    const std::vector<questions::CurvePiece<V>>& a, const std::vector<questions::CurvePiece<V>>& b) {
  std::vector<questions::PieceDifference<V>> result;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const double from = std::max(a[i].from, b[k].from), to = std::min(a[i].to, b[k].to);
    if (to > from)
      questions::add_common(result, questions::piece_part(a[i], from, to), questions::piece_part(b[k], from, to));
    const bool a_ends = a[i].to <= b[k].to, b_ends = b[k].to <= a[i].to;
    if (a_ends) ++i;
    if (b_ends) ++k;
  }
  return result;
}

#define TWEENFALL_DIFFERENCE(V)                                                                                     \
  template questions::CurvePiece<V> questions::piece_part<V>(const questions::CurvePiece<V>&, double, double);      \
  template std::vector<V> questions::composed<V>(const questions::CurvePiece<V>&, const questions::CurvePiece<V>&); \
  template std::vector<questions::PieceDifference<V>> questions::piece_differences<V>(                              \
      const std::vector<questions::CurvePiece<V>>&, const std::vector<questions::CurvePiece<V>>&);
TWEENFALL_DIFFERENCE(double)
TWEENFALL_DIFFERENCE(Vec2)
TWEENFALL_DIFFERENCE(Vec3)
TWEENFALL_DIFFERENCE(Vec4)
#undef TWEENFALL_DIFFERENCE

}  // namespace tweenfall
