#pragma once

// Any number of joints that pull on a vertex, brought down to the four that our meshes hold.

#include "model/model_problems.h"

#include <tweenfall/anim/mesh.h>

#include <vector>

namespace tweenfall {

struct WeightedJoint {
  std::uint32_t joint;
  double weight;
};

/// Counts what had to be mended, so that a mesh says it once.
struct InfluenceTally {
  std::size_t dropped = 0;   ///< vertices with more than four joints
  std::size_t unbound = 0;   ///< vertices without any weight
  std::size_t negative = 0;  ///< vertices with a weight below 0

  void report(const std::string& place, ModelProblems& problems) const;
};

/// The four largest weights, scaled to sum to 1. A vertex without any follows joint 0.
[[nodiscard]] Influence strongest(std::vector<WeightedJoint> pulls, InfluenceTally& tally);

}  // namespace tweenfall
