#pragma once

/// The sample character: a skinned figure with a walk, a wave and a get-up, made entirely by this program.

#include <tweenfall/importers/model.h>

namespace tweenfall::character {

/// Nodes "Character" (above the 21 joints; move it to move the figure), the joints, and "Body" (the mesh); clips
/// "Walk", "WalkForward", "Wave", "GetUp".
[[nodiscard]] Model make_character();

}  // namespace tweenfall::character
