#include <tweenfall/curves/functions.h>

#include <limits>
#include <stdexcept>

#include "curve/components.h"

namespace tweenfall {

Curve<Vec3> projectile(const Projectile& p) {
  if (!spans::all_finite(p.from) || !spans::all_finite(p.velocity) || !spans::all_finite(p.gravity))
    throw std::invalid_argument("a projectile needs finite numbers; it has from " + spans::text_of(p.from) +
                                ", velocity " + spans::text_of(p.velocity) + ", gravity " + spans::text_of(p.gravity));
  constexpr double endless = std::numeric_limits<double>::infinity();
  return Curve<Vec3>(
      [p](double t, Side) {
        return Sample<Vec3>{p.from + t * (p.velocity + (0.5 * t) * p.gravity), p.velocity + t * p.gravity, p.gravity};
      },
      -endless, endless);
}

}  // namespace tweenfall
