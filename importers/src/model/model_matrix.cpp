#include "model/model_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tweenfall::models {

namespace {

/// A unit direction at right angles to `a`.
Vec3 perpendicular(const Vec3& a) {
  const Vec3 axis = std::abs(a[0]) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 across = axis - a.dot(axis) * a;
  return across / across.norm();
}

/// Right-handed unit axes near the columns (Gram-Schmidt); columns of no length get any direction that fits.
Mat3 axes_near(const Mat3& columns, const Vec3& lengths) {
  const double tiny = 1e-12 * lengths.maxCoeff();
  std::array<Vec3, 3> axes{};
  std::array<bool, 3> known{};
  for (int i = 0; i < 3; ++i) {
    if (!(lengths[i] > tiny)) continue;
    Vec3 axis = columns.col(i) / lengths[i];
    for (std::size_t j = 0; j < static_cast<std::size_t>(i); ++j)
      if (known[j]) axis -= axes[j].dot(axis) * axes[j];
    const double length = axis.norm();
    if (length < 1e-9) continue;
    axes[static_cast<std::size_t>(i)] = axis / length;
    known[static_cast<std::size_t>(i)] = true;
  }
  const std::size_t count = static_cast<std::size_t>(std::count(known.begin(), known.end(), true));
  if (count == 0) return Mat3::Identity();
  if (count == 1) {
    const std::size_t one = static_cast<std::size_t>(std::find(known.begin(), known.end(), true) - known.begin());
    axes[(one + 1) % 3] = perpendicular(axes[one]);
    known[(one + 1) % 3] = true;
  }
  const auto missing = std::find(known.begin(), known.end(), false);
  if (missing != known.end()) {
    const std::size_t k = static_cast<std::size_t>(missing - known.begin());
    axes[k] = axes[(k + 1) % 3].cross(axes[(k + 2) % 3]);
  }
  Mat3 result;
  for (int i = 0; i < 3; ++i) result.col(i) = axes[static_cast<std::size_t>(i)];
  return result;
}

}  // namespace

TakenApart take_apart(const Mat3& linear, const Vec3& translation) noexcept {
  TakenApart result;
  Vec3 scale(linear.col(0).norm(), linear.col(1).norm(), linear.col(2).norm());
  Mat3 axes = axes_near(linear, scale);
  if (axes.determinant() < 0) {
    axes.col(0) = -axes.col(0);
    scale[0] = -scale[0];
  }
  Quat rotation(axes);
  rotation.normalize();
  result.pose = {translation, rotation, scale};
  const Mat3 back = rotation.toRotationMatrix() * scale.asDiagonal();
  const double size = linear.cwiseAbs().maxCoeff();
  const double difference = (back - linear).cwiseAbs().maxCoeff();
  result.shear = size > 0 && difference > 1e-5 * size ? difference / size : 0;
  return result;
}

}  // namespace tweenfall::models
