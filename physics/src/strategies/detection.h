#pragma once

#include <tweenfall/physics/strategies.h>

#include "state/body.h"

namespace tweenfall::strategies {

/// When two bodies are found to meet: as their own words say, of which the more careful holds, or else as the world
/// does.
[[nodiscard]] Detection detection_of(const state::Body& a, const state::Body& b, Detection of_world);

}  // namespace tweenfall::strategies
