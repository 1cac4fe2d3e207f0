#pragma once

/// The animated values of a node other than its motion.

#include <tweenfall/curves/values.h>

#include <optional>
#include <vector>

namespace tweenfall {

/// The animated values of one node at one time.
struct NodeLook {
  std::optional<Sample<Color>> color;
  std::vector<Sample<double>> weights;  ///< morph weights; empty when not animated
};

}  // namespace tweenfall
