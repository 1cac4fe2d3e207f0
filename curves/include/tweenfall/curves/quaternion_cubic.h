#pragma once

/// Rotation curves made from something other than keys with eases: from quaternion tangents as in glTF's CUBICSPLINE,
/// from control rotations in place of a Bezier curve's control points, and from rotations alone, passed with continuous
/// angular acceleration. Rates are exact in each.

#include <tweenfall/curves/curve.h>

#include <optional>
#include <span>

namespace tweenfall {

/// Each of the four parts of the quaternion is a Hermite cubic in seconds, and the result is scaled to unit length.
///
/// @param times         s, strictly increasing, one per key
/// @param in_tangents   (x, y, z, w) rates per second arriving at each key; the first is not used
/// @param values        (x, y, z, w), as in the file: neither aligned nor normalized beforehand
/// @param out_tangents  rates per second leaving each key; the last is not used
/// @throws std::invalid_argument naming the key: no keys, sizes that differ, times out of order, non-finite numbers,
///         a zero quaternion.
/// Source: Khronos, "glTF 2.0 Specification", appendix C.5.
[[nodiscard]] Curve<Quat> gltf_cubic_rotation(std::span<const double> times, std::span<const Vec4> in_tangents,
                                              std::span<const Vec4> values, std::span<const Vec4> out_tangents);

/// De Casteljau's algorithm with slerps: from control 0 to control 3 in the first span, 3 to 6 in the second, ...
/// It leaves control 0 at three times the rotation from there to control 1, per duration. Each control is reached from
/// the one before by the shorter way.
///
/// @param times     s, strictly increasing, n of them
/// @param controls  3 n - 2 rotations; need not be normalized
/// @throws std::invalid_argument naming the key: no keys, times out of order, sizes that do not fit, a zero quaternion.
/// Source: Shoemake, "Animating rotation with quaternion curves", 1985.
[[nodiscard]] Curve<Quat> bezier_rotation(std::span<const double> times, std::span<const Quat> controls);

/// Passes through the rotations by the shorter ways with continuous angular velocity and acceleration: as keys with the
/// ease `natural` do, but with the angular velocities at both ends given.
///
/// @param times       s, strictly increasing
/// @param rotations   one per time; need not be normalized
/// @param start, end  angular velocities, rad/s, outer axes; absent: the mean one of the first or last span
/// @throws std::invalid_argument naming the key: no keys, times out of order, sizes that differ, a zero quaternion,
///         a non-finite velocity.
/// Source: Mayorov, "Smooth attitude interpolation", 2018.
[[nodiscard]] Curve<Quat> clamped_rotation(std::span<const double> times, std::span<const Quat> rotations,
                                           const std::optional<Vec3>& start = {}, const std::optional<Vec3>& end = {});

}  // namespace tweenfall
