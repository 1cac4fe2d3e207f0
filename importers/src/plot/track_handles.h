#pragma once

// The handles of a track's keys: the control points of its cubic spans.

#include <tweenfall/anim/track.h>

#include <vector>

namespace tweenfall::plotting {

/// One handle for all components, relative to its key.
struct TrackHandle {
  double key = 0;              ///< clip time of its key, s
  bool arrives = false;        ///< on the arriving side
  std::vector<double> time;    ///< s, one per component
  std::vector<double> change;  ///< in the value's unit, one per component
};

/// In order of their keys. Other spans have none: eases, straight lines, formulas, rotations,
/// colors.
[[nodiscard]] std::vector<TrackHandle> track_handles(const TrackCurve& curve);

}  // namespace tweenfall::plotting
