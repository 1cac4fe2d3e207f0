#include "limbs.h"
#include "motions.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

namespace tweenfall::character {

namespace {

// At rest at both ends. Angles are in degrees, because they are written by hand here.
Curve<double> angle_curve(std::initializer_list<Key<double>> keys) {
  return keyed_curve<double>(keys, {.ends = Ends::flat});
}
Curve<Vec3> way_curve(std::initializer_list<Key<Vec3>> keys) {
  return keyed_curve<Vec3>(keys, {.ends = Ends::flat});
}

// The motion in words: sit up over both hands, draw the feet in, tip forward into a squat, rise.
struct Script {
  Curve<Vec3> hips_way = way_curve({{0, Vec3(0, 0.130, -0.60)},
                                    {0.12, Vec3(0, 0.130, -0.60)},
                                    {0.45, Vec3(0, 0.136, -0.57)},
                                    {0.80, Vec3(0.01, 0.163, -0.46)},
                                    {1.22, Vec3(0.015, 0.36, -0.22)},
                                    {1.60, Vec3(0.005, 0.60, -0.17)},
                                    {2.15, Vec3(0, 0.915, -0.025)},
                                    {get_up_duration, bind_position(hips)}});
  Curve<double> pelvis = angle_curve(
      {{0, -90}, {0.12, -90}, {0.45, -62}, {0.80, -22}, {1.22, 30}, {1.60, 36}, {2.15, 7}, {get_up_duration, 0}});
  Curve<double> yaw = angle_curve({{0, 0}, {0.15, 0}, {0.60, 7}, {1.10, 5}, {1.70, -2}, {2.30, 0}});
  Curve<double> spine_bow =
      angle_curve({{0, 0}, {0.10, 0}, {0.42, 16}, {0.80, 22}, {1.22, 18}, {1.60, 10}, {2.15, 2}, {get_up_duration, 0}});
  Curve<double> chest_bow =
      angle_curve({{0, 0}, {0.08, 0}, {0.40, 20}, {0.80, 20}, {1.22, 12}, {1.60, 6}, {2.15, 1}, {get_up_duration, 0}});
  Curve<double> head_bow = angle_curve(
      {{0, 0}, {0.05, 0}, {0.35, 30}, {0.80, 8}, {1.22, -26}, {1.60, -24}, {2.15, -4}, {get_up_duration, 0}});

  // Feet: ankles and pitch, toes up positive. The right one is drawn in first.
  Curve<Vec3> right_ankle = way_curve({{0, Vec3(-0.115, 0.096, 0.222)},
                                       {0.18, Vec3(-0.115, 0.096, 0.222)},
                                       {0.45, Vec3(-0.12, 0.125, 0.10)},
                                       {0.68, bind_position(right_foot)}});
  Curve<Vec3> left_ankle = way_curve({{0, Vec3(0.115, 0.096, 0.222)},
                                      {0.32, Vec3(0.115, 0.096, 0.222)},
                                      {0.60, Vec3(0.12, 0.125, 0.10)},
                                      {0.84, bind_position(left_foot)}});
  Curve<double> right_pitch = angle_curve({{0, 68}, {0.18, 68}, {0.45, 26}, {0.68, 0}});
  Curve<double> left_pitch = angle_curve({{0, 68}, {0.32, 68}, {0.60, 26}, {0.84, 0}});
  Curve<double> feet_yaw = angle_curve({{0, 14}, {0.3, 14}, {0.65, 0}});
  Curve<double> knees_out = angle_curve({{0, 0.25}, {0.7, 0.12}, {1.2, 0.22}, {1.7, 0.1}, {2.3, 0}});

