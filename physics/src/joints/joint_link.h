#pragma once

#include "state/joint.h"

namespace tweenfall::joints {

/// A joint that acts in a step.
struct JointLink {
  static constexpr std::uint32_t world = 0xffffffffu;
  std::uint32_t a = world, b = world;  ///< indices of the bodies; b is never the world
  state::Joint* joint = nullptr;
};

}  // namespace tweenfall::joints
