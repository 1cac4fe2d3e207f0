#pragma once

#include <tweenfall/physics/joint.h>

namespace tweenfall::state {

/// Everything the world knows about one joint. Plain values: a copy of it steps to the same bits.
struct Joint {
  /// Rows of the kind of joint that has the most.
  static constexpr std::size_t most_rows = 12;

  bool alive = false;
  std::uint32_t generation = 0;
  JointSettings settings;

  std::array<double, most_rows> kept{};  ///< by row, impulses of the last sub-step that was worth keeping, N s or N m s
  double kept_step = 0;                  ///< length of that sub-step, s
  double passed_over = 0;                ///< time since then, in sub-steps too short to keep their impulses, s
  std::array<double, 2>
      angles{};          ///< of a hinge, wheel or universal joint, and of a gear's wheels, whole turns included, rad
  Vec3 side{0, 0, 0};    ///< unit: direction of its last impulse, for a cone in a's frame, for a distance in the world
  Vec3 force{0, 0, 0};   ///< on b in the last step, N
  Vec3 torque{0, 0, 0};  ///< about b's frame, N m
};

}  // namespace tweenfall::state
