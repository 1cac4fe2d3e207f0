#pragma once

#include <array>

#include "shapes/placed.h"

namespace tweenfall::queries {

/// A convex solid as a core and a skin of even thickness around it: all that distances need. Not for planes
/// and surfaces.
struct Core {
  const Solid* solid = nullptr;
  shapes::Placed at;
  double skin = 0;                                ///< m
  const std::array<Vec3, 3>* triangle = nullptr;  ///< in place of a solid

  /// The farthest point of the core, without its skin, along a direction of any length.
  [[nodiscard]] Vec3 farthest(const Vec3& direction) const;
};

[[nodiscard]] Core core_of(const Shape& shape, const Pose& pose);

}  // namespace tweenfall::queries
