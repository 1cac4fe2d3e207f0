#pragma once

/// Convex solids for a general search: by the farthest point along a direction.

#include <tweenfall/physics/shape.h>

#include <array>

#include "shapes/placed.h"

namespace tweenfall::convex {

/// A convex solid in some space: everything within a radius of its core.
struct Core {
  enum class Kind : std::uint8_t { point, segment, box, hull, cylinder, cone, drop, triangle };
  Kind kind = Kind::point;
  /// Of a box, half extents; of a solid of revolution about y, its radius and half its height. A drop is a ball of that
  /// radius and the point opposite to it: the ball is above if y is positive.
  Vec3 half{0, 0, 0};
  const ConvexHull* hull = nullptr;
  const std::array<Vec3, 3>* corners = nullptr;  ///< of a triangle, counter-clockwise seen from the front
  double back = 0;                               ///< how far a triangle reaches behind itself, m
  double radius = 0;                             ///< around the core, m
  double size = 0;   ///< about the distance from its middle to the nearest point of its surface, m
  double reach = 0;  ///< no point of the core is farther from its origin, m
  Mat3 turn = Mat3::Identity();
  Vec3 shift{0, 0, 0};
  std::uint32_t vertex = 0;  ///< of the hull, where the last search ended

  /// The farthest point of the core along a direction of any length.
  [[nodiscard]] Vec3 support(const Vec3& direction);
  /// The height of the solid's farthest point along a unit direction, m.
  [[nodiscard]] double height(const Vec3& direction) { return direction.dot(support(direction)) + radius; }
  [[nodiscard]] Vec3 place(const Vec3& local) const { return shift + turn * local; }
};

[[nodiscard]] Core core_of(const Sphere& sphere, const shapes::Placed& at);
[[nodiscard]] Core core_of(const Box& box, const shapes::Placed& at);
[[nodiscard]] Core core_of(const Capsule& capsule, const shapes::Placed& at);
[[nodiscard]] Core core_of(const Hull& hull, const shapes::Placed& at);
[[nodiscard]] Core core_of(const Cylinder& cylinder, const shapes::Placed& at);
[[nodiscard]] Core core_of(const Cone& cone, const shapes::Placed& at);
[[nodiscard]] Core core_of(const TaperedCapsule& capsule, const shapes::Placed& at);
[[nodiscard]] Core core_of(const std::array<Vec3, 3>& triangle, const Vec3& normal);

}  // namespace tweenfall::convex
