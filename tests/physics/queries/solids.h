#pragma once

// Random shapes, and their interior, computed in another way than in the library.

#include <tweenfall/physics/query.h>

#include <cstdlib>

#include "support.h"

namespace tweenfall::test {

inline constexpr double without_end = std::numeric_limits<double>::infinity();

/// How many random cases: TWEENFALL_CASES, or `standard`.
inline int cases(int standard) {
  const char* asked = std::getenv("TWEENFALL_CASES");
  return asked ? std::atoi(asked) : standard;
}

/// A solid about `size` large.
inline Solid any_solid(Random& random, double size, int kinds = 4) {
  switch (random.bits() % static_cast<unsigned>(kinds)) {
    case 0:
      return Sphere{size * random.between(0.2, 1)};
    case 1:
      return Box{size * Vec3(random.between(0.05, 1), random.between(0.05, 1), random.between(0.05, 1))};
    case 2:
      return Capsule{size * random.between(0.05, 0.5), size * random.between(0, 1)};
    default: {
      std::vector<Vec3> points;
      const int count = 4 + static_cast<int>(random.bits() % 20);
      for (int i = 0; i < count; ++i) points.push_back(random.vector(size));
      return Hull{ConvexHull(points)};
    }
  }
}

inline Shape any_shape(Random& random, double size) {
  return {any_solid(random, size), {.position = random.vector(0.3 * size), .rotation = random.rotation()}};
}

inline Pose any_pose(Random& random, double room) {
  return {.position = random.vector(room), .rotation = random.rotation()};
}

/// How far a point is outside a solid: a lower bound outside, negative inside, 0 on its surface.
inline double height_over(const Shape& shape, const Pose& node, const Vec3& point) {
  const Quat rotation = node.rotation * shape.offset.rotation;
  const Vec3 at = rotation.conjugate() * Vec3(point - node.position - node.rotation * shape.offset.position);
  if (const auto* sphere = std::get_if<Sphere>(&shape.solid)) return at.norm() - sphere->radius;
  if (const auto* box = std::get_if<Box>(&shape.solid)) return (at.cwiseAbs() - box->half_extents).maxCoeff();
  if (const auto* capsule = std::get_if<Capsule>(&shape.solid)) {
    const double above = std::max(0.0, std::abs(at.y()) - capsule->half_height);
    return std::hypot(at.x(), above, at.z()) - capsule->radius;
  }
  if (const auto* plane = std::get_if<Plane>(&shape.solid)) return plane->normal.dot(at) - plane->offset;
  double height = -std::numeric_limits<double>::infinity();
  const ConvexHull& hull = std::get<Hull>(shape.solid).convex;
  for (const ConvexHull::Face& face : hull.faces()) height = std::max(height, face.normal.dot(at) - face.offset);
  return height;
}

}  // namespace tweenfall::test
