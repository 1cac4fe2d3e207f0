#pragma once

#include <tweenfall/physics/contact.h>

#include "collision/convex/core.h"

namespace tweenfall::convex {

/// The best separating direction of two solids, and where they meet along it.
struct Meeting {
  double gap = 0;        ///< m; negative for an overlap
  Vec3 normal{0, 0, 0};  ///< from a toward b; zero if it cannot be computed
  Vec3 middle{0, 0, 0};  ///< between the two surfaces
};

/// For solids farther apart than `margin`, any direction along which they are.
[[nodiscard]] Meeting meeting_of(Core& a, Core& b, double margin);

/// The contact of two solids with this meeting.
[[nodiscard]] Manifold contact_along(Core& a, Core& b, const Meeting& meeting, double reach);

/// Contact of two convex solids in one space, the normal from a toward b. With an infinite margin, which asks how far
/// apart they are, separated ones get one point.
/// @param margin, reach  if they touch within the margin, points with a gap up to the reach are reported, m
[[nodiscard]] Manifold collide_convex(Core& a, Core& b, double margin, double reach);

/// Contact of a convex solid with everything behind a plane.
[[nodiscard]] Manifold collide_with_plane(Core& a, const Vec3& normal, double offset, double margin, double reach);

}  // namespace tweenfall::convex
