#include <tweenfall/curves/elementary.h>

#include <cmath>

namespace tweenfall::elementary {
namespace {

// sinh(x) / x from its series, for |x| <= 1; what is left out is below 1e-17.
double sinh_ratio(double x) noexcept {
  const double z = x * x;
  double sum = 1;
  for (int k = 18; k >= 2; k -= 2) sum = 1 + z / (k * (k + 1)) * sum;
  return sum;
}

}  // namespace

double sinh(double x) noexcept {
  const double size = std::abs(x);
  if (size <= 1) return x * sinh_ratio(x);
  if (size > 709) {
    const double half = exp(0.5 * size);
    return std::copysign(0.5 * half * half, x);
  }
  const double grown = exp(size);
  return std::copysign(0.5 * (grown - 1 / grown), x);
}

double cosh(double x) noexcept {
  const double size = std::abs(x);
  if (size > 709) {
    const double half = exp(0.5 * size);
    return 0.5 * half * half;
  }
  const double grown = exp(size);
  return 0.5 * (grown + 1 / grown);
}

double tanh(double x) noexcept {
  const double size = std::abs(x);
  if (size <= 1) return sinh(x) / cosh(x);
  if (size > 22) return std::copysign(1, x);
  return std::copysign(1 - 2 / (exp(2 * size) + 1), x);
}

double asinh(double x) noexcept {
  const double size = std::abs(x);
  if (size > 1e8) return std::copysign(log(size) + 0x1.62e42fefa39efp-1, x);
  if (size > 0.5) return std::copysign(log(size + std::sqrt(size * size + 1)), x);
  double y = x * (1 - x * x / 6);
  for (int i = 0; i < 3; ++i) y -= (sinh(y) - x) / cosh(y);
  return y;
}

}  // namespace tweenfall::elementary
