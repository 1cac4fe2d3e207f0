#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/orientation.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "math/cross_matrix.h"

namespace tweenfall {

Vec3 wrapped(const Vec3& rotation_vector) noexcept {
  const double angle = rotation_vector.norm();
  if (angle <= std::numbers::pi) return rotation_vector;
  if (!std::isfinite(angle)) return log_map(exp_map(rotation_vector));
  return std::remainder(angle, 2 * std::numbers::pi) / angle * rotation_vector;
}

Mat3 matrix_of(const Vec3& rotation_vector) noexcept {
  const double angle = rotation_vector.norm();
  if (!(angle > 0)) return Mat3::Identity();
  if (!std::isfinite(angle)) return matrix_of(exp_map(rotation_vector));
  const Vec3 n = rotation_vector / angle;
  const auto [s, c] = elementary::sin_cos(angle);
  const double rest = 1 - c;
  Mat3 matrix;
  matrix << n.x() * n.x() * rest + c, n.x() * n.y() * rest - n.z() * s, n.x() * n.z() * rest + n.y() * s,
      n.x() * n.y() * rest + n.z() * s, n.y() * n.y() * rest + c, n.y() * n.z() * rest - n.x() * s,
      n.x() * n.z() * rest - n.y() * s, n.y() * n.z() * rest + n.x() * s, n.z() * n.z() * rest + c;
  return matrix;
}

Mat3 matrix_of(const Quat& rotation) noexcept {
  return rotation.toRotationMatrix();
}

Quat quaternion_of(const Mat3& m) noexcept {
  const double trace = m.trace();
  int most = 0;
  for (int i = 1; i < 3; ++i)
    if (m(i, i) > m(most, most)) most = i;
  double w = 0;
  Vec3 v;
  if (trace > m(most, most)) {
    w = 1 + trace;
    v = Vec3(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
  } else {
    const int j = (most + 1) % 3, k = (most + 2) % 3;
    w = m(k, j) - m(j, k);
    v[most] = 1 + m(most, most) - m(j, j) - m(k, k);
    v[j] = m(j, most) + m(most, j);
    v[k] = m(k, most) + m(most, k);
  }
  const double length = std::sqrt(w * w + v.squaredNorm());
  return {w / length, v.x() / length, v.y() / length, v.z() / length};
}

Vec3 rotation_vector_of(const Mat3& matrix) noexcept {
  return log_map(quaternion_of(matrix));
}

Vec3 turned(const Vec3& rotation_vector, const Vec3& angular_velocity, double dt) noexcept {
  return log_map(exp_map(angular_velocity * dt) * exp_map(rotation_vector));
}

Mat3 turned(const Mat3& matrix, const Vec3& angular_velocity, double dt) noexcept {
  return matrix_of(Vec3(angular_velocity * dt)) * matrix;
}

Quat turned(const Quat& rotation, const Vec3& angular_velocity, double dt) noexcept {
  return exp_map(angular_velocity * dt) * rotation;
}

Vec3 turned_to_first_order(const Vec3& rotation_vector, const Vec3& angular_velocity, double dt) noexcept {
  return wrapped(Vec3(rotation_vector + angular_velocity * dt));
}

Mat3 turned_to_first_order(const Mat3& matrix, const Vec3& angular_velocity, double dt) noexcept {
  return matrix + math::cross_matrix(angular_velocity * dt) * matrix;
}

Quat turned_to_first_order(const Quat& rotation, const Vec3& angular_velocity, double dt) noexcept {
  const Vec3 half = 0.5 * dt * angular_velocity;
  return Quat(1, half.x(), half.y(), half.z()) * rotation;
}

Mat3 renormalized(const Mat3& matrix) {
  const Vec3 first = matrix.col(0);
  const double length = first.norm();
  Mat3 result;
  result.col(0) = first / length;
  const auto part_across = [&](const Vec3& column) {
    return Vec3(column - Vec3(result.col(0)).dot(column) * Vec3(result.col(0)));
  };
  // Where two columns are nearly parallel, rounding leaves a part along the first; removing it twice leaves none.
  const Vec3 second = part_across(part_across(matrix.col(1)));
  const double across = second.norm();
  // The rounding left of a column along the first is not a direction.
  if (!(length > 0) || !(across > 1e-12 * matrix.col(1).norm()) || !std::isfinite(length) || !std::isfinite(across))
    throw std::invalid_argument("a matrix whose columns do not have two directions is not a rotation");
  result.col(1) = second / across;
  result.col(2) = Vec3(result.col(0)).cross(Vec3(result.col(1)));
  return result;
}

double drift(const Mat3& matrix) noexcept {
  return (matrix.transpose() * matrix - Mat3::Identity()).cwiseAbs().maxCoeff();
}

double drift(const Quat& rotation) noexcept {
  return rotation.norm() - 1;
}

}  // namespace tweenfall
