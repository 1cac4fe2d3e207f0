#include <tweenfall/curves/elementary.h>

#include <algorithm>

#include "eases/ease_row.h"
#include "eases/exponential.h"

namespace tweenfall::eases {
namespace {

// amplitude decay(1 - u) sin((1 - u) frequency + phase); parameters: amplitude, frequency, phase.
Warp::Result elastic_in(double u, const std::array<double, 4>& parameters) noexcept {
  const double amplitude = parameters[0], w = parameters[1];
  if (u == 1) {
    // The sine is 1 / amplitude here by choice of the phase.
    const Decay d = decay(0);
    const double cos = elementary::cos(parameters[2]);
    return {1, -(d.first + amplitude * w * cos), d.second + 2 * amplitude * d.first * w * cos - w * w};
  }
  const Decay d = decay(1 - u);
  const elementary::SinCos wave = elementary::sin_cos((1 - u) * w + parameters[2]);
  const double value = d.value * wave.sin;
  const double first = d.first * wave.sin + d.value * w * wave.cos;
  const double second = d.second * wave.sin + 2 * d.first * w * wave.cos - d.value * w * w * wave.sin;
  return {amplitude * value, -amplitude * first, amplitude * second};
}

}  // namespace

// Source: Penner, 2002, with the remainder at the end removed as for the exponential.
static Pieces elastic(double amplitude, double period, Flow flow) {
  constexpr double turn = 0x1.921fb54442d18p+2;
  const double a = std::max(amplitude, 1.0);
  return flowing(WayIn{{0, 1}, {&elastic_in, {a, turn / period, elementary::asin(1 / a), 0}}, &reversed<&elastic_in>},
                 flow);
}

extern const FamilyRow elastic_family{"elastic",
                                      [](const Numbers& n, Flow flow) { return elastic(n[0], n[1], flow); },
                                      {{{"amplitude", 1, 1, 1e6}, {"period", 0.3, 1e-6, 1e6}}}};

}  // namespace tweenfall::eases
