#pragma once

// Decomposes a placement given as a matrix.

#include <tweenfall/curves/pose.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::models {

struct TakenApart {
  Pose pose;
  double shear = 0;  ///< largest element of matrix - pose, relative to the largest of the matrix; 0 for none
};

/// Position, rotation and scale whose product is the matrix, or nearly so where it holds shear. A mirroring matrix gets
/// a negative x scale.
[[nodiscard]] TakenApart take_apart(const Mat3& linear, const Vec3& translation) noexcept;

/// Checked number by number, because Eigen's own function is not inlined.
[[nodiscard]] inline bool is_finite(const Mat3& matrix) noexcept {
  return std::all_of(matrix.data(), matrix.data() + matrix.size(), [](double number) { return std::isfinite(number); });
}

}  // namespace tweenfall::models
