#pragma once

/// Operations of a graph that lag behind, overshoot and come to rest.
///
/// Each changes the pose that it names as its `base` (none: the pose below the graph) by a weight: 0 leaves the base
/// bit for bit, 1 shows the springs, which keep moving whatever the weight is. They start at rest with the graph, or
/// with the state that shows them, and are determined by the log alone: the same bits whatever the frames. At every
/// input, whenever a machine passes to another state, and where a clip of their base jumps, within itself or where it
/// loops, their clock restarts, while their position and velocity in the world continue; so they do not see ahead
/// beyond such an instant. Where a graph lies over another or over plays, only its own instants count, because its pose
/// is determined by its own log, which is saved and played back by itself: a jump below is just a quick movement to
/// these springs, over a step of their grid.

#include <tweenfall/anim/graph_number.h>
#include <tweenfall/anim/spring.h>

#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// A node whose position, rotation or both follow the base by springs, as `NodeSpring`.
struct SpringPose {
  std::string base{};
  std::string node;
  std::optional<SpringSettings> position{};  ///< of its position in the world
  std::optional<SpringSettings> rotation{};  ///< of its rotation in the world
  GraphNumber weight = 1.0;
};

/// A chain of joints that swings behind the node that carries it, as `JiggleChain`.
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
