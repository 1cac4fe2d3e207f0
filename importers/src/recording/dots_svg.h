#pragma once

// Particles in the animated picture of a recording: dots, frame by frame.

#include "figures/figures.h"
#include "plot/svg_writer.h"

#include <string>

namespace tweenfall::recordings {

struct DotsPicture {
  const Recording& recording;
  const figures::SideView& view;
  double start, length;  // s
  double rest;           // time that the last frame stays, s
};

/// One path with the dots of one frame after the other; of very many particles only every k-th is drawn, for its whole
/// life.
void draw_dots(plotting::SvgWriter& svg, const DotsPicture& picture, const ParticlesRecord& particles,
               const std::string& color);

}  // namespace tweenfall::recordings
