#include "skeleton.h"

#include "limbs.h"

#include <tweenfall/curves/rotation.h>

namespace tweenfall::character {

namespace {

struct JointRow {
  const char* name;
  std::size_t parent;
  double x, y, z;  // in the bind pose, m; left side
};

// The arm leaves the shoulder at 45 degrees: 0.28 m to the elbow, 0.25 m to the wrist.
constexpr double diagonal = 0.70710678118654752440;
constexpr double shoulder_x = 0.168, shoulder_y = 1.385;
constexpr double to_elbow = 0.28 * diagonal, to_wrist = 0.53 * diagonal;

constexpr std::array<JointRow, joint_count> rows{{
    {"Hips", joint_count, 0, 0.955, 0},
    {"Spine", hips, 0, 1.045, -0.01},
    {"Chest", spine, 0, 1.19, -0.015},
    {"Neck", chest, 0, 1.455, -0.005},
    {"Head", neck, 0, 1.53, 0.005},
    {"LeftShoulder", chest, 0.035, 1.385, -0.005},
    {"LeftUpperArm", left_shoulder, shoulder_x, shoulder_y, -0.01},
    {"LeftForearm", left_upper_arm, shoulder_x + to_elbow, shoulder_y - to_elbow, -0.01},
    {"LeftHand", left_forearm, shoulder_x + to_wrist, shoulder_y - to_wrist, -0.01},
    {"RightShoulder", chest, -0.035, 1.385, -0.005},
    {"RightUpperArm", right_shoulder, -shoulder_x, shoulder_y, -0.01},
    {"RightForearm", right_upper_arm, -shoulder_x - to_elbow, shoulder_y - to_elbow, -0.01},
    {"RightHand", right_forearm, -shoulder_x - to_wrist, shoulder_y - to_wrist, -0.01},
    {"LeftThigh", hips, 0.092, 0.92, 0},
    {"LeftShin", left_thigh, 0.092, 0.5, 0.022},
    {"LeftFoot", left_shin, 0.092, 0.085, -0.015},
    {"LeftToes", left_foot, 0.092, 0.03, 0.105},
    {"RightThigh", hips, -0.092, 0.92, 0},
    {"RightShin", right_thigh, -0.092, 0.5, 0.022},
    {"RightFoot", right_shin, -0.092, 0.085, -0.015},
    {"RightToes", right_foot, -0.092, 0.03, 0.105},
}};

}  // namespace

Arm arm_of(Flank flank) noexcept {
  return flank == Flank::left ? Arm{left_shoulder, left_upper_arm, left_forearm, left_hand}
                              : Arm{right_shoulder, right_upper_arm, right_forearm, right_hand};
}

Leg leg_of(Flank flank) noexcept {
  return flank == Flank::left ? Leg{left_thigh, left_shin, left_foot, left_toes}
                              : Leg{right_thigh, right_shin, right_foot, right_toes};
}

const char* name_of(Joint joint) noexcept {
  return rows[joint].name;
}

std::size_t parent_of(Joint joint) noexcept {
  return rows[joint].parent;
}

Vec3 bind_position(Joint joint) noexcept {
  return {rows[joint].x, rows[joint].y, rows[joint].z};
}

Vec3 bind_offset(Joint joint) noexcept {
  const std::size_t parent = parent_of(joint);
  if (parent == joint_count) return bind_position(joint);
  return bind_position(joint) - bind_position(static_cast<Joint>(parent));
}

FigurePose::FigurePose() : hips_position(bind_position(hips)) {
  turns.fill(Quat::Identity());
}

PlacedFigure place(const FigurePose& pose) {
  PlacedFigure placed;
  for (std::size_t j = 0; j < joint_count; ++j) {
    const Joint joint = static_cast<Joint>(j);
    const std::size_t parent = parent_of(joint);
    if (parent == joint_count) {
      placed.positions[j] = pose.hips_position;
      placed.rotations[j] = pose.turns[j];
    } else {
      placed.positions[j] = placed.positions[parent] + placed.rotations[parent] * bind_offset(joint);
      placed.rotations[j] = placed.rotations[parent] * pose.turns[j];
    }
  }
  return placed;
}

FigurePose standing() {
  FigurePose pose;
  for (const Flank flank : {Flank::left, Flank::right})
    hang_arm(pose, flank, {.forward = 1 * degree, .out = 9 * degree, .elbow = 12 * degree});
  return pose;
}

Quat turn(const Vec3& axis, double angle) noexcept {
  return exp_map(axis * angle);
}
Quat turn_x(double angle) noexcept {
  return turn(Vec3(1, 0, 0), angle);
}
Quat turn_y(double angle) noexcept {
  return turn(Vec3(0, 1, 0), angle);
}
Quat turn_z(double angle) noexcept {
  return turn(Vec3(0, 0, 1), angle);
}

}  // namespace tweenfall::character
