#pragma once

/// Any track as numbers at a moment of its clip, including the gains of loops: for tables and plots.

#include <tweenfall/anim/play.h>

#include <string>
#include <vector>

namespace tweenfall {

/// A track at one moment.
struct TrackSample {
  std::vector<double> value;  ///< rotations x y z w, colors linear red green blue alpha; 1 or 0 for a switch
  std::vector<double> rate;   ///< per second of the clock; rotations angular velocity, rad/s; empty where there is none
  std::string text;           ///< the value of a text track
};

/// The track at a clock. A repeat-offset loop continues from where it ended: numbers, positions and rotations gain
/// their change in each round; scales, colors, weights, switches and texts start over.
[[nodiscard]] TrackSample sample_track(const Clip& clip, const Track& track, const ClipClock& clock);

}  // namespace tweenfall
