#pragma once

/// The path of one body: where its animation wants it, at any time, with exact twist.
///
///     world(t) = anchor * clip(clock(t)), plus the offset that still settles.

#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/settle.h>
#include <tweenfall/physics/handoff/rule.h>

#include <array>
#include <memory>

namespace tweenfall {

/// The offset that a hand-back leaves, dying away; part of the path, so colliders follow it.
class SettleOffset {
 public:
  SettleOffset() = default;  ///< no offset

  /// Starts at `time` from exactly `body`, while the path is at `path`.
  SettleOffset(const Settle& settle, double time, const Motion& path, const Motion& body);

  /// `path` with the offset of that time applied.
  [[nodiscard]] Motion apply(double time, const Motion& path) const noexcept;
  [[nodiscard]] bool active(double time) const noexcept;

 private:
  Settle settle_ = {};
  double start_ = 0;
  bool any_ = false;
  Motion body_ = {};                       ///< for dead_blend: the motion extrapolated
  std::array<QuinticDecay, 6> quintic_{};  ///< x, y, z, then the rotation vector, world axes
  std::array<SpringDecay, 6> spring_{};
};

class Path {
 public:
  Path(std::shared_ptr<const Animation> animation, std::size_t node);

  /// Pose and twist of the node's origin in the world.
  [[nodiscard]] Motion at(double stage_time, Side side = Side::out) const noexcept;

  /// A path that takes the body over from `body` at `time`: clock and anchor chosen, offset settling.
  [[nodiscard]] Path recovered(double time, const HandBack& settings, const Motion& body, double released_at) const;

  [[nodiscard]] const Animation& animation() const noexcept { return *animation_; }

 private:
  std::shared_ptr<const Animation> animation_;
  std::size_t node_;
  Pose anchor_ = {};
  SettleOffset settle_;
};

}  // namespace tweenfall
