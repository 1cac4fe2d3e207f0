#pragma once

/// Plots as SVG: curves with their keys, tangents, rates and events, and their continuation in simulation.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall {

struct PlotOptions {
  std::vector<std::string> tracks;  ///< names, "node.property"; empty: all
  std::string clip;                 ///< empty: the only one, or every one that plays
  std::size_t most = 64;            ///< greatest number of tracks drawn where `tracks` is empty
  int columns = 1;                  ///< side by side; 1 to 6
  bool rates = true;                ///< below the values
};

/// Deterministic text. Values above, rates below, on one time axis; rotations in degrees; the handles of keys that have
/// handles; beyond its keys, a curve that does not hold is drawn shaded; hand-offs as vertical lines and the simulated
/// continuation of a released body after them when `recording` is given.
/// @throws std::invalid_argument for an unknown track or clip, listing the known ones; for columns out of range.
[[nodiscard]] std::string plot_svg(const StageDescription& stage, const Recording* recording,
                                   const PlotOptions& options = {});

}  // namespace tweenfall
