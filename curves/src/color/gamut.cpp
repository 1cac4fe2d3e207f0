#include <tweenfall/curves/color.h>

#include <algorithm>
#include <cmath>

namespace tweenfall {

bool in_gamut(const Color& color, double tolerance) noexcept {
  for (int i = 0; i < 3; ++i)
    if (!(color.rgba[i] >= -tolerance && color.rgba[i] <= 1 + tolerance)) return false;
  return true;
}

Color clipped(const Color& color) noexcept {
  Color result = color;
  for (int i = 0; i < 4; ++i) result.rgba[i] = std::clamp(result.rgba[i], 0.0, 1.0);
  return result;
}

Color reduced_chroma(const Color& color) noexcept {
  if (in_gamut(color)) return clipped(color);
  const Vec4 rest(0, 0, 0, 0);
  const double alpha = std::clamp(color.rgba[3], 0.0, 1.0);
  Vec4 polar = to_space(color, ColorSpace::oklch);
  if (polar[0] >= 1) return {Vec4(1, 1, 1, alpha)};
  if (polar[0] <= 0) return {Vec4(0, 0, 0, alpha)};
  constexpr double just_noticed = 0.02, fine = 1e-4;
  const auto difference = [](const Color& a, const Color& b) {
    const Vec4 d = to_space(a, ColorSpace::oklab) - to_space(b, ColorSpace::oklab);
    return std::sqrt(d.head<3>().squaredNorm());
  };
  Color shown = clipped(color);
  if (difference(shown, color) < just_noticed) return shown;
  double low = 0, high = polar[1];
  bool low_is_in = true;
  while (high - low > fine) {
    polar[1] = (low + high) / 2;
    const Color current = from_space({polar, rest, rest}, ColorSpace::oklch).value;
    if (low_is_in && in_gamut(current)) {
      low = polar[1];
      continue;
    }
    shown = clipped(current);
    const double missed = difference(shown, current);
    if (missed >= just_noticed) {
      high = polar[1];
    } else {
      if (just_noticed - missed < fine) return shown;
      low_is_in = false;
      low = polar[1];
    }
  }
  return shown;
}

}  // namespace tweenfall
