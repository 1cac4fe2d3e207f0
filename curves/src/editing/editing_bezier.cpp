#include <tweenfall/curves/editing.h>

#include <cmath>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/span_part.h"
#include "curve/time_bezier.h"
#include "splines/control_points.h"

namespace tweenfall::editing {
namespace {

[[noreturn]] void refuse_points(std::size_t i, const std::string& what) {
  throw std::invalid_argument("Bezier span " + std::to_string(i) + " " + what);
}

template <class T>
BezierPoints<T> points_of(const Span<T>& span, double end) {
  const bool warped = span.warp.function && span.degree > 0;
  if (span.degree > 3 || (warped && !spans::is_time_bezier(span.warp)))
    throw std::invalid_argument("the span from " + spans::text_of(span.start) +
                                " s is not a cubic; fit keys to the curve instead");
  std::vector<typename spans::Stored<T>::type> c(4, zero<typename spans::Stored<T>::type>());
  for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k) {
    if constexpr (std::is_same_v<T, Color>)
      c[k] = span.coefficients[k].rgba;
    else
      c[k] = span.coefficients[k];
  }
  const double duration = end - span.start;
  BezierPoints<T> result{{span.start, span.start + duration / 3, end - duration / 3, end}, {}};
  if (warped) {
    const std::array<double, 4> shown = spans::shown_time_cubic(span.warp, c.data(), 3);
    std::vector<double> x(shown.begin(), shown.end());
    splines::make_control_points(x);
    for (std::size_t k = 1; k < 3; ++k) result.times[k] = span.start + x[k] * duration;
  }
  splines::make_control_points(c);
  for (std::size_t k = 0; k < 4; ++k) {
    if constexpr (std::is_same_v<T, Color>)
      result.values[k].rgba = c[k];
    else
      result.values[k] = c[k];
  }
  result.values[3] = span.end;
  return result;
}

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
std::vector<BezierPoints<T>> bezier_points(const Curve<T>& curve) {
  const std::vector<Span<T>> spans = curve.spans();
  if (spans.empty()) throw std::invalid_argument("a formula has no Bezier points; fit keys to it instead");
  std::vector<BezierPoints<T>> result;
  for (std::size_t i = 0; i < spans.size(); ++i) result.push_back(editing::points_of(spans[i], curve.knots()[i + 1]));
  return result;
}

template <class T>
std::vector<Key<T>> keys_of(std::span<const BezierPoints<T>> spans) {
  if (spans.empty()) throw std::invalid_argument("keys are made of at least one Bezier span; none was given");
  std::vector<Key<T>> keys = {Key<T>{spans[0].times[0], spans[0].values[0]}};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const auto& [t, v] = spans[i];
    const double duration = t[3] - t[0];
    if (i > 0 && t[0] != spans[i - 1].times[3])
      editing::refuse_points(i, "must begin where the one before ends, at " + spans::text_of(spans[i - 1].times[3]) +
                                    " s; it begins at " + spans::text_of(t[0]) + " s");
    for (const double time : {t[1] - t[0], t[3] - t[2]})
      if (!(duration > 0) || !(time > 0 && time <= duration))
        editing::refuse_points(i, "has a handle " + spans::text_of(time) +
                                      " s long; it must be > 0 s and at most the span's " + spans::text_of(duration) +
                                      " s");
    // A share that misses a third only in its last bit is still the plain cubic.
    const auto weight = [duration](double length) {
      const double share = length / duration;
      return std::abs(share - 1.0 / 3) <= 1e-15 ? 1.0 / 3 : share;
    };
    const T leaving = (v[1] - v[0]) / (t[1] - t[0]), arriving = (v[3] - v[2]) / (t[3] - t[2]);
    keys.back().out = Tangent<T>{Tangent<T>::Kind::given, leaving, weight(t[1] - t[0])};
    Key<T> next{t[3], i + 1 < spans.size() ? spans[i + 1].values[0] : v[3]};
    next.in = Tangent<T>{Tangent<T>::Kind::given, arriving, weight(t[3] - t[2])};
    if (!(next.value == v[3])) next.value_in = v[3];
    keys.push_back(next);
  }
  return keys;
}

#define TWEENFALL_BEZIER(T)                                                \
  template std::vector<BezierPoints<T>> bezier_points<T>(const Curve<T>&); \
  template std::vector<Key<T>> keys_of<T>(std::span<const BezierPoints<T>>);
TWEENFALL_BEZIER(double)
TWEENFALL_BEZIER(Vec2)
TWEENFALL_BEZIER(Vec3)
TWEENFALL_BEZIER(Vec4)
#undef TWEENFALL_BEZIER
template std::vector<BezierPoints<Color>> bezier_points<Color>(const Curve<Color>&);

}  // namespace tweenfall
