#pragma once

#include <tweenfall/physics/query.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::queries {

struct Ray {
  Vec3 from;
  Vec3 direction;  ///< unit
  double length;   ///< m; may be infinite
};

/// @throws std::invalid_argument for an impossible ray
[[nodiscard]] Ray checked_ray(const Vec3& from, const Vec3& direction, double length);

/// Where the ray first meets the shape.
[[nodiscard]] std::optional<RayHit> first_on_ray(const Shape& shape, const Pose& pose, const Ray& ray);

/// Whether a point moving along `direction` meets a box within `length` times that vector.
[[nodiscard]] inline bool meets_box(const Bounds& box, const Vec3& from, const Vec3& direction, double length) {
  double enter = 0, leave = length;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (from[i] < box.low[i] || from[i] > box.high[i]) return false;
      continue;
    }
    const double to_low = (box.low[i] - from[i]) / direction[i], to_high = (box.high[i] - from[i]) / direction[i];
    enter = std::max(enter, std::min(to_low, to_high));
    leave = std::min(leave, std::max(to_low, to_high));
  }
  // A flat box is met at a single distance, which rounding must not tear apart.
  return enter <= leave + 1e-12 * std::abs(leave);
}

}  // namespace tweenfall::queries
