#pragma once

#include <tweenfall/physics/world.h>

#include <vector>

#include "flat/axes.h"
#include "planar/contacts/plate.h"

namespace tweenfall::flat {

/// What a world's plane cuts out of a body, to be touched by balls in the plane.
class Section {
 public:
  Section(const Shape& shape, WorldPlane plane);

  /// Where a ball touches it deepest, or is nearest, out of the section.
  /// @param node  of the body @param ball  its middle, world, m @param reach  gaps up to this are told, m
  [[nodiscard]] Manifold touch(const Pose& node, const Vec3& ball, double radius, double reach) const;

 private:
  Axes axes_;
  std::vector<planar::inner::Plate> plates_;
};

}  // namespace tweenfall::flat
