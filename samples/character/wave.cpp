#include "limbs.h"
#include "motions.h"

#include <tweenfall/curves/keys.h>

#include <vector>

namespace tweenfall::character {

namespace {

// How far the arm is up, 0 to 1; a little anticipation before and a soft landing after.
const Curve<double>& raised_curve() {
  static const Curve<double> curve =
      keyed_curve<double>({{0, 0}, {0.15, -0.03}, {0.68, 1.03}, {0.8, 1}, {2.25, 1}, {2.85, -0.02}, {wave_duration, 0}},
                          {.ends = Ends::flat});
  return curve;
}

// The forearm's swing about upright, radians, out positive: three times there and back.
const Curve<double>& swing_curve() {
  static const Curve<double> curve = keyed_curve<double>({{0.35, 0},
                                                          {0.75, 26 * degree},
                                                          {1.0, -20 * degree},
                                                          {1.25, 28 * degree},
                                                          {1.5, -20 * degree},
                                                          {1.75, 28 * degree},
                                                          {2.0, -18 * degree},
                                                          {2.35, 0}},
                                                         {.ends = Ends::flat});
  return curve;
}

// Along the curve of rotations from hanging past the middle to up, so that the hand passes in front of the body.
Quat mixed(const Quat& low, const Quat& middle, const Quat& high, double raised) {
  const Curve<Quat> way = keyed_curve<Quat>({{.time = 0, .value = low, .ease = Ease::smooth()},
                                             {.time = 0.5, .value = middle, .ease = Ease::smooth()},
                                             {.time = 1, .value = high, .ease = Ease::smooth()}});
  return way.with_outside(Outside::linear, Outside::linear).value(raised);
}

FigurePose aimed(const Vec3& upper, const Vec3& forearm, double shrug) {
  FigurePose pose = standing();
  const TwoTurns turns = aim(arm_bones(Flank::right), upper.normalized(), forearm.normalized());
  pose.turns[right_shoulder] = turn_z(-shrug);
  pose.turns[right_upper_arm] = pose.turns[right_shoulder].conjugate() * turns.upper;
  pose.turns[right_forearm] = turns.upper.conjugate() * turns.lower;
  return pose;
}

}  // namespace

FigurePose wave_pose(double time) {
  const double raised = raised_curve().value(time), swing = swing_curve().value(time);
  const FigurePose low = standing();
  const FigurePose middle = aimed({-0.62, -0.70, 0.36}, {-0.15, 0.25, 0.95}, 4 * degree);
  const FigurePose high = aimed({-0.86, 0.28, 0.24}, {-0.10, 0.98, 0.20}, 14 * degree);

  FigurePose pose = low;
  for (const Joint joint : {right_shoulder, right_upper_arm, right_forearm})
    pose.turns[joint] = mixed(low.turns[joint], middle.turns[joint], high.turns[joint], raised);
  // About the figure's own front axis: partly from the upper arm, mostly from the elbow, and the hand trails.
  pose.turns[right_upper_arm] = turn_z(0.25 * swing) * pose.turns[right_upper_arm];
  const PlacedFigure placed = place(pose);
  const Quat upper = placed.rotations[right_upper_arm];
  pose.turns[right_forearm] = upper.conjugate() * turn_z(0.75 * swing) * upper * pose.turns[right_forearm];
  const Quat forearm = placed.rotations[right_forearm];
  const double trail = swing_curve().value(time - 0.07);
  pose.turns[right_hand] = forearm.conjugate() * turn_z(0.45 * trail) * forearm;

  pose.turns[spine] = turn_z(2 * degree * raised);
  pose.turns[chest] = turn_z(3 * degree * raised) * turn_y(-4 * degree * raised);
  pose.turns[neck] = turn_z(-2 * degree * raised + 0.06 * swing);
  pose.turns[head] = turn_y(-5 * degree * raised) * turn_z(-6 * degree * raised) * turn_x(-3 * degree * raised);
  return pose;
}

}  // namespace tweenfall::character
