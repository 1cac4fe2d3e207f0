#pragma once

/// Phase portraits as SVG: one number of a system over another, with the field of directions, and its energy.

#include <tweenfall/physics/expression_system.h>

#include <span>
#include <string>

namespace tweenfall {

/// Deterministic text. For each system, side by side: its paths from its start and from its other starts, over arrows
/// for the direction at every point; and the energy along the path, if it has one. For the arrows, other numbers of the
/// state, and the time, are as at the start.
[[nodiscard]] std::string portrait_svg(std::span<const ExpressionSystem> systems);

}  // namespace tweenfall
