#pragma once

// What every writer asks of a recording before it writes a byte.

#include <tweenfall/physics/stage/recording.h>

namespace tweenfall {

/// @throws std::invalid_argument naming the node and the frame: lists of different lengths, numbers that are not
///         finite, times that do not increase, a hand-off or an event of a node that is not there.
void check_recording(const Recording& recording);

}  // namespace tweenfall
