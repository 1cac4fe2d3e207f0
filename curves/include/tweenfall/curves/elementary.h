#pragma once

/// Sine, cosine, exponential and their relatives that return the same bits everywhere.
///
/// The C library's versions differ between machines and compilers in the last place; these
/// use only additions, multiplications, divisions and square roots, which IEEE 754 fixes.
/// Each is within about one unit in the last place of the true value over its stated range.

namespace tweenfall::elementary {

struct SinCos {
  double sin, cos;
};

[[nodiscard]] double sin(double x) noexcept;              ///< x in radians, any finite number; NaN for infinities
[[nodiscard]] double cos(double x) noexcept;              ///< x in radians, any finite number; NaN for infinities
[[nodiscard]] SinCos sin_cos(double x) noexcept;          ///< both at once
[[nodiscard]] double tan(double x) noexcept;              ///< x in radians, any finite number; NaN for infinities
[[nodiscard]] double atan(double x) noexcept;             ///< -pi/2 to pi/2
[[nodiscard]] double atan2(double y, double x) noexcept;  ///< -pi to pi; 0 for (0, 0)
[[nodiscard]] double asin(double x) noexcept;             ///< argument clamped to -1..1
[[nodiscard]] double acos(double x) noexcept;             ///< argument clamped to -1..1
[[nodiscard]] double exp(double x) noexcept;
[[nodiscard]] double log(double x) noexcept;            ///< x > 0
[[nodiscard]] double pow(double x, double y) noexcept;  ///< x >= 0
[[nodiscard]] double cbrt(double x) noexcept;
[[nodiscard]] double sinh(double x) noexcept;
[[nodiscard]] double cosh(double x) noexcept;
[[nodiscard]] double tanh(double x) noexcept;
[[nodiscard]] double asinh(double x) noexcept;

}  // namespace tweenfall::elementary
