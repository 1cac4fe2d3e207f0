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

  /// The place of the deepest point, or the nearest; `count` where there is none.
  [[nodiscard]] std::size_t deepest() const noexcept;
};

/// Contacts of a convex solid that stands in front of the surface's triangles; none of other solids. Sides between
/// triangles in one plane, and hollow ones, take no part. Where more than `most` directions touch, the deepest count.
/// @param at  of the solid, in the surface's space
/// @param margin, reach  within the margin they touch, and then points with a gap up to the reach are told, m
[[nodiscard]] Touch touch(const Surface& surface, const Solid& solid, const shapes::Placed& at, double margin,
                          double reach) noexcept;

/// How a place is seen from another one.
[[nodiscard]] inline shapes::Placed seen_from(const shapes::Placed& from, const shapes::Placed& placed) noexcept {
  const Mat3 into = from.axes.transpose();
  return {into * (placed.center - from.center), into * placed.axes};
}

/// The deepest of the contacts that `touch` tells, in the world.
[[nodiscard]] Manifold deepest_touch(const Surface& surface, const shapes::Placed& at_surface, const Solid& solid,
                                     const shapes::Placed& at, double margin, double reach) noexcept;

}  // namespace tweenfall::surfaces
