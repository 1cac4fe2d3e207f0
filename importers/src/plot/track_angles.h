#pragma once

// Rotations as people read them: degrees that do not wrap.

#include "plot/plotted_track.h"

namespace tweenfall::plotting {

/// Changes a plotted rotation from x, y, z, w and rad/s to degrees and degrees per second: where all of it turns about
/// one axis, the angle about that; else three angles, intrinsic x, y, z. From the first point on neither is wrapped.
void turn_into_angles(PlottedTrack& plotted);

/// The same of a single angle.
void turn_into_degrees(PlottedTrack& plotted);

}  // namespace tweenfall::plotting
