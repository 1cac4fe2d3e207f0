#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/spring_response.h>

#include <cmath>

namespace tweenfall::formulas {
namespace {

// sinh(x) / x and cosh(x) for |x| < 1, where the difference of two exponentials would cancel.
double sinh_ratio(double x) noexcept {
  const double q = x * x;
  double sum = 1;
  for (int n = 18; n >= 2; n -= 2) sum = 1 + sum * q / (n * (n + 1));
  return sum;
}

double cosh_series(double x) noexcept {
  const double q = x * x;
  double sum = 1;
  for (int n = 18; n >= 2; n -= 2) sum = 1 + sum * q / (n * (n - 1));
  return sum;
}

}  // namespace
}  // namespace tweenfall::formulas

namespace tweenfall {

SpringResponse spring_response(double phase, double z) noexcept {
  if (z < 1) {
    const double d = std::sqrt((1 - z) * (1 + z));
    const elementary::SinCos turn = elementary::sin_cos(d * phase);
    const double e = elementary::exp(-z * phase);
    // sin(d p)/d tends to p where the damping is nearly critical.
    const double k = std::abs(d * phase) < 1e-8 ? phase : turn.sin / d;
    return {e * (turn.cos + z * k), e * k};
  }
  const double d = std::sqrt((z - 1) * (z + 1));
  if (std::abs(d * phase) < 1) {
    const double e = elementary::exp(-z * phase), k = phase * formulas::sinh_ratio(d * phase);
    return {e * (formulas::cosh_series(d * phase) + z * k), e * k};
  }
  // The slow root from its product with the fast one, which avoids cancellation.
  const double fast = z + d, slow = 1 / fast;
  const double es = elementary::exp(-slow * phase), ef = elementary::exp(-fast * phase);
  return {(fast * es - slow * ef) / (2 * d), (es - ef) / (2 * d)};
}

}  // namespace tweenfall
