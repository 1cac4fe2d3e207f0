#pragma once

#include "state/body.h"

namespace tweenfall::step {

/// How an immovable body moves through a step, at its center of mass: along the cubic from where it is to its target,
/// with the path's own velocity at both ends. Rotation is a rotation vector from where it is.
struct KeyedCourse {
  Twist mean;  ///< takes it exactly to its target
  Twist gain;  ///< velocity at the end of the step minus that at its start
  Twist bow;   ///< by how much the velocity in the middle of the step exceeds the mean

  [[nodiscard]] bool still() const;  ///< it stays where it is
  /// `share` is a part of the step.
  [[nodiscard]] Twist velocity(double share, double dt) const;
  /// The mean velocity from one part of the step to another.
  [[nodiscard]] Twist mean_between(double from, double to, double dt) const;
};

/// The course of an immovable body, which does not move without a target. If the velocities of the path do not
/// match the displacement (a caller that gives none, a corner of the path), the mean is used throughout.
[[nodiscard]] KeyedCourse keyed_course(const state::Body& body, double dt);

/// A body that is moved along its path through a step, while contacts are being solved.
struct LedBody {
  std::uint32_t place = 0;  ///< in the solver
  KeyedCourse course;
  Twist mean;    ///< of the sub-step
  Twist ending;  ///< velocity at its end
};

/// A body that touches a led one.
struct Rider {
  Twist twist;
  Vec3 core_arm{0, 0, 0};  ///< from its center to the contact, without its round skin: the part that turns along
  Vec3 under{0, 0, 0};     ///< from the led body's center to the contact on the rider
  bool rolls = false;      ///< a ball: it moves by the mean of its velocities at both ends of a sub-step
};

/// Rate at which the slip of a rider on a turning led body changes while both keep their velocities, m/s^2: its contact
/// turns along, and gets to other places of the led body.
[[nodiscard]] Vec3 slip_change(const Twist& led, const Rider& rider);

/// What is added to the slip of a rider on a led body in a sub-step, m/s.
struct SlipOfRider {
  Vec3 moving;  ///< while bodies are moved: up to the mean
  Vec3 after;   ///< after they have been moved: up to that at the end
};

/// @param arm  from the led body's center to the contact, the arm with which the slip is computed
[[nodiscard]] SlipOfRider slip_of_rider(const LedBody& led, const Vec3& arm, const Rider& rider, double h);

/// Ends the step of a keyed body: exactly on its target with the target's own twist, or at rest where it is.
void arrive(state::Body& body);

}  // namespace tweenfall::step
