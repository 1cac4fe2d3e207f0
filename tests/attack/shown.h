#pragma once

// A stage run and written in every form that the command writes.

#include <tweenfall/physics/stage/description.h>
#include <tweenfall/physics/stage/input.h>

#include <span>
#include <string>

namespace tweenfall::attack {

/// What is wrong with any form of the first moments of a stage: a NaN, or bytes that are not UTF-8; empty if all is
/// well, or if the run ends in words because a motion is no longer finite.
/// @param seconds  longest time that is recorded
/// @param inputs   given during the run; if one is refused, all is well too
[[nodiscard]] std::string fault_of_run(const StageDescription& description, double seconds,
                                       std::span<const TimedInput> inputs = {});

}  // namespace tweenfall::attack
