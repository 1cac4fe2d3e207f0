#pragma once

// How far an error of a joint is felt in the figure, and how large errors are.

#include <span>
#include <vector>

#include "compiling/exact_pose.h"
#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

struct Reach {
  struct OfJoint {
    double stretch = 1;             ///< of what is below the joint's parent, by the scales above
    double farthest = 0;            ///< from the joint to any point that hangs on it, m
    double farthest_unscaled = 0;   ///< the same in the joint's own measure, as the figure sees it
    double largest[3] = {0, 1, 0};  ///< magnitude of a number of each kind
  };
  std::vector<OfJoint> joints;
};

[[nodiscard]] Reach reach_of(const ExactPose& exact, double arm);

/// The largest distance of a point of the figure from where the exact path has it, m; at the given times, from both
/// sides of each.
[[nodiscard]] double largest_error(const ExactPose& exact, const CompiledClip& clip, double arm,
                                   std::span<const double> times);

}  // namespace tweenfall::crowd
