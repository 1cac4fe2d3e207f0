#pragma once

#include <tweenfall/physics/contact.h>

#include "collision/polyhedron.h"

namespace tweenfall::collision {

/// Contact of two polyhedra in one space, with normal and points in that space, the normal from a toward b. With an
/// infinite margin, which asks how far apart they are, separated ones get one point.
/// @param margin, reach  if they touch within the margin, points with a gap up to the reach are reported, m
[[nodiscard]] Manifold collide_polyhedra(const Polyhedron& a, const Polyhedron& b, double margin, double reach);

}  // namespace tweenfall::collision
