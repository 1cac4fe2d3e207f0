#pragma once

/// Arms and legs: hung by angles, aimed along directions, or reaching for a place.

#include "skeleton.h"

namespace tweenfall::character {

/// How an arm hangs, radians; all zero is straight down with the thumb forward.
struct ArmAngles {
  double forward = 0;  ///< the upper arm swings to the front
  double out = 0;      ///< and away from the body
  double inward = 0;   ///< the upper arm turns about itself, its forearm towards the belly
  double elbow = 0;    ///< 0 is straight
};
void hang_arm(FigurePose& pose, Flank flank, const ArmAngles& angles);

/// Two bones and the hinge between them, as they are in the bind pose.
struct TwoBones {
  Vec3 upper, lower;  ///< from joint to joint, m
  Vec3 hinge;         ///< unit, perpendicular to both; a positive turn about it bends the limb
};
[[nodiscard]] TwoBones arm_bones(Flank flank);
[[nodiscard]] TwoBones leg_bones(Flank flank);

/// Rotations, relative to the bind pose and in the world, of a limb's two bones.
struct TwoTurns {
  Quat upper, lower;
};

/// The bones along two unit directions that are not parallel.
[[nodiscard]] TwoTurns aim(const TwoBones& bones, const Vec3& upper, const Vec3& lower);

/// Two-bone inverse kinematics by the law of cosines: from `root` to `target`, the middle joint towards `pole`.
/// A target out of reach is approached up to 0.1 % short of the limb's full length.
[[nodiscard]] TwoTurns reach(const TwoBones& bones, const Vec3& root, const Vec3& target, const Vec3& pole);

/// The pose of a foot: where its ankle is and how the foot is turned, in the world.
struct FootPlace {
  Vec3 ankle{0, 0, 0};
  Quat rotation{1, 0, 0, 0};
  double toe_bend = 0;  ///< radians; positive lifts the toes
  Vec3 knee{0, 0, 1};   ///< direction in which the knee points
};
/// Turns the leg so that its foot is at `place`; the hips must be posed already.
void plant_leg(FigurePose& pose, Flank flank, const FootPlace& place);

/// Turns the arm so that its wrist is at `wrist`, the elbow towards `elbow`, and the hand as `hand` says, all in the
/// world; the trunk and shoulder must be posed already.
void reach_arm(FigurePose& pose, Flank flank, const Vec3& wrist, const Vec3& elbow, const Quat& hand);

}  // namespace tweenfall::character
