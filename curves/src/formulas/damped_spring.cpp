#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/spring_response.h>

#include <limits>
#include <stdexcept>

#include "curve/components.h"

namespace tweenfall {

Curve<double> damped_spring(const DampedSpring& s) {
  for (const double v : {s.hz, s.damping_ratio, s.position, s.velocity, s.goal, s.goal_velocity})
    if (!std::isfinite(v))
      throw std::invalid_argument("a damped spring needs finite numbers; one is " + spans::text_of(v));
  if (!(s.hz > 0)) throw std::invalid_argument("a damped spring's hz must be > 0; it is " + spans::text_of(s.hz));
  if (s.damping_ratio < 0)
    throw std::invalid_argument("a spring's damping ratio must be >= 0; it is " + spans::text_of(s.damping_ratio));
  constexpr double turn = 0x1.921fb54442d18p+2, endless = std::numeric_limits<double>::infinity();
  const double w = turn * s.hz, z = s.damping_ratio;
  // It settles at a constant lag behind a moving goal; about that point it moves like a free spring.
  const double lag = 2 * z * s.goal_velocity / w;
  const double x0 = s.position - s.goal + lag, v0 = (s.velocity - s.goal_velocity) / w;
  return Curve<double>(
      [goal = s.goal - lag, goal_velocity = s.goal_velocity, w, z, x0, v0](double t, Side) {
        const SpringResponse r = spring_response(w * t, z);
        const double x = x0 * r.displaced + v0 * r.struck;
        const double v = v0 * (r.displaced - 2 * z * r.struck) - x0 * r.struck;
        return Sample<double>{goal + goal_velocity * t + x, goal_velocity + w * v, -w * w * (2 * z * v + x)};
      },
      -endless, endless);
}

}  // namespace tweenfall
