#pragma once

/// The figure's bones: 21 joints, where each is when the mesh is bound, and poses of them.
///
/// The figure is 1.7 m tall, faces +Z, has its left at +X and stands on y = 0. It is bound with the arms 45 degrees
/// out, half way between hanging and level, so that shoulders bend well both ways. In the bind pose every joint's axes
/// are the world's: a turn is relative to the parent, and all turns are the identity there.

#include <tweenfall/curves/values.h>

#include <array>
#include <cstddef>
#include <numbers>

namespace tweenfall::character {

enum Joint : std::size_t {
  hips,
  spine,
  chest,
  neck,
  head,
  left_shoulder,
  left_upper_arm,
  left_forearm,
  left_hand,
  right_shoulder,
  right_upper_arm,
  right_forearm,
  right_hand,
  left_thigh,
  left_shin,
  left_foot,
  left_toes,
  right_thigh,
  right_shin,
  right_foot,
  right_toes,
  joint_count
};

enum class Flank { left, right };

struct Arm {
  Joint shoulder, upper, forearm, hand;
};
struct Leg {
  Joint thigh, shin, foot, toes;
};
[[nodiscard]] Arm arm_of(Flank flank) noexcept;
[[nodiscard]] Leg leg_of(Flank flank) noexcept;
[[nodiscard]] constexpr double sign_of(Flank flank) noexcept {
  return flank == Flank::left ? 1 : -1;
}  ///< of x

[[nodiscard]] const char* name_of(Joint joint) noexcept;
[[nodiscard]] std::size_t parent_of(Joint joint) noexcept;  ///< `joint_count` for the hips
[[nodiscard]] Vec3 bind_position(Joint joint) noexcept;     ///< in the world, m
[[nodiscard]] Vec3 bind_offset(Joint joint) noexcept;       ///< from the parent, m; for the hips from the origin

struct FigurePose {
  Vec3 hips_position{0, 0, 0};
  std::array<Quat, joint_count> turns;  ///< relative to the parent's

  FigurePose();
};

/// Where the joints of a pose are in the world.
struct PlacedFigure {
  std::array<Vec3, joint_count> positions;
  std::array<Quat, joint_count> rotations;
};
[[nodiscard]] PlacedFigure place(const FigurePose& pose);

/// At ease: legs straight, arms hanging a little out with soft elbows. The model's rest pose.
[[nodiscard]] FigurePose standing();

inline constexpr double degree = std::numbers::pi / 180;

/// Rotation by `angle` radians about a unit axis.
[[nodiscard]] Quat turn(const Vec3& axis, double angle) noexcept;
[[nodiscard]] Quat turn_x(double angle) noexcept;  ///< positive bows forward and swings a limb back
[[nodiscard]] Quat turn_y(double angle) noexcept;  ///< positive looks left
[[nodiscard]] Quat turn_z(double angle) noexcept;  ///< positive lifts the left side

}  // namespace tweenfall::character
