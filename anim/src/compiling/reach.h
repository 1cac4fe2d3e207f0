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
  double extent = 0;  ///< of the figure and its way: the farthest that a joint comes from the origin along an axis, m
};

[[nodiscard]] Reach reach_of(const ExactPose& exact, double arm);

struct LargestError {
  double distance = 0;  ///< of a point of the figure from its place on the exact path, m
  double time = 0;      ///< s
};

struct Instant {
  double time;  ///< s
  Side side;
};

/// Where the joints are at some instants, one instant after the other.
[[nodiscard]] std::vector<WorldFrame> exact_frames(const ExactPose& exact, std::span<const Instant> instants);

/// The largest error at some instants.
/// @param frames  as from `exact_frames` for the same instants; empty: they are found on the way
[[nodiscard]] LargestError largest_error(const ExactPose& exact, const CompiledClip& clip, double arm,
                                         std::span<const Instant> instants, std::span<const WorldFrame> frames = {});

}  // namespace tweenfall::crowd
