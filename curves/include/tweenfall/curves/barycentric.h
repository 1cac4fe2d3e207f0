#pragma once

/// Mixing by weights: three values at the corners of a triangle, or any number of them.
///
/// The weights are divided by their sum, so that they always add up to 1: where all values are equal the mix is that
/// value, and moving, turning or scaling all values does the same to the mix. Weights may be negative, to reach beyond
/// the values. Where only one weight is not zero, the mix is its value, bit for bit. Values and weights carry their
/// rates, and the rates of the mix are exact, including the part that comes from moving weights.

#include <tweenfall/curves/color.h>
#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/pose.h>

#include <array>
#include <span>

namespace tweenfall {

/// The weighted mean of numbers, vectors (`T` is double, Vec2, Vec3 or Vec4) or rotations (Quat).
///
/// For rotations it is the rotation from which the weighted rotation vectors to all of them sum to zero: for two it is
/// their slerp, and the order does not matter. It is unique while all lie within a quarter turn of a single rotation.
///
/// @throws std::invalid_argument: no values, sizes that differ, weights that sum to zero or are not finite.
/// Source for rotations: Karcher, "Riemannian center of mass and mollifier smoothing", 1977.
template <class T>
[[nodiscard]] Sample<T> barycentric(std::span<const Sample<T>> values, std::span<const Sample<double>> weights);

/// Colors, mixed in `space` on premultiplied coordinates. Hues are mixed as numbers, each taken within half a turn of
/// the hue of the first color that has one; grays and invisible colors do not affect the hue.
[[nodiscard]] Sample<Color> barycentric(std::span<const Sample<Color>> values, std::span<const Sample<double>> weights,
                                        ColorSpace space = ColorSpace::oklab);

/// Motions: positions and scales as vectors, rotations as rotations. Accelerations of the weights are not read.
[[nodiscard]] Motion barycentric(std::span<const Motion> values, std::span<const Sample<double>> weights);

/// How many curves a curve mixes at most.
inline constexpr std::size_t most_mixed_curves = 32;

/// Curves mixed over time by weights that are curves too. Each continues by its own rule where it ends, so the mix is
/// endless; its rates take those of values and weights into account, and its knots are the knots of all of them. While
/// the weights sum to zero, all values count the same.
/// @throws std::invalid_argument: no curves, more than `most_mixed_curves`, or not a weight for each.
template <class T>
[[nodiscard]] Curve<T> barycentric_curve(std::span<const Curve<T>> values, std::span<const Curve<double>> weights);
[[nodiscard]] Curve<Color> barycentric_curve(std::span<const Curve<Color>> values,
                                             std::span<const Curve<double>> weights,
                                             ColorSpace space = ColorSpace::oklab);

/// The weights of three corners whose mix is `point`, or the point of their plane nearest to it.
/// A corner has the weights 1, 0, 0, exactly; inside the triangle all are positive.
/// @param point    value, rate and acceleration of a moving point
/// @param a, b, c  corners, in any unit
/// @throws std::invalid_argument where the corners lie on one line.
[[nodiscard]] std::array<Sample<double>, 3> triangle_weights(const Sample<Vec3>& point, const Vec3& a, const Vec3& b,
                                                             const Vec3& c);

}  // namespace tweenfall
