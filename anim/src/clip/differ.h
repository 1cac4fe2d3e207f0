#pragma once

// Whether two values of a curve differ by more than rounding.

#include <tweenfall/curves/color.h>
#include <tweenfall/curves/rotation.h>

#include <string>

namespace tweenfall::clips {

inline bool differ(double a, double b) {
  return (a - b) * (a - b) > 1e-18 * (1 + a * a);
}
template <int size, int options>
bool differ(const Eigen::Matrix<double, size, 1, options>& a, const Eigen::Matrix<double, size, 1, options>& b) {
  return (a - b).squaredNorm() > 1e-18 * (1 + a.squaredNorm());
}
inline bool differ(const Color& a, const Color& b) {
  return differ(a.rgba, b.rgba);
}
inline bool differ(const Quat& a, const Quat& b) {
  return (hemisphere_aligned(a, b).coeffs() - b.coeffs()).squaredNorm() > 1e-18;
}
inline bool differ(bool a, bool b) {
  return a != b;
}
inline bool differ(const std::string& a, const std::string& b) {
  return a != b;
}

}  // namespace tweenfall::clips
