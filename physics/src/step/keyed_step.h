#pragma once

#include "state/body.h"

namespace tweenfall::step {

/// How an immovable body gets through a step: its velocity, at the center of mass, changes evenly about the mean.
struct KeyedCourse {
  Twist mean;  ///< takes it exactly to its target
  Twist gain;  ///< velocity at the end of the step less that at its start
};

/// What contacts feel of an immovable body. Nothing moves without a target. Where the velocities that the path tells of
/// do not belong to the displacement (a caller that gives none, a corner of the path), the mean is kept throughout.
[[nodiscard]] KeyedCourse keyed_course(const state::Body& body, double dt);

/// Ends the step of a keyed body: exactly on its target with the target's own twist, or at rest where it is.
void arrive(state::Body& body);

}  // namespace tweenfall::step
