#pragma once

/// Plots as SVG: curves with their keys, tangents, rates and events, and what became of them in simulation.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall {

struct PlotOptions {
  std::vector<std::string> tracks;  ///< names, "node.property"; empty: all
  std::string clip;                 ///< empty: the only one, or every one that plays
};

/// Deterministic text. Values above, rates below, on one time axis; hand-offs as vertical lines and the simulated
/// continuation of a released body after them when `recording` is given.
[[nodiscard]] std::string plot_svg(const StageDescription& stage, const Recording* recording,
                                   const PlotOptions& options = {});

}  // namespace tweenfall
