#pragma once

/// One function a pair of solids; each reports the normal from its first argument toward its second.

#include <tweenfall/physics/contact.h>

#include "placed.h"

namespace tweenfall {

[[nodiscard]] Manifold collide(const Sphere& a, const Placed& at_a, const Sphere& b, const Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Sphere& a, const Placed& at_a, const Box& b, const Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Sphere& a, const Placed& at_a, const Capsule& b, const Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Sphere& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Box& a, const Placed& at_a, const Box& b, const Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Box& a, const Placed& at_a, const Capsule& b, const Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Box& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin);
[[nodiscard]] Manifold collide(const Capsule& a, const Placed& at_a, const Capsule& b, const Placed& at_b,
                               double margin);
[[nodiscard]] Manifold collide(const Capsule& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin);

/// Adds a point between the two surfaces, unless the gap is beyond the margin or four are there.
inline void add_point(Manifold& manifold, const Vec3& position, double penetration, std::uint32_t feature,
                      double margin) {
  if (-penetration > margin || manifold.count == 4) return;
  manifold.points[static_cast<std::size_t>(manifold.count++)] = {position, penetration, feature};
}

/// Contact of two balls: what every round shape comes down to.
[[nodiscard]] Manifold collide_balls(const Vec3& center_a, double radius_a, const Vec3& center_b, double radius_b,
                                     const Vec3& fallback_normal, std::uint32_t feature, double margin);

}  // namespace tweenfall
