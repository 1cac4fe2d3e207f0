#pragma once

#include <tweenfall/physics/contact.h>

#include <optional>

#include "shapes/placed.h"

namespace tweenfall::convex {

/// The contact of a capsule whose whole axis lies over one face of a box, as most that touch a floor do: that face's
/// normal is the answer, and no search is needed. Empty for any other, and for an infinite margin.
/// @return with the normal from the box toward the capsule
[[nodiscard]] std::optional<Manifold> capsule_on_box(const Capsule& capsule, const shapes::Placed& at_capsule,
                                                     const Box& box, const shapes::Placed& at_box, double margin,
                                                     double reach);

}  // namespace tweenfall::convex
