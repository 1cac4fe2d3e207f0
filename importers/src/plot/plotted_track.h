#pragma once

// The content of a plot for each track, collected before anything is drawn.

#include "plot/track_values.h"

#include <tweenfall/importers/plot.h>

#include <cmath>

namespace tweenfall::plotting {

/// The end of a component's handle, relative to its key.
struct PlottedHandle {
  std::size_t component = 0;
  double time = 0, change = 0;  ///< s, the value's unit
};

struct PlottedKey {
  double time = 0;
  TrackPoint in, out;
  bool first = false, last = false;  ///< no curve before or after
  std::vector<PlottedHandle> handles{};
};

/// A line across the panels.
struct PlottedMoment {
  double time = 0;
  std::string name;
  bool handoff = false;
};

/// Numbers beyond this are not drawn: their differences, with room around them, would overflow.
inline constexpr double largest_plotted = 1e300;

struct PlottedTrack {
  const Track* track = nullptr;
  std::string title;
  std::vector<std::string> names, rate_names;  ///< of the components
  std::string unit, rate_unit;                 ///< empty where the unit is the author's
  std::vector<TrackPoint> curve;               ///< NaN: not drawn
  std::vector<PlottedKey> keys;
  std::vector<PlottedMoment> moments;
  std::vector<std::vector<TrackPoint>> simulated;     ///< one for each stretch in which the body was not keyed
  double first_key = -HUGE_VAL, last_key = HUGE_VAL;  ///< s; the curve beyond them is not keyed
  bool lacks_values = false, lacks_rates = false;     ///< some are too large or not numbers, and NaN here
};

struct PlottedStage {
  double from = 0, until = 1;  ///< s: stage time when there is a recording, else clip time
  std::vector<PlottedTrack> tracks;
  std::size_t left_out = 0;  ///< tracks beyond the most that a plot shows
};

/// @throws std::invalid_argument naming what exists, for a clip or a track that does not.
[[nodiscard]] PlottedStage plotted_tracks(const StageDescription& stage, const Recording* recording,
                                          const PlotOptions& options);

}  // namespace tweenfall::plotting
