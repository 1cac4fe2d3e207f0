#include <tweenfall/curves/functions.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "curve/curve_data.h"

namespace tweenfall::spans {
namespace {

// The extent and the rules outside that all parts share; where they differ, or a slope is stated, the sum is endless,
// and each part continues by its own rule. Constants are ignored.
struct Extent {
  double start = -std::numeric_limits<double>::infinity(), end = -start;
  Outside before = Outside::hold, after = Outside::hold;
  double plays_before = 0, plays_after = 0;

  bool operator==(const Extent&) const = default;
};

bool states_slope(const CurveEnd<double>& end) noexcept {
  return end.rule.rule == Outside::linear && end.straight();
}

template <class Curves>
Extent shared_extent(const Curves& parts) {
  Extent shared;
  bool any = false;
  for (const Curve<double>& part : parts) {
    if (part.start() == part.end()) continue;
    const CurveEnd<double>&before = CurveAccess::data(part).before, &after = CurveAccess::data(part).after;
    const Extent own{part.start(), part.end(), before.rule.rule, after.rule.rule, before.rule.plays, after.rule.plays};
    if ((any && !(own == shared)) || states_slope(before) || states_slope(after)) return {};
    shared = own;
    any = true;
  }
  return shared;
}

template <class T, class Curves>
Curve<T> made(typename Curve<T>::Formula formula, const Curves& parts) {
  const Extent extent = shared_extent(parts);
  std::vector<NumberOverTime> leaping;
  for (const Curve<double>& part : parts) {
    const std::vector<NumberOverTime>& own = CurveAccess::leaping(part);
    leaping.insert(leaping.end(), own.begin(), own.end());
  }
  return CurveAccess::with_leaping(Curve<T>(std::move(formula), extent.start, extent.end), leaping)
      .with_outside({extent.before, {}, extent.plays_before}, {extent.after, {}, extent.plays_after});
}

template <class T, std::size_t size>
Curve<T> by_coordinates(const std::array<Curve<double>, size>& parts) {
  return made<T>(
      [parts](double t, Side side) {
        Sample<T> result{};
        for (std::size_t i = 0; i < size; ++i) {
          const Sample<double> s = parts[i].sample(t, side);
          const auto row = static_cast<Eigen::Index>(i);
          result.value[row] = s.value;
          result.rate[row] = s.rate;
          result.acceleration[row] = s.acceleration;
        }
        return result;
      },
      parts);
}

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall {

Curve<Vec2> parametric(const Curve<double>& x, const Curve<double>& y) {
  return spans::by_coordinates<Vec2>(std::array<Curve<double>, 2>{x, y});
}

Curve<Vec3> parametric(const Curve<double>& x, const Curve<double>& y, const Curve<double>& z) {
  return spans::by_coordinates<Vec3>(std::array<Curve<double>, 3>{x, y, z});
}

template <class T>
Curve<T> combined(std::span<const Curve<double>> basis, std::span<const T> coefficients) {
  if (basis.empty() || basis.size() != coefficients.size())
    throw std::invalid_argument("a combination needs one coefficient for each function, and one at least; there are " +
                                std::to_string(basis.size()) + " functions and " + std::to_string(coefficients.size()) +
                                " coefficients");
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    if (!spans::all_finite(coefficients[i]))
      throw std::invalid_argument("coefficient " + std::to_string(i) + " must be finite; it is " +
                                  spans::text_of(coefficients[i]));
  return spans::made<T>(
      [functions = std::vector<Curve<double>>(basis.begin(), basis.end()),
       weights = std::vector<T>(coefficients.begin(), coefficients.end())](double t, Side side) {
        Sample<T> result{zero<T>(), zero<T>(), zero<T>()};
        for (std::size_t i = 0; i < functions.size(); ++i) {
          const Sample<double> s = functions[i].sample(t, side);
          result.value += s.value * weights[i];
          result.rate += s.rate * weights[i];
          result.acceleration += s.acceleration * weights[i];
        }
        return result;
      },
      basis);
}

template Curve<double> combined<double>(std::span<const Curve<double>>, std::span<const double>);
template Curve<Vec2> combined<Vec2>(std::span<const Curve<double>>, std::span<const Vec2>);
template Curve<Vec3> combined<Vec3>(std::span<const Curve<double>>, std::span<const Vec3>);
template Curve<Vec4> combined<Vec4>(std::span<const Curve<double>>, std::span<const Vec4>);

}  // namespace tweenfall
