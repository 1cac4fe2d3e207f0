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
  bool is_cyclic = false;  ///< the last key is the first again, but for how far the hips have come
};

/// Rotation tracks for every joint that leaves the standing pose, and the position of the hips if they do. Keys carry
/// the motion's own slopes; the rotations' four parts run as cubics that are then normalized, which is glTF's
/// CUBICSPLINE.
[[nodiscard]] Clip keyed_clip(const Keying& keying, const PoseOverTime& pose_at);

}  // namespace tweenfall::character
