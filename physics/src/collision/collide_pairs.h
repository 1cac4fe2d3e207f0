#pragma once

/// One function for each pair of solids with an algorithm of its own; normals point from the first argument toward
/// the second.

#include <tweenfall/physics/contact.h>

#include "shapes/placed.h"

namespace tweenfall::collision {

[[nodiscard]] Manifold collide(const Sphere& a, const shapes::Placed& at_a, const Sphere& b, const shapes::Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Sphere& a, const shapes::Placed& at_a, const Box& b, const shapes::Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Sphere& a, const shapes::Placed& at_a, const Capsule& b,
                               const shapes::Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Sphere& a, const shapes::Placed& at_a, const Plane& b, const shapes::Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Box& a, const shapes::Placed& at_a, const Plane& b, const shapes::Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Capsule& a, const shapes::Placed& at_a, const Capsule& b,
                               const shapes::Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Capsule& a, const shapes::Placed& at_a, const Plane& b, const shapes::Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Hull& a, const shapes::Placed& at_a, const Sphere& b, const shapes::Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Hull& a, const shapes::Placed& at_a, const Plane& b, const shapes::Placed& at_b,
                               double margin);

/// Polyhedra: if they touch within the margin, points with a gap up to the reach are reported.
[[nodiscard]] Manifold collide(const Box& a, const shapes::Placed& at_a, const Box& b, const shapes::Placed& at_b,
                               double margin, double reach);
[[nodiscard]] Manifold collide(const Hull& a, const shapes::Placed& at_a, const Box& b, const shapes::Placed& at_b,
                               double margin, double reach);
[[nodiscard]] Manifold collide(const Hull& a, const shapes::Placed& at_a, const Hull& b, const shapes::Placed& at_b,
                               double margin, double reach);

/// Contact of two placed shapes: if they touch within the margin, points with a gap up to the
/// reach are reported, which is at least the margin.
[[nodiscard]] Manifold collide(const Shape& a, const shapes::Placed& at_a, const Shape& b, const shapes::Placed& at_b,
                               double margin, double reach) noexcept;

/// How far apart shapes are.
struct Gap {
  double width = 0;      ///< m; not positive if they touch or overlap
  Vec3 normal{0, 0, 0};  ///< unit, from a toward b, if they are apart
};
/// For shapes farther apart than `enough`, a direction along which they are is enough, with the gap along it.
[[nodiscard]] Gap gap_between(const Shape& a, const shapes::Placed& at_a, const Shape& b, const shapes::Placed& at_b,
                              double enough) noexcept;

/// Adds a point between the two surfaces, unless the gap is beyond the margin or four are there.
inline void add_point(Manifold& manifold, const Vec3& position, double penetration, std::uint32_t feature,
                      double margin) {
  if (-penetration > margin || manifold.count == 4) return;
  manifold.points[static_cast<std::size_t>(manifold.count++)] = {position, penetration, feature};
}

/// A manifold given in a solid's own space.
[[nodiscard]] inline Manifold to_world(Manifold manifold, const shapes::Placed& at) {
  manifold.normal = at.axes * manifold.normal;
  for (int i = 0; i < manifold.count; ++i) {
    Vec3& position = manifold.points[static_cast<std::size_t>(i)].position;
    position = at.center + at.axes * position;
  }
  return manifold;
}

/// Contact of two balls, to which all round shapes reduce.
[[nodiscard]] Manifold collide_balls(const Vec3& center_a, double radius_a, const Vec3& center_b, double radius_b,
                                     const Vec3& fallback_normal, std::uint32_t feature, double margin);

}  // namespace tweenfall::collision
