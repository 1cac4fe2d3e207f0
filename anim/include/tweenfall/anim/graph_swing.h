#pragma once

/// Operations of a graph that lag behind, overshoot and swing out.
///
/// Each changes the pose that it names as its `base` (none: what lies below the graph) by a weight: 0 leaves the base
/// bit for bit, 1 shows the springs, which go on whatever the weight is. They start at rest with the graph, or with the
/// state that shows them, and follow from the log alone: the same bits whatever the frames. At every instant at which
/// something comes in or a machine passes to another state their clock starts anew, their place and velocity in the
/// world going on; between instants they see nothing of what is to come. Where a graph lies over another, only its own
/// instants are known to it, for what it shows follows from its own log, which is saved and played back by itself: what
/// jumps in the other is a quick movement to these springs.

#include <tweenfall/anim/graph_number.h>
#include <tweenfall/anim/spring.h>

#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// A node whose place, rotation or both follow the base by springs, as `NodeSpring`.
struct SpringPose {
  std::string base{};
  std::string node;
  std::optional<SpringSettings> position{};  ///< of its place in the world
  std::optional<SpringSettings> rotation{};  ///< of its rotation in the world
  GraphNumber weight = 1.0;
};

/// A chain of joints that swings after what carries it, as `JiggleChain`.
struct JigglePose {
  std::string base{};
  std::vector<std::string> joints;  ///< from the one nearest to the root on
  Vec3 tip{0, 0, 0};                ///< tail of the last joint, in its own space, m; zero: the last is only a tail
  SpringSettings spring = {};
  double limit = std::numbers::pi;  ///< rad
  double ease = 0.2;                ///< rad
  GraphNumber weight = 1.0;
};

}  // namespace tweenfall
