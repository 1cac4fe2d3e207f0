#include <tweenfall/curves/color.h>

#include "color/color_spaces.h"

namespace tweenfall::color_spaces {
namespace {

using color_spaces::Triple;

// With less chroma than this the hue of a color is noise: rounding of the matrices leaves a trace of it in grays.
constexpr double oklab_gray = 4e-6, lab_gray = 1.5e-3;

Triple to_coordinates(const Triple& linear, ColorSpace space) noexcept {
  switch (space) {
    case ColorSpace::linear:
      return linear;
    case ColorSpace::srgb:
      return color_spaces::to_srgb(linear);
    case ColorSpace::oklab:
      return color_spaces::to_oklab(linear);
    case ColorSpace::oklch:
      return color_spaces::to_polar(color_spaces::to_oklab(linear), oklab_gray);
    case ColorSpace::hsl:
      return color_spaces::srgb_to_hsl(color_spaces::to_srgb(linear));
    case ColorSpace::hsv:
      return color_spaces::srgb_to_hsv(color_spaces::to_srgb(linear));
    case ColorSpace::hwb:
      return color_spaces::srgb_to_hwb(color_spaces::to_srgb(linear));
    case ColorSpace::lab:
      return color_spaces::to_lab(linear);
    case ColorSpace::lch:
      return color_spaces::to_polar(color_spaces::to_lab(linear), lab_gray);
  }
  return linear;
}

Triple to_linear(const Triple& c, ColorSpace space) noexcept {
  switch (space) {
    case ColorSpace::linear:
      return c;
    case ColorSpace::srgb:
      return color_spaces::from_srgb(c);
    case ColorSpace::oklab:
      return color_spaces::from_oklab(c);
    case ColorSpace::oklch:
      return color_spaces::from_oklab(color_spaces::from_polar(c));
    case ColorSpace::hsl:
      return color_spaces::from_srgb(color_spaces::hsl_to_srgb(c));
    case ColorSpace::hsv:
      return color_spaces::from_srgb(color_spaces::hsv_to_srgb(c));
    case ColorSpace::hwb:
      return color_spaces::from_srgb(color_spaces::hwb_to_srgb(c));
    case ColorSpace::lab:
      return color_spaces::from_lab(c);
    case ColorSpace::lch:
      return color_spaces::from_lab(color_spaces::from_polar(c));
  }
  return c;
}

Triple triple(const Vec4& value, const Vec4& rate, const Vec4& acceleration) noexcept {
  return {math::Jet{value[0], rate[0], acceleration[0]}, math::Jet{value[1], rate[1], acceleration[1]},
          math::Jet{value[2], rate[2], acceleration[2]}};
}

Sample<Vec4> sample_of(const Triple& c, double alpha, double alpha_rate, double alpha_acceleration) noexcept {
  return {Vec4(c[0].v, c[1].v, c[2].v, alpha), Vec4(c[0].d, c[1].d, c[2].d, alpha_rate),
          Vec4(c[0].dd, c[1].dd, c[2].dd, alpha_acceleration)};
}

}  // namespace
}  // namespace tweenfall::color_spaces

namespace tweenfall {

int hue_index(ColorSpace space) noexcept {
  if (space == ColorSpace::hsl || space == ColorSpace::hsv || space == ColorSpace::hwb) return 0;
  return space == ColorSpace::oklch || space == ColorSpace::lch ? 2 : -1;
}

bool has_hue(const Vec4& coordinates, ColorSpace space) noexcept {
  if (hue_index(space) < 0) return false;
  // A gray's whiteness and blackness sum to 1 but for rounding.
  if (space == ColorSpace::hwb) return coordinates[1] + coordinates[2] < 1 - 1e-9;
  return coordinates[1] > (space == ColorSpace::oklch ? color_spaces::oklab_gray
                           : space == ColorSpace::lch ? color_spaces::lab_gray
                                                      : 0);
}

Vec4 to_space(const Color& color, ColorSpace space) noexcept {
  return to_space(Sample<Color>{color, Vec4::Zero(), Vec4::Zero()}, space).value;
}

Sample<Vec4> to_space(const Sample<Color>& color, ColorSpace space) noexcept {
  const color_spaces::Triple c =
      color_spaces::to_coordinates(color_spaces::triple(color.value.rgba, color.rate, color.acceleration), space);
  return color_spaces::sample_of(c, color.value.rgba[3], color.rate[3], color.acceleration[3]);
}

Sample<Color> from_space(const Sample<Vec4>& s, ColorSpace space) noexcept {
  const color_spaces::Triple c = color_spaces::to_linear(color_spaces::triple(s.value, s.rate, s.acceleration), space);
  const Sample<Vec4> linear = color_spaces::sample_of(c, s.value[3], s.rate[3], s.acceleration[3]);
  return {Color{linear.value}, linear.rate, linear.acceleration};
}

}  // namespace tweenfall
