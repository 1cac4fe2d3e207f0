#pragma once

#include <tweenfall/physics/world.h>

namespace tweenfall::contacts {

/// Up to this restitution, blows hardly spring back: when exactly they happen does not matter.
constexpr double dull = 0.25;

/// The rule of a pair: of the two bodies' rules, the one that comes later in `Combine`.
[[nodiscard]] double combined_friction(double a, Combine rule_a, double b, Combine rule_b);
[[nodiscard]] double combined_restitution(double a, Combine rule_a, double b, Combine rule_b);

}  // namespace tweenfall::contacts
