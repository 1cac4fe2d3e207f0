#pragma once

#include <tweenfall/physics/query.h>

namespace tweenfall::queries {

struct Ray {
  Vec3 from;
  Vec3 direction;  ///< unit
  double length;   ///< m; may be infinite
};

/// @throws std::invalid_argument for what is no ray
[[nodiscard]] Ray checked_ray(const Vec3& from, const Vec3& direction, double length);

/// Where the ray first meets the shape.
[[nodiscard]] std::optional<RayHit> first_on_ray(const Shape& shape, const Pose& pose, const Ray& ray);

}  // namespace tweenfall::queries
