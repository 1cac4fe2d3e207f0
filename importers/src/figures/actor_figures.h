#pragma once

// Figures of what is beside nodes: soft bodies as lines, and wheels.

#include "figures/figures.h"

namespace tweenfall::figures {

/// Not yet in the picture: meters, y downward.
void add_soft_figures(std::vector<Figure>& list, const Recording& recording, const StageDescription& stage, int across);
void add_wheel_figures(std::vector<Figure>& list, const Recording& recording, const StageDescription& stage,
                       int across);

}  // namespace tweenfall::figures
