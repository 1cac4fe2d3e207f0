#pragma once

/// Plots as SVG: curves with their keys, tangents, rates and events, and what became of them in simulation.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall {

struct PlotOptions {
  std::vector<std::string> tracks;  ///< names, "node.property"; empty: all
  std::string clip;                 ///< empty: the only one, or every one that plays
  std::size_t most = 64;            ///< tracks drawn where `tracks` names none
  int columns = 1;                  ///< side by side; 1 to 6
  bool rates = true;                ///< below the values
};

/// Deterministic text. Values above, rates below, on one time axis; rotations in degrees; the handles of keys that have
/// some; what curves do beyond their keys, shaded, where they do not rest; hand-offs as vertical lines and the
/// simulated continuation of a released body after them when `recording` is given.
/// @throws std::invalid_argument naming what there is, for a track or clip that is not; for columns out of range.
[[nodiscard]] std::string plot_svg(const StageDescription& stage, const Recording* recording,
                                   const PlotOptions& options = {});

}  // namespace tweenfall
