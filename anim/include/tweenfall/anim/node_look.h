#pragma once

/// What of a node is animated beside its motion.

#include <tweenfall/curves/values.h>

#include <optional>
#include <vector>

namespace tweenfall {

/// The animated values of one node at one time, beside its motion.
struct NodeLook {
  std::optional<Sample<Color>> color;
  std::vector<Sample<double>> weights;  ///< morph weights; empty when not animated
};

}  // namespace tweenfall
