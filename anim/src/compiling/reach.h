#pragma once

// How much an error of a joint moves the figure, and how large errors are.

#include <span>
#include <vector>

#include "compiling/exact_pose.h"
#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

struct Reach {
  struct OfJoint {
    double stretch = 1;             ///< factor for lengths below the joint's parent, from the scales above
    double farthest = 0;            ///< from the joint to any point attached below it, m
    double farthest_unscaled = 0;   ///< the same without the joint's own scale
    double largest[3] = {0, 1, 0};  ///< magnitude of a number of each kind
  };
  std::vector<OfJoint> joints;
};

[[nodiscard]] Reach reach_of(const ExactPose& exact, double arm);

/// The largest distance of a point of the figure from its place on the exact path, m; at the given times, from both
/// sides of each.
[[nodiscard]] double largest_error(const ExactPose& exact, const CompiledClip& clip, double arm,
                                   std::span<const double> times);

}  // namespace tweenfall::crowd
