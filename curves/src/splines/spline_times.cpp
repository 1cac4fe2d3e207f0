#include <tweenfall/curves/splines.h>

#include <cmath>

#include "splines/spline_check.h"

namespace tweenfall {

template <class T>
std::vector<double> spline_times(std::span<const T> points, Parametrization parametrization, bool closed) {
  splines::check_spline_list(points, points.size(), "point");
  const std::size_t n = points.size();
  if (n < 2) splines::refuse_spline("needs two or more points; " + std::to_string(n) + " were given");
  std::vector<double> times = {0};
  for (std::size_t i = 1; i < n + (closed ? 1 : 0); ++i) {
    double square = 0;
    for (int c = 0; c < spans::dimensions<T>; ++c) {
      const double step = spans::component(points[i % n], c) - spans::component(points[i - 1], c);
      square += step * step;
    }
    const double distance = std::sqrt(square);
    const double advance = parametrization == Parametrization::uniform       ? 1
                           : parametrization == Parametrization::centripetal ? std::sqrt(distance)
                                                                             : distance;
    const double next = times.back() + advance;
    if (!(next > times.back()) || !std::isfinite(next))
      splines::refuse_spline("whose times go by distance needs consecutive points to differ; number " +
                             std::to_string(i % n) + ", " + spans::text_of(points[i % n]) + ", lies " +
                             spans::text_of(distance) + " from the one before it");
    times.push_back(next);
  }
  return times;
}

template std::vector<double> spline_times<double>(std::span<const double>, Parametrization, bool);
template std::vector<double> spline_times<Vec2>(std::span<const Vec2>, Parametrization, bool);
template std::vector<double> spline_times<Vec3>(std::span<const Vec3>, Parametrization, bool);
template std::vector<double> spline_times<Vec4>(std::span<const Vec4>, Parametrization, bool);

}  // namespace tweenfall
