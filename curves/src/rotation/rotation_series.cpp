#include "rotation/rotation_series.h"

#include <tweenfall/curves/elementary.h>

#include <cmath>

namespace tweenfall::rotations {

RotationSeries::RotationSeries(double x) noexcept {
  if (x < series_limit) {
    a = series_a(x);
    b = series_b(x);
    a1 = 2 * (-1.0 / 24 + x * (2.0 / 720 - x * (3.0 / 40320 - x * (4.0 / 3628800 - x * (5.0 / 479001600 -
                                                                                        x * (6.0 / 87178291200.0))))));
    b1 = 2 * (-1.0 / 120 +
              x * (2.0 / 5040 -
                   x * (3.0 / 362880 - x * (4.0 / 39916800 - x * (5.0 / 6227020800.0 - x * (6.0 / 1307674368000.0))))));
    return;
  }
  const double t = std::sqrt(x);
  const elementary::SinCos sc = elementary::sin_cos(t);
  a = (1 - sc.cos) / x;
  b = (t - sc.sin) / (x * t);
  a1 = (t * sc.sin - 2 * (1 - sc.cos)) / (x * x);
  b1 = (t * (1 - sc.cos) - 3 * (t - sc.sin)) / (x * x * t);
}

double inverse_jacobian_coefficient(double x) noexcept {
  if (x < 0.05) {
    // Bernoulli numbers: the series of 1 - (t/2) cot(t/2), divided by t^2.
    return 1.0 / 12 + x * (1.0 / 720 + x * (1.0 / 30240 + x * (1.0 / 1209600 +
                                                               x * (1.0 / 47900160 + x * (691.0 / 1307674368000.0)))));
  }
  const double t = std::sqrt(x);
  const elementary::SinCos half = elementary::sin_cos(t / 2);
  return (1 - 0.5 * t * half.cos / half.sin) / x;
}

}  // namespace tweenfall::rotations
