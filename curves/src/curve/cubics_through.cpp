// Curves that are cubics through their knots throughout, written directly in the form that a curve stores.

#include "curve/curve_data.h"

namespace tweenfall::spans {
namespace {

// With sums of coefficients up to this, over durations down to its inverse, every rate is finite; anything beyond is
// checked span by span.
constexpr double surely_finite = 1e90;

template <class T>
T rate_at(std::span<const double> rates, std::size_t i) noexcept {
  T rate;
  for (int c = 0; c < dimensions<T>; ++c)
    component_of(rate, c) = rates[i * dimensions<T> + static_cast<std::size_t>(c)];
  return rate;
}

template <class T>
std::array<T, 4> cubic_of(std::span<const double> times, std::span<const T> values, std::span<const double> rates,
                          std::size_t i) noexcept {
  const double duration = times[i + 1] - times[i];
  std::array<T, 4> c;
  cubic_coefficients<T>(values[i], values[i + 1] - values[i], duration * rate_at<T>(rates, i),
                        duration * rate_at<T>(rates, i + 1), c.data());
  return c;
}

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall {

template <class T>
std::optional<Curve<T>> CurveAccess::cubics_through(std::span<const double> times, std::span<const T> values,
                                                    std::span<const double> rates, const spans::CurveEnd<T>& before,
                                                    const spans::CurveEnd<T>& after) {
  auto data = std::make_shared<typename Curve<T>::Data>();
  data->before = before;
  data->after = after;
  data->start = times.front();
  data->end = times.back();
  data->times = spans::shared_times(times);
  const std::size_t count = times.size() - 1;
  bool finite = data->end - data->start <= spans::surely_finite;
  if constexpr (std::is_same_v<T, double>) {
    data->pool.resize(4 * count);
    data->rows = 4;
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<double, 4> c = spans::cubic_of(times, values, rates, i);
      std::ranges::copy(c, &data->pool[4 * i]);
      const double size = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) + std::abs(c[3]);
      finite &= size <= spans::surely_finite && times[i + 1] - times[i] >= 1 / spans::surely_finite;
    }
  } else {
    data->passed.reserve(2 * times.size());
    data->rows = 4;
    for (std::size_t i = 0; i <= count; ++i) {
      data->passed.push_back(values[i]);
      data->passed.push_back(spans::rate_at<T>(rates, i));
      if (i == count) break;
      double size = 0;
      for (const T& row : spans::cubic_of(times, values, rates, i)) size += row.cwiseAbs().sum();
      finite &= size <= spans::surely_finite && times[i + 1] - times[i] >= 1 / spans::surely_finite;
    }
  }
  if (!finite) return std::nullopt;
  data->kinds.push_back({0, 3, false, RotationSpan::Form::exponential});
  data->ends.push_back(values.back());
  return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
}

#define TWEENFALL_CUBICS(T)                                                                                        \
  template std::optional<Curve<T>> CurveAccess::cubics_through(std::span<const double>, std::span<const T>,        \
                                                               std::span<const double>, const spans::CurveEnd<T>&, \
                                                               const spans::CurveEnd<T>&);
TWEENFALL_CUBICS(double)
TWEENFALL_CUBICS(Vec2)
TWEENFALL_CUBICS(Vec3)
TWEENFALL_CUBICS(Vec4)
#undef TWEENFALL_CUBICS

}  // namespace tweenfall
