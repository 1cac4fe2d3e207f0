#pragma once

#include "collision/convex/core.h"

namespace tweenfall::convex {

/// How two cores lie to each other.
struct Nearness {
  double distance = 0;                ///< m; 0 where they touch or overlap
  Vec3 normal{0, 0, 0};               ///< unit, from a toward b, where they are apart
  Vec3 on_a{0, 0, 0}, on_b{0, 0, 0};  ///< their nearest places
};

/// The distance of two cores that are apart; what is wider apart than `enough` gets a direction along which it is.
/// Source: Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between Complex Objects in
/// Three-Dimensional Space, 1988.
[[nodiscard]] Nearness nearness_of(Core& a, Core& b, double enough);

}  // namespace tweenfall::convex
