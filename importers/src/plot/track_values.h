#pragma once

// Any track as rows of numbers: one row per component, values and rates over time.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::plotting {

/// One moment of a track; components in the order of `component_names`.
struct TrackPoint {
  double time = 0;             ///< on the plot's axis, s
  std::vector<double> values;  ///< rotations as x, y, z, w, colors as linear r, g, b, a
  std::vector<double> rates;   ///< per second; rotations: angular velocity x, y, z, rad/s
  bool starts = false;         ///< the curve jumps here: no line from the point before
};

/// Names of a track's values; of its rates, which differ for rotations. Texts have none.
[[nodiscard]] std::vector<std::string> component_names(const TrackCurve& curve);
[[nodiscard]] std::vector<std::string> rate_names(const TrackCurve& curve);

/// The recorded motion of a node, relative to its parent, in the form of a track of `property_name`; empty for
/// properties other than position and rotation.
/// @param first, last  frames, both included
[[nodiscard]] std::vector<TrackPoint> recorded_track(const Recording& recording, std::size_t node,
                                                     std::string_view property_name, std::size_t first,
                                                     std::size_t last);

}  // namespace tweenfall::plotting
