#pragma once

#include <tweenfall/curves/values.h>

namespace tweenfall::math {

/// The matrix K with K w = v x w.
[[nodiscard]] inline Mat3 cross_matrix(const Vec3& v) noexcept {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace tweenfall::math
