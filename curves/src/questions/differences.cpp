#include <tweenfall/curves/inspection.h>

#include <algorithm>

#include "math/polynomial_roots.h"
#include "questions/piece_difference.h"
#include "splines/control_points.h"

namespace tweenfall::questions {
namespace {

// Positions at which the length of the polynomial passes through `bound`, with 0 and 1.
template <class V>
std::vector<double> passes(const std::vector<V>& c, double bound) {
  std::vector<double> square(2 * c.size() - 1, 0.0);
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t k = 0; k < c.size(); ++k)
      for (int j = 0; j < spans::dimensions<V>; ++j)
        square[i + k] += spans::component(c[i], j) * spans::component(c[k], j);
  std::vector<double> marks = {0};
  const auto add = [&marks](const std::vector<double>& found) {
    marks.insert(marks.end(), found.begin(), found.end());
  };
  if constexpr (std::is_same_v<V, double>) {
    // Half the degree, and better conditioned.
    std::vector<double> shifted = c;
    shifted[0] = c[0] - bound;
    add(math::polynomial_roots(shifted, 0, 1));
    shifted[0] = c[0] + bound;
    add(math::polynomial_roots(shifted, 0, 1));
    std::sort(marks.begin(), marks.end());
  } else {
    square[0] -= bound * bound;
    add(math::polynomial_roots(square, 0, 1));
  }
  marks.push_back(1);
  return marks;
}

template <class V>
double length_at(const std::vector<V>& c, double s) {
  V value = c.back();
  for (std::size_t i = c.size() - 1; i-- > 0;) value = s * value + c[i];
  return splines::length_of(value);
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class T>
std::vector<Interval> differences(const Curve<T>& a, const Curve<T>& b, double from, double to, double tolerance) {
  if (to < from) std::swap(from, to);
  using V = typename spans::Stored<T>::type;
  std::vector<Interval> result;
  const auto add = [&result](double low, double high) {
    if (!(high > low)) return;
    if (!result.empty() && result.back().to == low)
      result.back().to = high;
    else
      result.push_back({low, high});
  };
  for (const questions::PieceDifference<V>& d :
       questions::piece_differences(questions::curve_pieces(a, from, to), questions::curve_pieces(b, from, to))) {
    std::vector<V> points = d.c;
    splines::make_control_points(points);
    const double bound = tolerance + d.rounding;
    if (splines::stays_within(points, bound)) continue;
    if (tolerance == 0) {
      add(d.piece.from, d.piece.to);
      continue;
    }
    const std::vector<double> marks = questions::passes(d.c, tolerance);
    for (std::size_t i = 0; i + 1 < marks.size(); ++i)
      if (questions::length_at(d.c, 0.5 * (marks[i] + marks[i + 1])) > tolerance)
        add(d.piece.time_at(marks[i]), d.piece.time_at(marks[i + 1]));
  }
  return result;
}

#define TWEENFALL_DIFFERENCES(T) \
  template std::vector<Interval> differences<T>(const Curve<T>&, const Curve<T>&, double, double, double);
TWEENFALL_DIFFERENCES(double)
TWEENFALL_DIFFERENCES(Vec2)
TWEENFALL_DIFFERENCES(Vec3)
TWEENFALL_DIFFERENCES(Vec4)
TWEENFALL_DIFFERENCES(Color)
#undef TWEENFALL_DIFFERENCES

}  // namespace tweenfall
