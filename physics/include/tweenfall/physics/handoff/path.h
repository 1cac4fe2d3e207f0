#pragma once

/// The path of one body: where its animation wants it, at any time, with exact twist.
///
///     world(t) = anchor * clip(clock(t)), plus the offset that is still settling.
///
/// A path has no history: it can be evaluated at any time in any order.

#include <tweenfall/anim/animation.h>
#include <tweenfall/physics/handoff/rule.h>
#include <tweenfall/physics/handoff/settle_offset.h>

#include <memory>

namespace tweenfall {

namespace saving {
struct PathFields;
}

/// `world`, carried by the rigid movement that takes its pose and twist to those of `to`; its scale and shear stay.
[[nodiscard]] WorldMotion carried(const WorldMotion& world, const Motion& to) noexcept;

class Path {
 public:
  // Moving copies: what was moved from stays what it was.
  Path(const Path&) = default;
  Path& operator=(const Path&) = default;

  /// @param since  when the body came to this path, s: nothing of the path was shown before, so at that time `Side::in`
  /// equals `Side::out`
  Path(std::shared_ptr<const Animation> animation, std::size_t node, double since = 0);

  /// Pose and twist of the node's origin in the world.
  [[nodiscard]] Motion at(double stage_time, Side side = Side::out) const noexcept;

  /// The same with scale and shear.
  [[nodiscard]] WorldMotion world(double stage_time, Side side = Side::out) const noexcept;

  /// The path that continues from `body` at `time`: clock and anchor as `settings` say, while the difference settles.
  ///
  /// @param body         motion of the node's origin
  /// @param released_at  when the body left its path, s; `Clock::hold` holds the clock from there
  /// @param leader       if given, the path is moved as that one is, not to the body
  /// @throws std::invalid_argument when `settings.clip` names no clip.
  [[nodiscard]] Path recovered(double time, const HandBack& settings, const Motion& body, double released_at,
                               const Path* leader = nullptr) const;

  [[nodiscard]] const Animation& animation() const noexcept { return *animation_; }
  [[nodiscard]] std::size_t node() const noexcept { return node_; }

  /// The clock by which the animation runs for this body; the stage's own unless a hand-back has changed it.
  [[nodiscard]] const ClockOverride& clock() const noexcept { return clock_; }

  /// The side of `stage_time` that is used when `side` is asked for.
  [[nodiscard]] Side side_at(double stage_time, Side side) const noexcept {
    return stage_time <= since_ ? Side::out : side;
  }

  /// The same two, given the node's world motion in the animation's whole pose at that time by `clock()`, on `side_at`.
  [[nodiscard]] Motion at(double stage_time, const WorldMotion& authored) const noexcept;
  [[nodiscard]] WorldMotion world(double stage_time, const WorldMotion& authored) const noexcept;

  /// The same path over nodes or plays that have changed.
  [[nodiscard]] Path rebound(std::shared_ptr<const Animation> animation) const;

 private:
  friend struct saving::PathFields;
  [[nodiscard]] WorldMotion authored(double stage_time, Side side) const noexcept;
  [[nodiscard]] WorldMotion anchored(const WorldMotion& authored) const noexcept;

  std::shared_ptr<const Animation> animation_;
  std::size_t node_;
  double since_;
  ClockOverride clock_;
  std::optional<Pose> anchor_;  ///< rigid; absent: where it was authored
  SettleOffset settle_;
};

}  // namespace tweenfall
