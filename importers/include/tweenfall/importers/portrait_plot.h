#pragma once

/// Phase portraits as SVG: one number of a system over another, with the field of directions, and its energy.

#include <tweenfall/physics/expression_system.h>

#include <span>
#include <string>

namespace tweenfall {

/// Deterministic text. Of each system, side by side: where it goes from its start and from its others, over arrows that
/// say where it would go from anywhere; and the energy along the way, where it has one. Other numbers of the state, and
/// the time, are for the arrows as at the start.
[[nodiscard]] std::string portrait_svg(std::span<const ExpressionSystem> systems);

}  // namespace tweenfall
