#pragma once

// Rotations as people read them: degrees that do not wrap.

#include "plot/plotted_track.h"

namespace tweenfall::plotting {

/// Changes a plotted rotation from x, y, z, w and rad/s to degrees and degrees per second: the angle if all turns are
/// about one axis; else three angles, intrinsic x, y, z. Neither is wrapped after the first point.
void turn_into_angles(PlottedTrack& plotted);

/// The same for a single angle.
void turn_into_degrees(PlottedTrack& plotted);

}  // namespace tweenfall::plotting
