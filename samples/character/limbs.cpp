#include "limbs.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::character {

namespace {

// The rotation that takes one pair of perpendicular unit vectors to another.
Quat rotation_between(const Vec3& hinge, const Vec3& along, const Vec3& new_hinge, const Vec3& new_along) {
  Mat3 from, to;
  from << hinge, along, hinge.cross(along);
  to << new_hinge, new_along, new_hinge.cross(new_along);
  const Mat3 rotation = to * from.transpose();
  return Quat(rotation);
}

TwoTurns turns_of(const TwoBones& bones, const Vec3& upper, const Vec3& lower, const Vec3& hinge) {
  return {rotation_between(bones.hinge, bones.upper.normalized(), hinge, upper),
          rotation_between(bones.hinge, bones.lower.normalized(), hinge, lower)};
}

}  // namespace

void hang_arm(FigurePose& pose, Flank flank, const ArmAngles& angles) {
  const Arm arm = arm_of(flank);
  const double sign = sign_of(flank);
  const TwoBones bones = arm_bones(flank);
  const Vec3 along = bones.upper.normalized();
  pose.turns[arm.upper] =
      turn_x(-angles.forward) * turn_z(sign * (angles.out - 45 * degree)) * turn(along, sign * angles.inward);
  pose.turns[arm.forearm] = turn(bones.hinge, angles.elbow);
}

TwoBones arm_bones(Flank flank) {
  const Arm arm = arm_of(flank);
  const Vec3 upper = bind_offset(arm.forearm);
  // When hanging, the elbow bends about -X; the bind pose has turned that axis with the arm.
  const Vec3 along = upper.normalized();
  return {upper, bind_offset(arm.hand), Vec3(along.y(), -along.x(), 0)};
}

TwoBones leg_bones(Flank flank) {
  const Leg leg = leg_of(flank);
  return {bind_offset(leg.shin), bind_offset(leg.foot), Vec3(1, 0, 0)};
}

TwoTurns aim(const TwoBones& bones, const Vec3& upper, const Vec3& lower) {
  return turns_of(bones, upper, lower, upper.cross(lower).normalized());
}

TwoTurns reach(const TwoBones& bones, const Vec3& root, const Vec3& target, const Vec3& pole) {
  const double a = bones.upper.norm(), b = bones.lower.norm();
  const Vec3 way = target - root;
  const double length = std::clamp(way.norm(), std::abs(a - b) * 1.001 + 1e-6, (a + b) * 0.999);
  const Vec3 along = way.normalized();
  const Vec3 hinge = pole.cross(along).normalized();
  const double cosine = (a * a + length * length - b * b) / (2 * a * length);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Vec3 upper = cosine * along + sine * along.cross(hinge);
  const Vec3 lower = (length * along - a * upper).normalized();
  return turns_of(bones, upper, lower, hinge);
}

void plant_leg(FigurePose& pose, Flank flank, const FootPlace& place_of_foot) {
  const Leg leg = leg_of(flank);
  const Quat pelvis = pose.turns[hips];
  const Vec3 root = pose.hips_position + pelvis * bind_offset(leg.thigh);
  const TwoTurns turns = reach(leg_bones(flank), root, place_of_foot.ankle, place_of_foot.knee);
  pose.turns[leg.thigh] = pelvis.conjugate() * turns.upper;
  pose.turns[leg.shin] = turns.upper.conjugate() * turns.lower;
  pose.turns[leg.foot] = turns.lower.conjugate() * place_of_foot.rotation;
  pose.turns[leg.toes] = turn_x(-place_of_foot.toe_bend);
}

void reach_arm(FigurePose& pose, Flank flank, const Vec3& wrist, const Vec3& elbow, const Quat& hand) {
  const Arm arm = arm_of(flank);
  const PlacedFigure placed = place(pose);
  const TwoTurns turns = reach(arm_bones(flank), placed.positions[arm.upper], wrist, elbow);
  pose.turns[arm.upper] = placed.rotations[arm.shoulder].conjugate() * turns.upper;
  pose.turns[arm.forearm] = turns.upper.conjugate() * turns.lower;
  pose.turns[arm.hand] = turns.lower.conjugate() * hand;
}

}  // namespace tweenfall::character
