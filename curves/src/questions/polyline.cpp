#include <tweenfall/curves/inspection.h>

#include <stdexcept>

#include "math/polynomial.h"
#include "questions/piece_difference.h"
#include "splines/control_points.h"

namespace tweenfall::questions {
namespace {

template <class V>
V value_at(const CurvePiece<V>& piece, double s) noexcept {
  return math::polynomial_at(piece.c.data(), piece.degree, s);
}

// Times inside the piece at which its straight connection must be cut.
template <class V>
void cut(std::vector<double>& times, const CurvePiece<V>& piece, double error, int depth) {
  CurvePiece<V> chord;
  chord.from = piece.from;
  chord.to = piece.to;
  chord.degree = 1;
  chord.c[0] = piece.c[0];
  chord.c[1] = value_at(piece, 1) - piece.c[0];
  std::vector<V> points = composed(chord, piece);
  points.resize(std::max(points.size(), static_cast<std::size_t>(piece.degree) + 1), zero<V>());
  for (std::size_t i = 0; i <= static_cast<std::size_t>(piece.degree); ++i) points[i] = points[i] - piece.c[i];
  splines::make_control_points(points);
  const double middle = piece.from + 0.5 * (piece.to - piece.from);
  if (splines::stays_within(points, error) || depth == 40 || !(middle > piece.from && middle < piece.to)) return;
  cut(times, piece_part(piece, piece.from, middle), error, depth + 1);
  times.push_back(middle);
  cut(times, piece_part(piece, middle, piece.to), error, depth + 1);
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class T>
std::vector<PolylinePoint<T>> polyline(const Curve<T>& curve, double from, double to, double error) {
  using V = typename spans::Stored<T>::type;
  if (!(error > 0)) throw std::invalid_argument("a polyline needs an error > 0; it is " + spans::text_of(error));
  if (to < from) std::swap(from, to);
  std::vector<PolylinePoint<T>> result;
  for (const questions::CurvePiece<V>& piece : questions::curve_pieces(curve, from, to)) {
    const double rounding = piece.rounding();
    const PolylinePoint<T> first{piece.from, curve.value(piece.from)};
    // A knot is one point, unless the curve jumps there.
    if (result.empty() || !(result.back().value == first.value)) result.push_back(first);
    std::vector<double> times;
    // An error bound smaller than rounding is met as far as possible.
    questions::cut(times, piece, error > 2 * rounding ? error - rounding : rounding, 0);
    for (const double time : times) result.push_back({time, curve.value(time)});
    result.push_back({piece.to, curve.value(piece.to, Side::in)});
  }
  if (result.empty()) result.push_back({from, curve.value(from)});
  return result;
}

#define TWEENFALL_POLYLINE(T) \
  template std::vector<PolylinePoint<T>> polyline<T>(const Curve<T>&, double, double, double);
TWEENFALL_POLYLINE(double)
TWEENFALL_POLYLINE(Vec2)
TWEENFALL_POLYLINE(Vec3)
TWEENFALL_POLYLINE(Vec4)
TWEENFALL_POLYLINE(Color)
#undef TWEENFALL_POLYLINE

}  // namespace tweenfall
