#pragma once

#include "collision/passage.h"
#include "contacts/contact_constraint.h"

namespace tweenfall::contacts {

/// Gaps up to this are contacts from the start of the step, m; wider ones only if the bodies meet within the step.
constexpr double near_enough = 2e-3;

/// Turns the points of a contact's manifold, found where the bodies are at its time of impact, into constraints with
/// positions for the start of the step.
void adopt(ContactConstraint& constraint, const collision::Passage& way_a, const collision::Prediction& at_a,
           const collision::Passage& way_b, const collision::Prediction& at_b);

}  // namespace tweenfall::contacts
