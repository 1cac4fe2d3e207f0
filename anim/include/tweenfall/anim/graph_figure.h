#pragma once

/// Operations of a graph on whole figures. Each changes the pose that it names as its `base` (none: the pose below the
/// graph) by a weight: 0 leaves the base bit for bit, 1 changes it fully.

#include <tweenfall/anim/graph_number.h>
#include <tweenfall/anim/mirror.h>
#include <tweenfall/anim/retarget.h>
#include <tweenfall/anim/root_motion.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// The left side does what the right side does and vice versa, as by `Mirror`.
struct MirrorPose {
  std::string base{};
  std::vector<MirrorPair> pairs{};  ///< none: the usual ways of naming sides that the figure uses
  Vec3 normal{1, 0, 0};             ///< of the mirror plane, in the figure's space
  std::string figure{};             ///< a node: it and all below it are mirrored, in its parent's space; empty: all
  GraphNumber weight = 1.0;
};

/// The pose of a node in a stance, in which two figures stand alike; absent parts are as at rest.
struct RetargetStance {
  std::string node;
  std::optional<Vec3> position{};
  std::optional<Quat> rotation{};
};

/// A figure does what another one does, as by `Retarget`. A figure is a node and all nodes below it.
struct RetargetPose {
  std::string base{};
  std::string source, target;  ///< nodes
  std::vector<RetargetPair> pairs;
  double scale = 0;  ///< of displacements; 0: the ratio of the hip heights
  Vec3 up{0, 1, 0};  ///< in the space of the source's parent
  GraphNumber weight = 1.0;
  Quat turn{1, 0, 0, 0};                 ///< from the space of the source's parent to that of the target's
  std::vector<RetargetStance> stance{};  ///< for nodes of either figure, each once; the others are as at rest
};

/// The motion that carries a figure through the world is taken out of its pose, as by `RootMotion`, and carries another
/// node, or none: then the figure moves on the spot. It rides on the nodes above it that the clips of its base do not
/// move: their own movement is not taken out.
///
/// If it accumulates, the figure instead travels on from loop to loop and from clip to clip: its path is the sum of the
/// steps of the clips in the base, mixed by the weights that they have in blends, spaces, layers and machines. Adding,
/// mirroring or retargeting there does not change the steps. It begins at the clips' own place when the graph, or the
/// state around it, begins. Loops of one clip are repeated in closed form, and so are the laps of several of constant
/// weights: ten thousand are exact.
struct RootMotionPose {
  std::string base{};
  std::string node;
  RootParts parts = {};
  std::string onto{};  ///< a node above it, which is carried instead; empty: none, or itself if it accumulates
  bool accumulates = false;
  GraphNumber weight = 1.0;
};

}  // namespace tweenfall
