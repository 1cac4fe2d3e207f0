#pragma once

// Where what is scripted jumps between two frames of a recording.

#include <tweenfall/anim/jump_search.h>
#include <tweenfall/physics/stage/recording.h>

#include <array>
#include <optional>

namespace tweenfall::staging {

class JumpRecorder {
 public:
  /// Adds the jumps in (from, stage.time()]; of each node at most one of each kind.
  /// @param given  what came in from outside in that time, in order
  void take(const Stage& stage, double from, std::span<const TimedInput> given, Recording& recording);

 private:
  void follow(const Animation& animation);
  std::optional<Animation> animation_;  // the one that `search_` is for
  JumpSearch search_;
  std::vector<Motion> arriving_, leaving_;  // of all nodes
  std::vector<std::array<bool, 3>> known_;  // by node and kind: whether this frame has one
};

}  // namespace tweenfall::staging
