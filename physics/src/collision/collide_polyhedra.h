#pragma once

#include <tweenfall/physics/contact.h>

#include "collision/polyhedron.h"

namespace tweenfall::collision {

/// Contact of two polyhedra in one space, normal and places in that space, the normal from a toward b. With an infinite
/// margin, which asks how far apart they are, separated ones get one point.
/// @param margin, reach  within the margin they touch, and then points with a gap up to the reach are told, m
[[nodiscard]] Manifold collide_polyhedra(const Polyhedron& a, const Polyhedron& b, double margin, double reach);

}  // namespace tweenfall::collision
