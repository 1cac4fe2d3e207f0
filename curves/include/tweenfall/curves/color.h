#pragma once

/// Color spaces in which colors can be mixed, and the way there and back with exact rates.
///
/// A `Color` is linear Rec. 709 with straight alpha. Mixing happens on premultiplied
/// coordinates of the chosen space; hue, where there is one, is not premultiplied.

#include <tweenfall/curves/values.h>

namespace tweenfall {

enum class ColorSpace { linear, srgb, oklab };

/// Coordinates of a color in `space`, alpha last, not premultiplied.
[[nodiscard]] Vec4 to_space(const Color& color, ColorSpace space) noexcept;

/// Back to a linear color, with first and second derivatives of the coordinates carried along.
[[nodiscard]] Sample<Color> from_space(const Sample<Vec4>& coordinates, ColorSpace space) noexcept;

}  // namespace tweenfall
