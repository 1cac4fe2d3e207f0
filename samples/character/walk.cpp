#include "limbs.h"
#include "motions.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/hermite.h>
#include <tweenfall/curves/keys.h>

#include <cmath>

namespace tweenfall::character {

namespace {

// A foot's cycle, in shares of it: the heel strikes at 0, the foot lies flat, the heel leaves, the toes leave, it
// swings.
constexpr double flat_from = 0.11, heel_off = 0.34, toe_off = 0.60, toes_straight = 0.84;
constexpr double heel_strike_ahead = 0.275;  // ankle before the hips at heel strike, m
constexpr double step_half_width = 0.075, toes_out = 6 * degree;
constexpr double swing_lift = 0.07;  // m, added to the straight path of the ankle

double wrapped(double phase) {
  return phase - std::floor(phase);
}

// Pitch of the foot over its cycle, toes up positive, radians.
const Curve<double>& pitch_curve() {
  static const Curve<double> curve = keyed_curve<double>({{0, 21 * degree},
                                                          {flat_from, 0},
                                                          {heel_off, 0},
                                                          {0.48, -17 * degree},
                                                          {toe_off, -52 * degree},
                                                          {0.68, -58 * degree},
                                                          {0.80, -24 * degree},
                                                          {0.93, 18 * degree},
                                                          {1, 21 * degree}},
                                                         {.ends = Ends::wrap});
  return curve;
}

Quat foot_rotation(double pitch, double yaw) {
  return turn_y(yaw) * turn_x(-pitch);
}

// A position and its velocity, per cycle.
struct Path {
  Vec3 value, rate;
};

// The ankle while the foot turns about a point of its own that stays in place.
Path about_pivot(const Vec3& pivot_when_flat, const Vec3& pivot_from_ankle, double phase, double yaw) {
  const Sample<double> pitch = pitch_curve().sample(phase);
  const Vec3 arm = foot_rotation(pitch.value, yaw) * Vec3(-pivot_from_ankle);
  const Vec3 axis = turn_y(yaw) * Vec3(-1, 0, 0);
  return {pivot_when_flat + arm, axis.cross(arm) * pitch.rate};
}

// For a foot whose ankle, once flat, is at `stand`; 0 <= phase <= toe_off.
Path stance(const Vec3& stand, const Vec3& heel, const Vec3& ball, double phase, double yaw) {
  const Vec3& pivot = phase < flat_from ? heel : ball;
  return about_pivot(stand + turn_y(yaw) * pivot, pivot, phase, yaw);
}

FootPlace foot_at(Flank flank, double phase) {
  const double sign = sign_of(flank), yaw = sign * toes_out;
  const Leg leg = leg_of(flank);
  const double ankle_height = bind_position(leg.foot).y();
  const Vec3 ball = bind_offset(leg.toes);
  const Vec3 heel(0, -ankle_height, -0.062);

  const Path strike = about_pivot(turn_y(yaw) * heel, heel, 0, yaw);
  const Vec3 stand(sign * step_half_width, ankle_height, heel_strike_ahead - strike.value.z());

  FootPlace place;
  place.knee = turn_y(0.6 * yaw) * Vec3(0, 0, 1);
  place.rotation = foot_rotation(pitch_curve().value(phase), yaw);
  if (phase < toe_off) {
    place.ankle = stance(stand, heel, ball, phase, yaw).value;
  } else {
    // From where the toes leave to where the heel strikes next, with the velocities it has there.
    const Path from = stance(stand, heel, ball, toe_off, yaw);
    Path to = stance(stand, heel, ball, 0, yaw);
    to.value.z() += walk_stride;
    const double share = 1 - toe_off, u = (phase - toe_off) / share;
    place.ankle = hermite::sample(from.value, from.rate, to.value, to.rate, share, u).value;
    const double bump = 4 * u * (1 - u);
    place.ankle.y() += swing_lift * bump * bump * (1 - 0.5 * u);
  }
  // The toes stay flat while the heel is up, and straighten once they have left.
  if (phase > flat_from) {
    const double u = std::fmin(1.0, std::fmax(0.0, (phase - toe_off) / (toes_straight - toe_off)));
    place.toe_bend = -pitch_curve().value(phase) * (1 - u * u * (3 - 2 * u));
    // Relative to the hips: the body has moved on by its share of the stride.
  }
  place.ankle.z() -= phase * walk_stride;
  return place;
}

double wave_of(double phase) {
  return elementary::cos(2 * std::numbers::pi * phase);
}

void pose_trunk(FigurePose& pose, double phase) {
  const double lead = wave_of(phase);              // 1 when the left foot is in front
  const double load = wave_of(phase - 0.30);       // 1 when the left leg carries the weight
  const double bob = wave_of(2 * (phase - 0.05));  // 1 while both feet stand
  pose.hips_position = Vec3(0.020 * load, 0.913 - 0.019 * bob, 0.006 * wave_of(2 * phase - 0.3));
  pose.turns[hips] = turn_y(-6 * degree * lead) * turn_x(3 * degree + 0.8 * degree * bob) * turn_z(3.5 * degree * load);
  pose.turns[spine] = turn_y(5 * degree * lead) * turn_z(-3 * degree * load);
  pose.turns[chest] = turn_y(8 * degree * lead) * turn_x(1.5 * degree) * turn_z(-2.5 * degree * load);
  pose.turns[neck] = turn_y(-3.5 * degree * lead) * turn_z(1 * degree * load);
  pose.turns[head] =
      turn_y(-3.5 * degree * lead) * turn_x(-4 * degree - 1.2 * degree * bob) * turn_z(1 * degree * load);
}

void swing_arm(FigurePose& pose, Flank flank, double phase) {
  // Each arm goes with the other leg; the forearm and the hand drag a little behind.
  const double swing = -sign_of(flank) * wave_of(phase - 0.02), late = -sign_of(flank) * wave_of(phase - 0.07);
  hang_arm(pose, flank,
           {.forward = (1 + 25 * swing) * degree,
            .out = (8 - 1.5 * swing) * degree,
            .inward = (4 + 4 * swing) * degree,
            .elbow = (27 + 15 * late) * degree});
  const Arm arm = arm_of(flank);
  pose.turns[arm.shoulder] = turn_y(-sign_of(flank) * 4 * degree * swing);
  pose.turns[arm.hand] = turn_x(-4 * degree * late);
}

}  // namespace

FigurePose walk_pose(double time) {
  const double phase = wrapped(time / walk_cycle);
  FigurePose pose;
  pose_trunk(pose, phase);
  plant_leg(pose, Flank::left, foot_at(Flank::left, phase));
  plant_leg(pose, Flank::right, foot_at(Flank::right, wrapped(phase + 0.5)));
  swing_arm(pose, Flank::left, phase);
  swing_arm(pose, Flank::right, phase);
  return pose;
}

FigurePose walk_forward_pose(double time) {
  FigurePose pose = walk_pose(time);
  pose.hips_position.z() += walk_stride * (time / walk_cycle);
  return pose;
}

}  // namespace tweenfall::character
