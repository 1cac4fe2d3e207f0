#pragma once

// The exact path, in the form needed for compiling.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <span>
#include <string>
#include <vector>

#include "pose/bound_clip.h"

namespace tweenfall::crowd {

/// The points of a figure on which errors are measured: three for each joint, an arm along each of its axes.
using Points = std::vector<Vec3>;

class ExactPose {
 public:
  /// @throws std::invalid_argument for tracks that fit no node
  ExactPose(const Clip& clip, const Hierarchy& nodes);

  [[nodiscard]] const Hierarchy& nodes() const { return nodes_; }
  [[nodiscard]] double duration() const { return clip_.duration; }
  [[nodiscard]] const Clip& clip() const { return clip_; }
  [[nodiscard]] const pose::BoundClip& bound() const { return bound_; }

  /// One joint at a time of the clip.
  [[nodiscard]] Motion joint(std::size_t node, double time, Side side) const;
  /// All of them. @param local  written, one for each node
  void sample(double time, Side side, std::span<Motion> local) const;

 private:
  [[nodiscard]] ClipClock clock(double time, Side side) const;

  const Clip& clip_;
  const Hierarchy& nodes_;
  std::string problems_;
  pose::BoundClip bound_;
};

}  // namespace tweenfall::crowd
