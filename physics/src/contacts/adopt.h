#pragma once

#include <algorithm>

#include "collision/passage.h"
#include "contacts/contact_constraint.h"

namespace tweenfall::contacts {

/// Gaps up to this are contacts from the start of the step, m; wider ones only if the bodies meet within the step. What
/// is small is near only within this part of its radius: otherwise a body would touch what lies behind its neighbor.
constexpr double near_enough = 2e-3, near_enough_of_small = 0.05;

[[nodiscard]] inline double near_enough_of(const collision::Passage& body) {
  return std::min(near_enough, near_enough_of_small * body.radius);
}
[[nodiscard]] inline double near_enough_of(const collision::Passage& a, const collision::Passage& b) {
  return std::min(near_enough, near_enough_of_small * std::min(a.radius, b.radius));
}

/// Turns the points of a contact's manifold, found where the bodies are at its time of impact, into constraints with
/// positions for the start of the step.
void adopt(ContactConstraint& constraint, const collision::Passage& way_a, const collision::Prediction& at_a,
           const collision::Passage& way_b, const collision::Prediction& at_b);

}  // namespace tweenfall::contacts
