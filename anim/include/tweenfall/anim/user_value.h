#pragma once

/// The value of a user track: a track of a property that is not ours, such as "hips.effort".

#include <tweenfall/curves/curve.h>

#include <string>
#include <variant>
#include <vector>

namespace tweenfall {

/// A value of one of the kinds of `TrackCurve`, in that order. Rates are exact, and per second of the stage; those of
/// rotations are angular velocities, rad/s. Accelerations are not told: they are 0. Switches and texts have no rate.
using UserValue = std::variant<Sample<double>, Sample<Vec2>, Sample<Vec3>, Sample<Vec4>, Sample<Color>, Sample<Quat>,
                               std::vector<Sample<double>>, bool, std::string>;

}  // namespace tweenfall
