#pragma once

#include "collision/convex/core.h"

namespace tweenfall::convex {

/// The shortest way out of an overlap.
struct Depth {
  double depth = 0;                   ///< how far b must move along the normal for the cores to be apart, m
  Vec3 normal{0, 0, 0};               ///< unit, from a toward b; zero if it cannot be computed
  Vec3 on_a{0, 0, 0}, on_b{0, 0, 0};  ///< the points that part last
};

/// The depth of two cores that touch or overlap, at least one with a volume. The differences of points of a and of b
/// form a convex solid; a polytope is grown in it from within, where its surface is nearest to the origin. Source: van
/// den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, GDC 2001.
[[nodiscard]] Depth depth_of(Core& a, Core& b);

}  // namespace tweenfall::convex
