#pragma once

#include "state/body.h"

namespace tweenfall {

/// Velocity at the center of mass with which an immovable body gets to its target in `dt`: what contacts feel.
/// Zero without a target.
[[nodiscard]] Twist displacement_rate(const Body& body, double dt);

/// Ends the step of a keyed body: exactly on its target with the target's own twist, or at rest where it is.
void arrive(Body& body);

}  // namespace tweenfall
