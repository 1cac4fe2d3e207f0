#pragma once

// Rotations and rotation vectors with the Jacobians that tie their rates, for one arc tangent or one sine and cosine.

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>

#include "rotation/rotation_series.h"

namespace tweenfall::rotations {

/// The short rotation vector r of a rotation, and c of its inverse Jacobians: those of r and of -r are
/// 1 + [r]/2 + c [r]^2 and 1 - [r]/2 + c [r]^2.
struct LogParts {
  Vec3 r;
  double c;

  explicit LogParts(const Quat& q) noexcept : r(log_map(q)) {
    const double x = r.squaredNorm();
    // Half the angle has the cotangent w / |v|.
    c = x < 0.05 ? inverse_jacobian_coefficient(x)
                 : (1 - 0.5 * std::sqrt(x) * std::abs(q.w()) / std::sqrt(q.vec().squaredNorm())) / x;
  }

  /// Multiplies by the inverse Jacobian of r, and of -r.
  [[nodiscard]] Vec3 right_inverse(const Vec3& v) const noexcept {
    const Vec3 cross = r.cross(v);
    return v + 0.5 * cross + c * r.cross(cross);
  }
  [[nodiscard]] Vec3 left_inverse(const Vec3& v) const noexcept {
    const Vec3 cross = r.cross(v);
    return v - 0.5 * cross + c * r.cross(cross);
  }
};

/// The rotation of a rotation vector r, the same bits as `exp_map` gives, and a and b of its Jacobians: those of r and
/// of -r are 1 - a [r] + b [r]^2 and 1 + a [r] + b [r]^2.
struct ExpParts {
  Vec3 r;
  Quat rotation;
  double a, b;

  explicit ExpParts(const Vec3& vector) noexcept : r(vector) {
    const double x = r.squaredNorm();
    double cosine, share;
    if (x < series_limit) {
      const HalfTurn half = half_turn(x);
      cosine = half.cosine;
      share = half.sine_share;
      b = series_b(x);
    } else {
      const double angle = std::sqrt(x);
      const elementary::SinCos half = elementary::sin_cos(angle / 2);
      cosine = half.cos;
      share = half.sin / angle;
      b = (1 - 2 * share * cosine) / x;
    }
    a = 2 * share * share;
    rotation = Quat(cosine, share * r[0], share * r[1], share * r[2]);
  }

  /// Multiplies by the Jacobian of -r.
  [[nodiscard]] Vec3 left(const Vec3& v) const noexcept {
    const Vec3 cross = r.cross(v);
    return v + a * cross + b * r.cross(cross);
  }
};

}  // namespace tweenfall::rotations
