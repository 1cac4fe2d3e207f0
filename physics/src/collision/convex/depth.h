#pragma once

#include "collision/convex/core.h"

namespace tweenfall::convex {

/// The shortest way out of an overlap.
struct Depth {
  double depth = 0;                   ///< how far b must go along the normal for the cores to be apart, m
  Vec3 normal{0, 0, 0};               ///< unit, from a toward b; zero where the cores have no number for one
  Vec3 on_a{0, 0, 0}, on_b{0, 0, 0};  ///< the places that part last
};

/// The depth of two cores that touch or overlap, of which one has a volume. All differences of places of a and of b are
/// a convex solid; it is grown from within, where its surface is nearest to the origin.
/// Source: van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, GDC 2001.
[[nodiscard]] Depth depth_of(Core& a, Core& b);

}  // namespace tweenfall::convex
