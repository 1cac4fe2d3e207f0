#pragma once

#include <tweenfall/physics/contact.h>

#include "collision/convex/core.h"

namespace tweenfall::convex {

/// The best direction of two solids, and the places that meet along it.
struct Meeting {
  double gap = 0;        ///< m; negative for an overlap
  Vec3 normal{0, 0, 0};  ///< from a toward b; zero where there is no number for it
  Vec3 middle{0, 0, 0};  ///< between the two surfaces
};

/// Of solids that are wider apart than `margin`, a direction along which they are.
[[nodiscard]] Meeting meeting_of(Core& a, Core& b, double margin);

/// The contact of two solids that meet so.
[[nodiscard]] Manifold contact_along(Core& a, Core& b, const Meeting& meeting, double reach);

/// Contact of two convex solids in one space, the normal from a toward b. With an infinite margin, which asks how far
/// apart they are, separated ones get one point.
/// @param margin, reach  within the margin they touch, and then points with a gap up to the reach are told, m
[[nodiscard]] Manifold collide_convex(Core& a, Core& b, double margin, double reach);

/// Contact of a convex solid with all that lies behind a plane.
[[nodiscard]] Manifold collide_with_plane(Core& a, const Vec3& normal, double offset, double margin, double reach);

}  // namespace tweenfall::convex
