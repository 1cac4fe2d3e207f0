#pragma once

// The exact path, in the form needed for compiling.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowd/compiled_clip.h"
#include "pose/bound_clip.h"

namespace tweenfall::crowd {

/// What a track moves; none for one that moves no joint.
[[nodiscard]] std::optional<Kind> kind_of(const Track& track);

/// The points of a figure on which errors are measured: three for each joint, an arm along each of its axes.
using Points = std::vector<Vec3>;

class ExactPose {
 public:
  /// @throws std::invalid_argument for tracks that fit no node
  ExactPose(const Clip& clip, const Hierarchy& nodes);
  ExactPose(const ExactPose&) = delete;
  ExactPose& operator=(const ExactPose&) = delete;

  [[nodiscard]] const Hierarchy& nodes() const { return nodes_; }
  [[nodiscard]] double duration() const { return clip_.duration; }
  [[nodiscard]] const Clip& clip() const { return clip_; }
  [[nodiscard]] const pose::BoundClip& bound() const { return bound_; }

  /// One joint at a time of the clip; only what is of that kind is moved.
  [[nodiscard]] Motion joint(std::size_t node, Kind kind, double time, Side side) const;
  /// All of them. @param local  written, one for each node  @param round  of a loop with offset
  void sample(double time, Side side, std::span<Motion> local, int round = 0) const;

 private:
  [[nodiscard]] ClipClock clock(double time, Side side) const;

  const Clip& clip_;
  const Hierarchy& nodes_;
  std::string problems_;
  pose::BoundClip bound_;
  std::array<Clip, 3> clips_;  // by kind: its tracks alone
  std::vector<pose::BoundClip> parts_;
};

}  // namespace tweenfall::crowd
