#pragma once

// The angle between two rotations.

#include <tweenfall/curves/rotation.h>

#include <cmath>

namespace tweenfall::rotations {

/// Radians, 0 to pi; exact for small angles too.
[[nodiscard]] inline double rotation_distance(const Quat& a, const Quat& b) noexcept {
  const Vec3 way = log_map(a.conjugate() * b);
  return std::sqrt(way.squaredNorm());
}

}  // namespace tweenfall::rotations
