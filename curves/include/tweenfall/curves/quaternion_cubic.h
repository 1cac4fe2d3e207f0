#pragma once

/// Rotations as glTF's CUBICSPLINE means them: each of the four parts of the quaternion is a Hermite cubic
/// in seconds, and the result is scaled to unit length. The rate is the exact angular velocity of that.

#include <tweenfall/curves/curve.h>

#include <span>

namespace tweenfall {

/// @param times         s, strictly increasing, one a key
/// @param in_tangents   (x, y, z, w) rates per second arriving at each key; the first is not used
/// @param values        (x, y, z, w), as in the file: neither aligned nor normalized beforehand
/// @param out_tangents  rates per second leaving each key; the last is not used
/// @throws std::invalid_argument naming the key: no keys, sizes that differ, times out of order, non-finite numbers,
///         a zero quaternion.
/// Source: Khronos, "glTF 2.0 Specification", appendix C.5.
[[nodiscard]] Curve<Quat> gltf_cubic_rotation(std::span<const double> times, std::span<const Vec4> in_tangents,
                                              std::span<const Vec4> values, std::span<const Vec4> out_tangents);

}  // namespace tweenfall
