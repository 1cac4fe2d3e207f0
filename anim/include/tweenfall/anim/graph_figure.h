#pragma once

/// Operations of a graph on whole figures. Each changes the pose that it names as its `base` (none: what lies below the
/// graph) by a weight: 0 leaves the base bit for bit, 1 changes it wholly.

#include <tweenfall/anim/graph_number.h>
#include <tweenfall/anim/mirror.h>
#include <tweenfall/anim/retarget.h>
#include <tweenfall/anim/root_motion.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// What the left side does, the right side does, and the other way about, as `Mirror`.
struct MirrorPose {
  std::string base{};
  std::vector<MirrorPair> pairs{};  ///< none: the usual ways of naming sides that the figure uses
  Vec3 normal{1, 0, 0};             ///< of the mirror plane, in the figure's space
  std::string figure{};             ///< a node: it and all below it are mirrored, in its parent's space; empty: all
  GraphNumber weight = 1.0;
};

/// How a node stands where two figures stand alike; what is absent is as at rest.
struct RetargetStance {
  std::string node;
  std::optional<Vec3> position{};
  std::optional<Quat> rotation{};
};

/// A figure takes over what another one does, as `Retarget`. A figure is a node and all below it.
struct RetargetPose {
  std::string base{};
  std::string source, target;  ///< nodes
  std::vector<RetargetPair> pairs;
  double scale = 0;  ///< of ways; 0: the ratio of the hip heights
  Vec3 up{0, 1, 0};  ///< in the space of the source's parent
  GraphNumber weight = 1.0;
  Quat turn{1, 0, 0, 0};                 ///< from the space of the source's parent to that of the target's
  std::vector<RetargetStance> stance{};  ///< of nodes of either figure, each once; the others stand as at rest
};

/// What carries a figure through the world is taken out of its pose, as by `RootMotion`, and carries another node, or
/// none: then the figure goes on the spot.
///
/// Where it accumulates, the figure goes on instead from loop to loop and from clip to clip: its way is made of the
/// steps of the clips in the base, mixed by the weights that they have in blends, spaces, layers and machines. What is
/// added, mirrored or retargeted there changes no step. It begins where the clips have it when the graph begins, or the
/// state around it. Loops of one clip are repeated in closed form: ten thousand end where one does, so many times over.
struct RootMotionPose {
  std::string base{};
  std::string node;
  RootParts parts = {};
  std::string onto{};  ///< a node above it, which is carried instead; empty: none, or, accumulating, itself
  bool accumulates = false;
  GraphNumber weight = 1.0;
};

}  // namespace tweenfall
