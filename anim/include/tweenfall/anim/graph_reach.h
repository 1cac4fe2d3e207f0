#pragma once

/// Operations of a graph that turn joints to reach a goal.
///
/// Each changes the pose that it names as its `base` (none: the pose below the graph) by a weight: 0 leaves the base
/// bit for bit, 1 reaches. Nodes are where the base puts them: a simulated body counts as being where its script puts
/// it.

#include <tweenfall/anim/graph_number.h>
#include <tweenfall/anim/height_grid.h>
#include <tweenfall/anim/joint_chain.h>

#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// Two bones that bend at one joint, as `TwoBoneChain`.
struct TwoBonePose {
  std::string base{};
  std::string start, middle, end;    ///< nodes, each below the one before
  GraphPlace target = {};            ///< where the end goes
  std::optional<GraphPlace> pole{};  ///< to which the middle points; absent: the side on which it is in the pose
  std::optional<Vec3> axis{};        ///< about which the middle bends, in the start's space; absent: as the rest pose
  double softness = 0;               ///< 0 to 0.5, as in `TwoBoneGoal`
  GraphNumber weight = 1.0;          ///< 0 to 1; values beyond are clamped
};

/// Joints that share the turning until the last of them looks at a target, as `LookAtChain`.
struct LookAtPose {
  struct Joint {
    std::string node;
    double share = 1;  ///< of the turning that the joints before it left over, 0 to 1
  };
  std::string base{};
  std::vector<Joint> joints;  ///< from the one nearest to the root to the one that looks
  GraphPlace target = {};
  Vec3 forward{0, 0, 1};            ///< where the last joint looks, in its own space
  Vec3 up{0, 1, 0};                 ///< the direction in its own space that is kept `upright`
  std::optional<Vec3> upright{};    ///< world direction for `up`; absent: it turns the shortest way
  Vec3 eye{0, 0, 0};                ///< from where it looks, in its own space, m
  double limit = std::numbers::pi;  ///< of the turning, rad
  double ease = 0.2;                ///< range over which it slows down before the limit, rad
  GraphNumber weight = 1.0;
};

/// A chain of any number of joints whose end reaches for a target, as `JointChain`.
struct ReachPose {
  struct Joint {
    std::string node;
    JointLimit limit = {};
  };
  std::string base{};
  std::vector<Joint> joints;  ///< from the one nearest to the root to the end, which is carried
  GraphPlace target = {};
  ChainMethod method = ChainMethod::fabrik;
  int sweeps = 8;
  bool leaps = true;  ///< jump to where a chain with limits is nearer to its target
  /// A chain with limits goes on from where it was, as `follow` does, 60 times a second, and every ten minutes from the
  /// last input or jump of what is below it begins anew: so no time takes longer to find than ten minutes of following.
  bool follows = false;
  GraphNumber weight = 1.0;
};

/// Feet on uneven ground, as `FootPlacement`. Up is y.
struct FeetPose {
  struct Foot {
    std::string start, middle, end;        ///< of the leg; its end is the foot
    std::optional<Vec3> axis{};            ///< about which the middle bends, in the start's space
    std::optional<double> ankle_height{};  ///< m; absent: above 0 at rest
    GraphNumber weight = 1.0;              ///< how much it belongs on the ground, 0 to 1
  };
  std::string base{};
  std::string pelvis;
  std::vector<Foot> feet;
  HeightGrid ground = {};
  GraphNumber floor = 0.0;  ///< height of the floor on which the base walks, m
  double lowest = 0.5, highest = 0.5, evenness = 0, tilt = 0.8, softness = 0;  ///< as in `FootPlacementSettings`
  GraphNumber weight = 1.0;
};

}  // namespace tweenfall
