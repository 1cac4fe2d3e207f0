#pragma once

/// Blending values other than poses that tracks drive: numbers, vectors, rotations and colors, as in user tracks, morph
/// weights and lights. By the same rules as poses (`blend.h`), with accelerations too.
///
/// `T` is double, Vec2, Vec3, Vec4, Quat or Color. Colors are mixed on premultiplied coordinates of linear light, or of
/// the given space.

#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/color.h>

#include <span>

namespace tweenfall {

/// From `a` (weight 0) to `b` (weight 1), rotations the short way.
template <class T>
[[nodiscard]] Sample<T> cross_fade(const Sample<T>& a, const Sample<T>& b, const Sample<double>& weight) noexcept;
[[nodiscard]] Sample<Color> cross_fade(const Sample<Color>& a, const Sample<Color>& b, const Sample<double>& weight,
                                       ColorSpace space) noexcept;

/// `base + weight (pose - reference)`: for numbers and vectors; R (R_ref^-1 R_pose)^w for rotations; colors on linear
/// light and alpha, not premultiplied.
template <class T>
[[nodiscard]] Sample<T> add_difference(const Sample<T>& base, const Sample<T>& reference, const Sample<T>& value,
                                       const Sample<double>& weight) noexcept;

/// The weighted mean: weights are divided by their sum; where that is below `least`, `rest` gets the missing weight.
/// @param weights  one for each value, >= 0; negative ones count as 0
template <class T>
[[nodiscard]] Sample<T> blend(std::span<const Sample<T>> values, std::span<const Sample<double>> weights,
                              const Sample<T>& rest, double least = least_weight) noexcept;

}  // namespace tweenfall
