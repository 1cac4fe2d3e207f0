#pragma once

/// From poses over time to a clip of cubic keys.

#include "skeleton.h"

#include <tweenfall/anim/clip.h>

#include <functional>
#include <string>

namespace tweenfall::character {

using PoseOverTime = std::function<FigurePose(double time)>;

struct Keying {
  std::string name;
  double duration = 0;     ///< s
  int spans = 0;           ///< evenly spaced keys: one more than this
  bool is_cyclic = false;  ///< the last key repeats the first, except for the distance that the hips have moved
};

/// Rotation tracks for every joint that leaves the standing pose, and the position of the hips if they do. Keys store
/// the motion's own slopes; the four components of rotations run as cubics that are then normalized, which is glTF's
/// CUBICSPLINE.
[[nodiscard]] Clip keyed_clip(const Keying& keying, const PoseOverTime& pose_at);

}  // namespace tweenfall::character
