#pragma once

// Colors and morph weights of clips.

#include <tweenfall/anim/node_look.h>

#include "pose/bound_clip.h"

namespace tweenfall::pose {

/// Layers a clip's color and weights of a node over the look below.
void lay_look_over(const BoundClip::Entry& entry, const ClipClock& clock, const Sample<double>& weight,
                   const Node& node, NodeLook& look);

}  // namespace tweenfall::pose
