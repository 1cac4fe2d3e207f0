#pragma once

// Particles in the form of the page.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall::page {

/// Adds the "particles" of a page: positions and velocities frame by frame; of very many particles only every k-th, for
/// its whole life. Adds nothing if a recording has none.
void append_page_particles(std::string& out, const Recording& recording, const StageDescription& stage,
                           const std::vector<std::size_t>& frames);

}  // namespace tweenfall::page
