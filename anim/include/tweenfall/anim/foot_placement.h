#pragma once

/// Feet on uneven ground: a figure scripted to walk on a flat floor stands on slopes, stairs and stones.
///
/// The height of a foot above the script's floor becomes its height above the ground: the pelvis moves so that the
/// lowest foot can reach, each leg bends, and each foot aligns with the ground's normal.
/// The caller provides the ground.

#include <tweenfall/anim/two_bone.h>

#include <functional>
#include <vector>

namespace tweenfall {

/// The ground below or above a place.
struct Ground {
  double height = 0;          ///< along up, m
  Vec3 normal{0, 1, 0};       ///< any length; if it leans more than 84 degrees from up, it counts as no ground
  double height_rate = 0;     ///< how fast the ground itself rises at a fixed place, m/s
  Vec3 normal_rate{0, 0, 0};  ///< of the normal below the queried place as that moves, 1/s
};

/// The ground at a moving place; empty where there is none. It must not throw.
using GroundAt = std::function<std::optional<Ground>(const Sample<Vec3>& place)>;

struct FootSettings {
  TwoBoneSettings leg;                                ///< its end is the foot
  std::optional<double> ankle_height = std::nullopt;  ///< of the foot joint above its sole, m; absent: above 0 at rest
};

struct FootPlacementSettings {
  NodeRef pelvis;                  ///< all legs are below it; it is moved
  std::vector<FootSettings> feet;  ///< at least one
  Vec3 up{0, 1, 0};                ///< in the world; any length
  double lowest = 0.5;             ///< how far the pelvis may go down, m
  double highest = 0.5;            ///< how far it may go up, m
  double evenness = 0;             ///< distance over which one foot replaces another as the lowest, m; 0: abruptly
  double tilt = 0.8;               ///< greatest tilt of the feet, rad
  double softness = 0;             ///< of the legs, as in `TwoBoneGoal`
};

class FootPlacement {
 public:
  struct Foot {
    TwoBoneChain leg;
    double ankle_height;
  };

  /// @throws std::invalid_argument listing what is wrong: nodes that do not exist, no foot, legs that are not below the
  ///         pelvis or that share joints, numbers out of range, and what is wrong with each leg
  FootPlacement(const Hierarchy& nodes, const FootPlacementSettings& settings);

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::size_t pelvis() const noexcept { return pelvis_; }
  [[nodiscard]] std::span<const Foot> feet() const noexcept { return feet_; }
  [[nodiscard]] const Vec3& up() const noexcept { return up_; }  ///< unit
  [[nodiscard]] double lowest() const noexcept { return lowest_; }
  [[nodiscard]] double highest() const noexcept { return highest_; }
  [[nodiscard]] double evenness() const noexcept { return evenness_; }
  [[nodiscard]] double tilt() const noexcept { return tilt_; }
  [[nodiscard]] double softness() const noexcept { return softness_; }

 private:
  Hierarchy nodes_;
  std::size_t pelvis_ = no_node;
  std::vector<Foot> feet_;
  Vec3 up_;
  double lowest_, highest_, evenness_, tilt_, softness_;
};

inline constexpr std::size_t most_feet_placed = 8;

/// Puts the feet on the ground. Throws and allocates nothing; places at most `most_feet_placed` feet.
///
/// @param floor    height along up of the floor that the script walks on, m
/// @param weight   0 leaves the pose as it is, bit for bit; 1 places; between, feet go part of their way, with the legs
///                 bent as they must be from 0.1 on
/// @param weights  one per foot: how much it belongs on the ground; or empty for all 1
/// @param pose     local motions of all nodes; those of pelvis, legs and feet are changed
void place_feet(const FootPlacement& placement, const GroundAt& ground, const Sample<double>& floor,
                const Sample<double>& weight, std::span<const Sample<double>> weights, std::span<Motion> pose) noexcept;

}  // namespace tweenfall
