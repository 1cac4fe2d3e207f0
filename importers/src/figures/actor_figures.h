#pragma once

// Figures of things that are not nodes: soft bodies as lines, and wheels.

#include "figures/figures.h"

namespace tweenfall::figures {

/// In meters, downward, not yet scaled to the picture.
void add_soft_figures(std::vector<Figure>& list, const Recording& recording, const StageDescription& stage,
                      Facing facing);
void add_wheel_figures(std::vector<Figure>& list, const Recording& recording, const StageDescription& stage,
                       Facing facing);

}  // namespace tweenfall::figures
