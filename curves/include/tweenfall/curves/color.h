#pragma once

/// Color spaces in which colors can be mixed, and the way there and back with exact rates.
///
/// A `Color` is linear Rec. 709 with straight alpha. Mixing happens on premultiplied
/// coordinates of the chosen space; hue, where there is one, is not premultiplied. A color that has no hue, being gray
/// or invisible, takes that of the color it is mixed with.

#include <tweenfall/curves/values.h>

namespace tweenfall {

/// The spaces and their coordinates. Colors outside the gamut keep their coordinates: nothing is clipped.
enum class ColorSpace {
  linear,  ///< red, green, blue, proportional to light
  srgb,    ///< red, green, blue as in files, 0 to 1; odd below zero
  oklab,   ///< lightness 0 to 1, a, b. Source: Ottosson, "A perceptual color space for image processing", 2020
  oklch,   ///< lightness, chroma, hue in radians
  hsl,     ///< hue in radians, saturation, lightness 0 to 1
  hsv,     ///< hue in radians, saturation, value 0 to 1
  hwb,     ///< hue in radians, whiteness, blackness 0 to 1
  lab,     ///< CIE lightness 0 to 100, a, b, for white D50. Source: W3C, "CSS Color Module Level 4", 10
  lch,     ///< lightness 0 to 100, chroma, hue in radians
};

/// Which way around the hue goes between two colors. Source: W3C, "CSS Color Module Level 4", 12.4.
enum class HueRule { shorter, longer, increasing, decreasing };

/// Index of the coordinate that is a hue, or -1. It is an angle: not premultiplied, and arbitrary for grays.
[[nodiscard]] int hue_index(ColorSpace space) noexcept;

/// Whether coordinates in `space` have a hue: a gray has none, and in a space without a hue no color has one.
[[nodiscard]] bool has_hue(const Vec4& coordinates, ColorSpace space) noexcept;

/// Coordinates of a color in `space`, alpha last, not premultiplied.
/// The hue of a gray is 0.
[[nodiscard]] Vec4 to_space(const Color& color, ColorSpace space) noexcept;

/// The same with first and second derivatives carried along.
[[nodiscard]] Sample<Vec4> to_space(const Sample<Color>& color, ColorSpace space) noexcept;

/// Back to a linear color, with first and second derivatives of the coordinates carried along.
[[nodiscard]] Sample<Color> from_space(const Sample<Vec4>& coordinates, ColorSpace space) noexcept;

/// Whether a screen with Rec. 709 primaries can show the color: red, green and blue lie in 0 to 1.
[[nodiscard]] bool in_gamut(const Color& color, double tolerance = 0) noexcept;

/// Every part, alpha too, brought to the nearer end of 0 to 1. Cheap; shifts hue and lightness.
[[nodiscard]] Color clipped(const Color& color) noexcept;

/// The color with its chroma reduced until clipping makes a difference that is just not noticeable; lightness and hue
/// are kept but for that difference. The result is in gamut; a color that is in gamut already is returned unchanged.
/// Source: W3C, "CSS Color Module Level 4", 13.2.
[[nodiscard]] Color reduced_chroma(const Color& color) noexcept;

}  // namespace tweenfall
