#pragma once

#include <tweenfall/physics/contact.h>

#include "convex/core.h"

namespace tweenfall::convex {

/// Contact of two convex solids in one space, the normal from a toward b. With an infinite margin, which asks how far
/// apart they are, separated ones get one point.
/// @param margin, reach  within the margin they touch, and then points with a gap up to the reach are told, m
[[nodiscard]] Manifold collide_convex(Core& a, Core& b, double margin, double reach);

/// Contact of a convex solid with all that lies behind a plane.
[[nodiscard]] Manifold collide_with_plane(Core& a, const Vec3& normal, double offset, double margin, double reach);

}  // namespace tweenfall::convex
