#pragma once

#include <cmath>

#include "contacts/contact_constraint.h"
#include "forces/free_flight.h"

namespace tweenfall::contacts {

/// When and how fast a gap closes within a span of time; `span` and 0 if it does not close.
struct Meeting {
  double time, speed;
};

[[nodiscard]] Meeting meeting_of(double gap, double closing, double pull, double span);

/// Closing acceleration without contacts, and the speed below which a rebound would be mere jitter: what gravity gives
/// in a step or two. Two bodies that fall together do not close, but what lies under them makes them jitter.
struct Closing {
  double pull, tremble;
};

/// @param whole  length of the whole step, for its parts too, since what jitters in the step does so in each of them, s
[[nodiscard]] Closing closing_of(const Vec3& normal, const forces::Load& a, const forces::Load& b, double whole);

/// Prepares the points of a contact for a step and decides whether some meet fast enough to be an impact.
/// @param a  velocity of the first body at the start of the step
void foresee(ContactConstraint& contact, const Twist& a, const Twist& b, const Closing& closing, double dt);

}  // namespace tweenfall::contacts
