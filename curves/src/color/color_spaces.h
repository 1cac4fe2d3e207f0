#pragma once

// One file per color space: its three coordinates to and from linear ones, on numbers that carry their derivatives.

#include <array>

#include "math/jet.h"

namespace tweenfall::color_spaces {

using Triple = std::array<math::Jet, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;

[[nodiscard]] constexpr Triple multiplied(const Matrix& m, const Triple& v) noexcept {
  Triple r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = v[0] * m[i][0] + v[1] * m[i][1] + v[2] * m[i][2];
  return r;
}

[[nodiscard]] constexpr Matrix multiplied(const Matrix& a, const Matrix& b) noexcept {
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) r[i][k] = a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k];
  return r;
}

[[nodiscard]] constexpr Matrix inverted(const Matrix& m) noexcept {
  Matrix r{};
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      r[i][k] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / determinant;
    }
  return r;
}

// To the space from linear red, green and blue, and back.
[[nodiscard]] Triple to_srgb(const Triple& linear) noexcept;
[[nodiscard]] Triple from_srgb(const Triple& srgb) noexcept;
[[nodiscard]] Triple to_oklab(const Triple& linear) noexcept;
[[nodiscard]] Triple from_oklab(const Triple& oklab) noexcept;
[[nodiscard]] Triple to_lab(const Triple& linear) noexcept;
[[nodiscard]] Triple from_lab(const Triple& lab) noexcept;

// Hue in radians (0 for a gray), least and largest of encoded red, green and blue, and the distance between these
// (exactly 0 for a gray): the three spaces below are made of them.
struct Hexcone {
  math::Jet hue, low, high, range;
};
[[nodiscard]] Hexcone hexcone(const Triple& srgb) noexcept;

// The color of a hue whose smallest part is 0 and whose largest part is 1.
[[nodiscard]] Triple pure_hue(const math::Jet& hue) noexcept;

// Hue, saturation and lightness; hue, saturation and value; hue, whiteness and blackness.
[[nodiscard]] Triple srgb_to_hsl(const Triple& srgb) noexcept;
[[nodiscard]] Triple hsl_to_srgb(const Triple& hsl) noexcept;
[[nodiscard]] Triple srgb_to_hsv(const Triple& srgb) noexcept;
[[nodiscard]] Triple hsv_to_srgb(const Triple& hsv) noexcept;
[[nodiscard]] Triple srgb_to_hwb(const Triple& srgb) noexcept;
[[nodiscard]] Triple hwb_to_srgb(const Triple& hwb) noexcept;

// The plane of the second and third coordinate in polar form. A chroma below `gray` counts as zero.
[[nodiscard]] Triple to_polar(const Triple& plane, double gray) noexcept;
[[nodiscard]] Triple from_polar(const Triple& polar) noexcept;

}  // namespace tweenfall::color_spaces
