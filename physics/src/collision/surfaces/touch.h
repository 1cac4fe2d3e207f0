#pragma once

#include <tweenfall/physics/contact.h>

#include "collision/surfaces/surface.h"
#include "shapes/placed.h"

namespace tweenfall::surfaces {

/// Where a solid touches a surface: one manifold for each direction in which it is pushed, out of the surface.
struct Touch {
  static constexpr std::size_t most = 8;
  std::array<Manifold, most> manifolds;
  std::size_t count = 0;

  /// The index of the deepest contact, or the nearest; `count` if there is none.
  [[nodiscard]] std::size_t deepest() const noexcept;
};

/// Contacts of a convex solid that is in front of the surface's triangles; none for other solids. Sides between
/// triangles in one plane, and hollow ones, are ignored. If more than `most` directions touch, the deepest are kept.
/// @param at  of the solid, in the surface's space
/// @param margin, reach  if they touch within the margin, points with a gap up to the reach are reported, m
[[nodiscard]] Touch touch(const Surface& surface, const Solid& solid, const shapes::Placed& at, double margin,
                          double reach) noexcept;

/// One pose relative to another.
[[nodiscard]] inline shapes::Placed seen_from(const shapes::Placed& from, const shapes::Placed& placed) noexcept {
  const Mat3 into = from.axes.transpose();
  return {into * (placed.center - from.center), into * placed.axes};
}

/// The deepest of the contacts from `touch`, in the world.
[[nodiscard]] Manifold deepest_touch(const Surface& surface, const shapes::Placed& at_surface, const Solid& solid,
                                     const shapes::Placed& at, double margin, double reach) noexcept;

}  // namespace tweenfall::surfaces
