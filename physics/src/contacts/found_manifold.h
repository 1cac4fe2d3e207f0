#pragma once

#include "contacts/contact_constraint.h"
#include "state/body.h"

namespace tweenfall::contacts {

/// Whether a manifold is worth keeping: between flat faces it costs most, and its points would wander there.
[[nodiscard]] bool keeps_manifold(const ContactConstraint& contact);

/// Uses the remembered manifold again, moved to where the bodies are now.
/// @param swing  speed of surface points due to the spin of the bodies, m/s
/// @return false when they have moved too much relative to each other since it was found
[[nodiscard]] bool take_up(const state::ContactMemories& memories, const state::ContactMemory& memory,
                           const state::Body& a, const state::Body& b, double swing, double dt,
                           ContactConstraint& contact);

/// The manifold of a contact in the last step.
/// @param a  where its bodies were at the start of that step
[[nodiscard]] Manifold manifold_of(const state::ContactMemories& memories, const state::ContactMemory& memory,
                                   const state::Stand& a, const state::Stand& b);

/// From the center of mass of b to the points of a contact, at the start of the last step, world, m.
[[nodiscard]] std::array<Vec3, 4> arms_of(const state::ContactMemories& memories, const state::ContactMemory& memory,
                                          const state::Stand& b);

}  // namespace tweenfall::contacts
