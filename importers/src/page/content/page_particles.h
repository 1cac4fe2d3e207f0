#pragma once

// Particles as the page carries them.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall::page {

/// Adds the "particles" of a page: places and velocities frame by frame; of very many only every k-th, each through
/// its whole life. Nothing where a recording has none.
void append_page_particles(std::string& out, const Recording& recording, const StageDescription& stage,
                           const std::vector<std::size_t>& frames);

}  // namespace tweenfall::page
