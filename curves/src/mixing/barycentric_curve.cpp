#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/curve.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "curve/curve_data.h"

namespace tweenfall::mixing {
namespace {

// Weights that cannot be mixed by are replaced by equal ones, since evaluation does not throw.
void mend(std::span<Sample<double>> weights) noexcept {
  double sum = 0;
  bool good = true;
  for (const Sample<double>& w : weights) {
    sum += w.value;
    good = good && std::isfinite(w.value) && std::isfinite(w.rate) && std::isfinite(w.acceleration);
  }
  if (!good || sum == 0 || !std::isfinite(1 / sum))
    for (Sample<double>& w : weights) w = {1, 0, 0};
}

// The times at which any of them may jump or kink.
template <class T>
spans::Breaks all_breaks(std::span<const Curve<T>> values, std::span<const Curve<double>> weights) {
  spans::Breaks result;
  const auto add = [&result](const auto& curve) {
    result.knots.insert(result.knots.end(), curve.knots().begin(), curve.knots().end());
    result.keys.insert(result.keys.end(), curve.key_times().begin(), curve.key_times().end());
  };
  std::for_each(values.begin(), values.end(), add);
  std::for_each(weights.begin(), weights.end(), add);
  for (std::vector<double>* times : {&result.knots, &result.keys}) {
    std::sort(times->begin(), times->end());
    times->erase(std::unique(times->begin(), times->end()), times->end());
  }
  return result;
}

template <class T, class Mix>
Curve<T> mixed_curve(std::span<const Curve<T>> values, std::span<const Curve<double>> weights, const Mix& mix) {
  if (values.empty() || values.size() > most_mixed_curves || values.size() != weights.size())
    throw std::invalid_argument("a mix of curves has 1 to " + std::to_string(most_mixed_curves) +
                                " values and a weight for each; there are " + std::to_string(values.size()) +
                                " values and " + std::to_string(weights.size()) + " weights");
  // Each continues by its own rule where it ends, so the mix is endless.
  constexpr double endless = std::numeric_limits<double>::infinity();
  return CurveAccess::formula_with_knots<T>(
      [mix, of = std::vector<Curve<T>>(values.begin(), values.end()),
       by = std::vector<Curve<double>>(weights.begin(), weights.end())](double time, Side side) {
        std::array<Sample<T>, most_mixed_curves> parts;
        std::array<Sample<double>, most_mixed_curves> shares;
        for (std::size_t i = 0; i < of.size(); ++i) {
          parts[i] = of[i].sample(time, side);
          shares[i] = by[i].sample(time, side);
        }
        mend({shares.data(), of.size()});
        return mix(std::span<const Sample<T>>(parts.data(), of.size()),
                   std::span<const Sample<double>>(shares.data(), of.size()));
      },
      -endless, endless, all_breaks(values, weights));
}

}  // namespace
}  // namespace tweenfall::mixing

namespace tweenfall {

template <class T>
Curve<T> barycentric_curve(std::span<const Curve<T>> values, std::span<const Curve<double>> weights) {
  return mixing::mixed_curve<T>(values, weights,
                                [](std::span<const Sample<T>> parts, std::span<const Sample<double>> shares) {
                                  return barycentric<T>(parts, shares);
                                });
}

template Curve<double> barycentric_curve<double>(std::span<const Curve<double>>, std::span<const Curve<double>>);
template Curve<Vec2> barycentric_curve<Vec2>(std::span<const Curve<Vec2>>, std::span<const Curve<double>>);
template Curve<Vec3> barycentric_curve<Vec3>(std::span<const Curve<Vec3>>, std::span<const Curve<double>>);
template Curve<Vec4> barycentric_curve<Vec4>(std::span<const Curve<Vec4>>, std::span<const Curve<double>>);
template Curve<Quat> barycentric_curve<Quat>(std::span<const Curve<Quat>>, std::span<const Curve<double>>);

Curve<Color> barycentric_curve(std::span<const Curve<Color>> values, std::span<const Curve<double>> weights,
                               ColorSpace space) {
  return mixing::mixed_curve<Color>(
      values, weights, [space](std::span<const Sample<Color>> parts, std::span<const Sample<double>> shares) {
        return barycentric(parts, shares, space);
      });
}

}  // namespace tweenfall