  // Hands: flat on the floor beside the hips, then swung forward for balance, then hanging.
  Curve<Vec3> right_wrist = way_curve({{0.62, Vec3(-0.33, 0.036, -0.60)}, {0.95, Vec3(-0.34, 0.24, -0.34)}});
  Curve<Vec3> left_wrist = way_curve({{0.74, Vec3(0.35, 0.036, -0.62)}, {1.07, Vec3(0.36, 0.24, -0.36)}});
  Curve<double> right_holds = angle_curve({{0.66, 1}, {1.0, 0}});
  Curve<double> left_holds = angle_curve({{0.78, 1}, {1.12, 0}});
  Curve<double> arms_forward = angle_curve({{0.7, -20}, {1.25, 58}, {1.6, 42}, {2.15, 6}, {get_up_duration, 1}});
  Curve<double> arms_out = angle_curve({{0.7, 24}, {1.25, 16}, {2.15, 10}, {get_up_duration, 9}});
  Curve<double> elbows = angle_curve({{0.7, 60}, {0.95, 95}, {1.3, 60}, {1.6, 46}, {2.15, 18}, {get_up_duration, 12}});
};

const Script& script() {
  static const Script told;
  return told;
}

// Palm down, the fingers away from the head and a little out.
Quat flat_hand(Flank flank) {
  const double sign = sign_of(flank);
  const Quat hanging = turn_z(-sign * 45 * degree);
  return turn_y(sign * 20 * degree) * turn_x(-90 * degree) * turn_y(-sign * 90 * degree) * hanging;
}

void pose_rising_arm(FigurePose& pose, Flank flank, double time) {
  const Script& s = script();
  const bool is_left = flank == Flank::left;
  const Arm arm = arm_of(flank);
  hang_arm(pose, flank,
           {.forward = s.arms_forward.value(time) * degree,
            .out = s.arms_out.value(time) * degree,
            .elbow = s.elbows.value(time) * degree});
  const double holds = (is_left ? s.left_holds : s.right_holds).value(time);
  if (holds <= 0) return;
  FigurePose holding = pose;
  const Vec3 elbow_way(sign_of(flank), 0.25, -0.35);
  reach_arm(holding, flank, (is_left ? s.left_wrist : s.right_wrist).value(time), elbow_way, flat_hand(flank));
  for (const Joint joint : {arm.upper, arm.forearm, arm.hand})
    pose.turns[joint] = slerp(pose.turns[joint], hemisphere_aligned(holding.turns[joint], pose.turns[joint]), holds);
}

void pose_leg(FigurePose& pose, Flank flank, double time) {
  const Script& s = script();
  const bool is_left = flank == Flank::left;
  const double sign = sign_of(flank);
  const double pitch = (is_left ? s.left_pitch : s.right_pitch).value(time) * degree;
  FootPlace foot;
  foot.ankle = (is_left ? s.left_ankle : s.right_ankle).value(time);
  foot.rotation = turn_y(sign * s.feet_yaw.value(time) * degree) * turn_x(-pitch);
  foot.knee = Vec3(sign * s.knees_out.value(time), 0.7, 0.7);
  plant_leg(pose, flank, foot);
}

}  // namespace

FigurePose get_up_pose(double time) {
  if (time >= get_up_duration) return standing();
  const Script& s = script();
  FigurePose pose;
  pose.hips_position = s.hips_way.value(time);
  pose.turns[hips] = turn_y(s.yaw.value(time) * degree) * turn_x(s.pelvis.value(time) * degree);
  pose.turns[spine] = turn_x(s.spine_bow.value(time) * degree) * turn_y(0.5 * s.yaw.value(time) * degree);
  pose.turns[chest] = turn_x(s.chest_bow.value(time) * degree);
  pose.turns[neck] = turn_x(0.5 * s.head_bow.value(time) * degree);
  pose.turns[head] = turn_x(0.5 * s.head_bow.value(time) * degree) * turn_y(-0.8 * s.yaw.value(time) * degree);
  for (const Flank flank : {Flank::left, Flank::right}) {
    pose_leg(pose, flank, time);
    pose_rising_arm(pose, flank, time);
  }
  return pose;
}

}  // namespace tweenfall::character
