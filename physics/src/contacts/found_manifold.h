#pragma once

#include "contacts/contact_constraint.h"
#include "state/body.h"

namespace tweenfall::step {
struct Start;
}

namespace tweenfall::contacts {

/// Whether a manifold is worth keeping: between flat faces it costs most, and there its points would wander.
[[nodiscard]] bool keeps_manifold(const ContactConstraint& contact);

/// Notes a manifold that was found at the start of a step.
[[nodiscard]] state::FoundManifold found_manifold(const ContactConstraint& contact, const step::Start& a,
                                                  const step::Start& b);

/// Takes the remembered manifold up again, told about where the bodies are now.
/// @param swing  how fast points of the surfaces move because the bodies spin, m/s
/// @return false when they have moved against each other by too much since it was found
[[nodiscard]] bool take_up(const state::ContactMemory& memory, const state::Body& a, const state::Body& b, double swing,
                           double dt, ContactConstraint& contact);

}  // namespace tweenfall::contacts
