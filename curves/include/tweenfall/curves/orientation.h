#pragma once

/// The orientation of a body in each of the usual representations, and its advance by an angular velocity.
///
/// In a plane: an angle, a matrix of two rows, or a complex number of length 1. In space: a rotation vector (axis times
/// angle), a matrix of three rows, or a unit quaternion. `turned` advances each exactly by a constant angular velocity;
/// `turned_to_first_order` is the plain step x + x' dt, which leaves the set of rotations a little each time.
/// `drift` measures how far products and plain steps have left it, and `renormalized` leads back. The rest of the
/// library stores quaternions.
///
/// Angles are in radians, angular velocities in rad/s, in space about the axes that the rotation maps into ("world").

#include <tweenfall/curves/rotation.h>

namespace tweenfall {

using Mat2 = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;

/// cos a + i sin a.
struct UnitComplex {
  double real = 1, imaginary = 0;

  bool operator==(const UnitComplex&) const = default;
};
/// b applied first, then a.
[[nodiscard]] constexpr UnitComplex operator*(const UnitComplex& a, const UnitComplex& b) noexcept {
  return {a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real};
}
[[nodiscard]] inline Vec2 operator*(const UnitComplex& a, const Vec2& v) noexcept {
  return {a.real * v.x() - a.imaginary * v.y(), a.imaginary * v.x() + a.real * v.y()};
}

// In a plane

/// The same direction between -pi and pi.
[[nodiscard]] double wrapped(double angle) noexcept;
[[nodiscard]] UnitComplex complex_of(double angle) noexcept;
[[nodiscard]] UnitComplex complex_of(const Mat2& matrix) noexcept;  ///< of its first column
[[nodiscard]] Mat2 matrix_of(double angle) noexcept;
[[nodiscard]] Mat2 matrix_of(const UnitComplex& complex) noexcept;
[[nodiscard]] double angle_of(const UnitComplex& complex) noexcept;  ///< -pi to pi, of any length but 0
[[nodiscard]] double angle_of(const Mat2& matrix) noexcept;          ///< of its first column

[[nodiscard]] double turned(double angle, double rate, double dt) noexcept;  ///< wrapped
[[nodiscard]] Mat2 turned(const Mat2& matrix, double rate, double dt) noexcept;
[[nodiscard]] UnitComplex turned(const UnitComplex& complex, double rate, double dt) noexcept;

/// Turns by atan(rate dt), and grows by sqrt(1 + (rate dt)^2).
[[nodiscard]] Mat2 turned_to_first_order(const Mat2& matrix, double rate, double dt) noexcept;
[[nodiscard]] UnitComplex turned_to_first_order(const UnitComplex& complex, double rate, double dt) noexcept;

/// Its first column scaled to unit length, the second perpendicular to it.
/// @throws std::invalid_argument where that column has no direction
[[nodiscard]] Mat2 renormalized(const Mat2& matrix);
/// @throws std::invalid_argument for 0 and what is not finite
[[nodiscard]] UnitComplex renormalized(const UnitComplex& complex);

/// How far from a rotation: the greatest element of M^T M - 1 for matrices, the length minus 1 for complex numbers.
[[nodiscard]] double drift(const Mat2& matrix) noexcept;
[[nodiscard]] double drift(const UnitComplex& complex) noexcept;

// In space; `exp_map` and `log_map` take rotation vectors to quaternions and back

/// The same rotation by a vector no longer than pi.
[[nodiscard]] Vec3 wrapped(const Vec3& rotation_vector) noexcept;
/// Source: Rodrigues' formula, as in the lecture's table of a rotation about an axis.
[[nodiscard]] Mat3 matrix_of(const Vec3& rotation_vector) noexcept;
[[nodiscard]] Mat3 matrix_of(const Quat& rotation) noexcept;
/// For a matrix that is a rotation up to a little drift; of unit length.
/// Source: Shepperd, "Quaternion from rotation matrix", 1978: from the largest of the four, so that no digit is lost.
[[nodiscard]] Quat quaternion_of(const Mat3& matrix) noexcept;
[[nodiscard]] Vec3 rotation_vector_of(const Mat3& matrix) noexcept;

[[nodiscard]] Vec3 turned(const Vec3& rotation_vector, const Vec3& angular_velocity, double dt) noexcept;  ///< wrapped
[[nodiscard]] Mat3 turned(const Mat3& matrix, const Vec3& angular_velocity, double dt) noexcept;
[[nodiscard]] Quat turned(const Quat& rotation, const Vec3& angular_velocity, double dt) noexcept;

/// The vector plus w dt: right only while the axis stays the same.
[[nodiscard]] Vec3 turned_to_first_order(const Vec3& rotation_vector, const Vec3& angular_velocity, double dt) noexcept;
/// M + w x M dt.
[[nodiscard]] Mat3 turned_to_first_order(const Mat3& matrix, const Vec3& angular_velocity, double dt) noexcept;
/// q + (0, w) q dt / 2: turns by 2 atan(|w| dt / 2), and grows by sqrt(1 + (|w| dt / 2)^2).
[[nodiscard]] Quat turned_to_first_order(const Quat& rotation, const Vec3& angular_velocity, double dt) noexcept;

/// The first column scaled to unit length, the second perpendicular to it, the third to both (Gram-Schmidt).
/// Quaternions: `normalized`.
/// @throws std::invalid_argument where the columns have no directions
[[nodiscard]] Mat3 renormalized(const Mat3& matrix);

[[nodiscard]] double drift(const Mat3& matrix) noexcept;
[[nodiscard]] double drift(const Quat& rotation) noexcept;

}  // namespace tweenfall
