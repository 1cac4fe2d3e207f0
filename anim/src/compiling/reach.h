#pragma once

// How much an error of a joint moves the figure.

#include <vector>

#include "compiling/exact_pose.h"

namespace tweenfall::crowd {

struct Reach {
  struct OfJoint {
    double stretch = 0;             ///< factor for lengths below the joint's parent, from the scales above
    double farthest = 0;            ///< from the joint to any point attached below it, m
    double farthest_unscaled = 0;   ///< the same without the joint's own scale
    double largest[3] = {0, 1, 0};  ///< magnitude of a number of each kind
  };
  std::vector<OfJoint> joints;
  double rounding = 0;  ///< how far the roundings of floats, on the way to a point, may well take it, m
  double extent = 0;    ///< of the figure and its way: the farthest that a joint comes from the origin along an axis, m
};

/// @param last_round  the last one of a loop with offset that counts; 0 for the first
[[nodiscard]] Reach reach_of(const ExactPose& exact, double arm, int last_round);

}  // namespace tweenfall::crowd
