#pragma once

/// Blending what a track drives beside poses: numbers, vectors, rotations and colors, as user tracks, morph weights and
/// lights have them. The same rules as of poses (`blend.h`), and accelerations too.
///
/// `T` is double, Vec2, Vec3, Vec4, Quat or Color. Colors are mixed on premultiplied coordinates of light, or of the
/// space given.

#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/color.h>

#include <span>

namespace tweenfall {

/// From `a` (weight 0) to `b` (weight 1), rotations the short way.
template <class T>
[[nodiscard]] Sample<T> cross_fade(const Sample<T>& a, const Sample<T>& b, const Sample<double>& weight) noexcept;
[[nodiscard]] Sample<Color> cross_fade(const Sample<Color>& a, const Sample<Color>& b, const Sample<double>& weight,
                                       ColorSpace space) noexcept;

/// `base + weight (pose - reference)`: numbers and vectors; of rotations R (R_ref^-1 R_pose)^w; colors on straight
/// light and alpha.
template <class T>
[[nodiscard]] Sample<T> add_difference(const Sample<T>& base, const Sample<T>& reference, const Sample<T>& value,
                                       const Sample<double>& weight) noexcept;

/// The weighted mean: weights are divided by their sum, and where that is less than `least`, `rest` fills it up.
/// @param weights  one for each value, >= 0; negative ones count as 0
template <class T>
[[nodiscard]] Sample<T> blend(std::span<const Sample<T>> values, std::span<const Sample<double>> weights,
                              const Sample<T>& rest, double least = least_weight) noexcept;

}  // namespace tweenfall
