#include <tweenfall/curves/elementary.h>

#include <cmath>

#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

// With x from 0 (arrived) to 1 (not started): the remaining wave f(x) a 2^(-10 x) sin((x + s) w), where f fades in an
// amplitude below 1 over the first quarter of a period. Parameters: amplitude, w, s.
Warp::Result penner_elastic_in(double u, const std::array<double, 4>& parameters) noexcept {
  // Exactly 0 at the start, followed by a jump as large as the wave still is there.
  if (u == 0) return {0, 0, 0};
  constexpr double rate = 10 * 0x1.62e42fefa39efp-1;
  const double a = parameters[0], w = parameters[1], s = parameters[2], x = 1 - u;
  const double high = std::abs(a) < 1 ? 1 : a;
  const double decay = high * elementary::exp(-rate * x);
  const elementary::SinCos wave = elementary::sin_cos((x + s) * w);
  const double value = decay * wave.sin;
  const double first = decay * (w * wave.cos - rate * wave.sin);
  const double second = decay * ((rate * rate - w * w) * wave.sin - 2 * rate * w * wave.cos);
  double f = 1, df = 0;
  if (const double least = std::abs(a); least < 1) {
    f = x < s ? 1 + (least - 1) * x / s : least;
    df = x < s ? (least - 1) / s : 0;
  }
  // d/du = -d/dx.
  return {f * value, -(f * first + df * value), f * second + 2 * df * first};
}

}  // namespace

// A negative amplitude swings the other way first, as Penner's does where the value falls.
// Source: Penner, 2002, unscaled, with amplitudes below 1 as Blender fades them in: Blender, blenlib/intern/easing.c.
static Pieces penner_elastic(double amplitude, double period, Flow flow) {
  constexpr double turn = 0x1.921fb54442d18p+2;
  const double w = turn / period;
  const double s = std::abs(amplitude) < 1 ? period / 4 : elementary::asin(1 / amplitude) / w;
  return flowing(WayIn{{0, 1}, {&penner_elastic_in, {amplitude, w, s, 0}}, &reversed<&penner_elastic_in>}, flow);
}

extern const FamilyRow penner_elastic_family{
    "penner-elastic",
    [](const Numbers& n, Flow flow) { return penner_elastic(n[0], n[1], flow); },
    {{{"amplitude", 1, -1e6, 1e6}, {"period", 0.3, 1e-6, 1e6}}}};

}  // namespace tweenfall::eases
