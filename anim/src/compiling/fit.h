#pragma once

// Approximates curves by lines or Hermite cubics between few knots.

#include <array>
#include <vector>

#include "compiling/encode.h"
#include "compiling/exact_pose.h"

namespace tweenfall::crowd {

/// The times within a clip at which the curves of each node have knots, by kind; those of a formula are far enough from
/// each other for it to be looked at in between.
struct CurveKnots {
  /// @param longest_look  the longest stretch of a formula without a knot, s
  CurveKnots(const Clip& clip, const Hierarchy& nodes, double longest_look);

  double look;                                         ///< that stretch, s
  std::array<std::vector<std::vector<double>>, 3> of;  ///< for each kind and node; s, in no order
  std::array<std::vector<char>, 3> formula;            ///< for each kind and node: whether a formula moves it
};

/// A channel through the knots of its curves, and as many more as it takes for none of its numbers to be further off
/// than `tolerance` has it for the lane.
/// @throws std::invalid_argument where 20,000 knots and 16 for each of the curves' do not do
[[nodiscard]] Fitted fitted(const ExactPose& exact, const CurveKnots& knots, std::size_t group, Kind kind,
                            const std::array<double, CrowdGroup::size>& tolerance);

}  // namespace tweenfall::crowd
