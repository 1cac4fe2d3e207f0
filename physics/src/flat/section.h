#pragma once

#include <tweenfall/physics/world.h>

#include <vector>

#include "flat/axes.h"
#include "planar/contacts/plate.h"

namespace tweenfall::flat {

/// The section of a body by the world's plane, which balls in the plane touch.
class Section {
 public:
  Section(const Shape& shape, WorldPlane plane);

  /// Where a ball touches it deepest, or is nearest; the normal points out of the section.
  /// @param node  of the body @param ball  its center, world, m @param reach  gaps up to this are reported, m
  [[nodiscard]] Manifold touch(const Pose& node, const Vec3& ball, double radius, double reach) const;

 private:
  Axes axes_;
  std::vector<planar::inner::Plate> plates_;
};

}  // namespace tweenfall::flat
