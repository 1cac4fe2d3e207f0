#pragma once

// Scales the weights of any number of joints of a vertex to sum to 1.

#include "model/model_problems.h"

#include <tweenfall/anim/mesh.h>

#include <vector>

namespace tweenfall::models {

/// Counts repairs, so that each mesh reports them once.
struct InfluenceTally {
  std::size_t unbound = 0;   ///< vertices without any weight
  std::size_t negative = 0;  ///< vertices with a weight below 0

  void report(const std::string& place, ModelProblems& problems) const;
};

/// All weights above 0, scaled to sum to 1, the largest first. A vertex without any follows joint 0.
[[nodiscard]] std::vector<Influence> summing_to_one(std::vector<Influence> pulls, InfluenceTally& tally);

}  // namespace tweenfall::models
