#pragma once

#include "state/body.h"

namespace tweenfall::step {

/// How an immovable body gets through a step, at its center of mass: along the cubic from where it is to its target
/// that has the path's own velocity at both ends. Turns are those of a rotation vector from where it is.
struct KeyedCourse {
  Twist mean;  ///< takes it exactly to its target
  Twist gain;  ///< velocity at the end of the step less that at its start
  Twist bow;   ///< by how much the middle of these two is above the mean

  [[nodiscard]] bool still() const;  ///< it stays where it is
  /// At a part of the step.
  [[nodiscard]] Twist velocity(double share, double dt) const;
  /// What takes it from where it is at one part of the step to where it is at another.
  [[nodiscard]] Twist mean_between(double from, double to, double dt) const;
};

/// The course of an immovable body. Nothing moves without a target. Where the velocities that the path tells of do not
/// belong to the displacement (a caller that gives none, a corner of the path), the mean is kept throughout.
[[nodiscard]] KeyedCourse keyed_course(const state::Body& body, double dt);

/// A body that is led through a step, while contacts are being solved.
struct LedBody {
  std::uint32_t place = 0;  ///< in the solver
  KeyedCourse course;
  Twist mean;    ///< of the sub-step
  Twist ending;  ///< velocity at its end
};

/// A body beside one that is led, where they touch.
struct Rider {
  Twist twist;
  Vec3 core_arm{0, 0, 0};  ///< from its center to the contact, less its round skin: what turns along with it
  Vec3 under{0, 0, 0};     ///< from the led body's center to where the rider has the contact
  bool rolls = false;      ///< a ball: it moves by the mean of its velocities at both ends of a sub-step
};

/// How the slip of a rider on a led body that turns changes while the two go on as they do, m/s^2: where it holds on
/// turns with it, and comes to other places of what it rides on.
[[nodiscard]] Vec3 slip_change(const Twist& led, const Rider& rider);

/// What is to be added to the slip of a rider on a led body in a sub-step, m/s.
struct SlipOfRider {
  Vec3 moving;  ///< while bodies are moved: to the mean
  Vec3 after;   ///< and once they have been: to that at its end
};

/// @param arm  from the led body's center to the contact, as the slip is found with
[[nodiscard]] SlipOfRider slip_of_rider(const LedBody& led, const Vec3& arm, const Rider& rider, double h);

/// Ends the step of a keyed body: exactly on its target with the target's own twist, or at rest where it is.
void arrive(state::Body& body);

}  // namespace tweenfall::step
