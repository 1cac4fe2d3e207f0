#pragma once

#include "collision/convex/core.h"

namespace tweenfall::convex {

/// The distance of two cores, and where they are nearest.
struct Nearness {
  double distance = 0;                ///< m; 0 if they touch or overlap
  Vec3 normal{0, 0, 0};               ///< unit, from a toward b, if they are apart
  Vec3 on_a{0, 0, 0}, on_b{0, 0, 0};  ///< their nearest points
};

/// The distance of two cores that are apart; for cores farther apart than `enough`, a direction along which they are.
/// Source: Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between Complex Objects in
/// Three-Dimensional Space, 1988.
[[nodiscard]] Nearness nearness_of(Core& a, Core& b, double enough);

}  // namespace tweenfall::convex
