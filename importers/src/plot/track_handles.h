#pragma once

// Where the handles of a track's keys are: the control points of its cubic spans.

#include <tweenfall/anim/track.h>

#include <vector>

namespace tweenfall::plotting {

/// One handle of all components, as its way from its key.
struct TrackHandle {
  double key = 0;              ///< clip time of its key, s
  bool arrives = false;        ///< on the side from which the curve comes
  std::vector<double> time;    ///< s, one per component
  std::vector<double> change;  ///< in the value's unit, one per component
};

/// In order of their keys. Spans that are no cubics of their keys have none: eases, straight ways, formulas, rotations,
/// colors.
[[nodiscard]] std::vector<TrackHandle> track_handles(const TrackCurve& curve);

}  // namespace tweenfall::plotting
