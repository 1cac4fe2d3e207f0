#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/functions.h>

#include <limits>
#include <stdexcept>

#include "curve/components.h"

namespace tweenfall {

Curve<double> oscillator(const Oscillator& o) {
  for (const double v : {o.amplitude, o.hz, o.phase, o.damping, o.center})
    if (!std::isfinite(v))
      throw std::invalid_argument("an oscillator needs finite numbers; one is " + spans::text_of(v));
  if (o.damping < 0)
    throw std::invalid_argument("an oscillator's damping must be >= 0 per second; it is " + spans::text_of(o.damping));
  constexpr double turn = 0x1.921fb54442d18p+2, endless = std::numeric_limits<double>::infinity();
  const double w = turn * o.hz;
  return Curve<double>(
      [o, w](double t, Side) {
        const elementary::SinCos wave = elementary::sin_cos(w * t + o.phase);
        const double size = o.damping == 0 ? o.amplitude : o.amplitude * elementary::exp(-o.damping * t);
        const double c = size * wave.cos, s = size * wave.sin;
        return Sample<double>{o.center + c, -o.damping * c - w * s,
                              (o.damping * o.damping - w * w) * c + 2 * o.damping * w * s};
      },
      -endless, endless);
}

}  // namespace tweenfall
