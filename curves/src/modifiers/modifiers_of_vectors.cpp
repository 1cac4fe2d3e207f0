#include <tweenfall/curves/modifiers.h>

#include <stdexcept>

#include "curve/curve_data.h"

namespace tweenfall::forms {
namespace {

template <class T>
Curve<double> one_component(const Curve<T>& curve, int i) {
  return CurveAccess::converted<double>(curve, [i](const Curve<T>& inner, double time, Side side) {
    const Sample<T> s = inner.sample(time, side);
    return Sample<double>{s.value[i], s.rate[i], s.acceleration[i]};
  });
}

}  // namespace
}  // namespace tweenfall::forms

namespace tweenfall {

template <class T>
Curve<T> modified(const Curve<T>& curve, std::span<const std::vector<Modifier>> modifiers) {
  constexpr std::size_t size = static_cast<std::size_t>(spans::dimensions<T>);
  if (modifiers.size() != size)
    throw std::invalid_argument("a vector of " + std::to_string(size) + " needs one list of modifiers per component; " +
                                std::to_string(modifiers.size()) + " were given");
  std::vector<Curve<double>> parts;
  for (std::size_t i = 0; i < size; ++i) {
    try {
      const Curve<double> part = forms::one_component(curve, static_cast<int>(i));
      parts.push_back(modifiers[i].empty() ? part : modified(part, modifiers[i]));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("component " + std::to_string(i) + ", " + error.what());
    }
  }
  const std::vector<std::vector<Modifier>> kept(modifiers.begin(), modifiers.end());
  std::vector<NumberOverTime> leaping;
  for (const Curve<double>& part : parts) {
    const std::vector<NumberOverTime>& own = CurveAccess::leaping(part);
    leaping.insert(leaping.end(), own.begin(), own.end());
  }
  return CurveAccess::seen_through<T>(
      [parts](double time, Side side) {
        Sample<T> result{zero<T>(), zero<T>(), zero<T>()};
        for (std::size_t i = 0; i < size; ++i) {
          const Sample<double> s = parts[i].sample(time, side);
          const auto row = static_cast<Eigen::Index>(i);
          result.value[row] = s.value;
          result.rate[row] = s.rate;
          result.acceleration[row] = s.acceleration;
        }
        return result;
      },
      curve.start(), curve.end(), CurveAccess::breaks(curve), {curve.before(), {}, curve.rule_before().plays},
      {curve.after(), {}, curve.rule_after().plays},
      [curve, kept](const OutsideRule<T>& before, const OutsideRule<T>& after) {
        return modified<T>(curve.with_outside(before, after), std::span<const std::vector<Modifier>>(kept));
      },
      leaping);
}

template Curve<Vec2> modified<Vec2>(const Curve<Vec2>&, std::span<const std::vector<Modifier>>);
template Curve<Vec3> modified<Vec3>(const Curve<Vec3>&, std::span<const std::vector<Modifier>>);
template Curve<Vec4> modified<Vec4>(const Curve<Vec4>&, std::span<const std::vector<Modifier>>);

}  // namespace tweenfall
