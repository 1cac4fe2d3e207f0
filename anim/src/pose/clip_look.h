#pragma once

// Colors and morph weights of clips.

#include <tweenfall/anim/node_look.h>

#include "pose/bound_clip.h"

namespace tweenfall::pose {

/// Lays what a clip has for a node over what it looks like below.
/// @param yields  where something is below, that shows alone
void lay_look_over(const BoundClip::Entry& entry, const ClipClock& clock, bool yields, const Sample<double>& weight,
                   const Node& node, NodeLook& look);

}  // namespace tweenfall::pose
