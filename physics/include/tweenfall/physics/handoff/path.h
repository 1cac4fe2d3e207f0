#pragma once

/// The path of one body: where its animation wants it, at any time, with exact twist.
///
///     world(t) = anchor * clip(clock(t)), plus the offset that is still settling.
///
/// The offset of a body that joints hold to one above it settles as seen from that one, so that they keep their
/// distance:
///
///     world(t) = above(t) * (anchor' * clip'(clock'(t)))^-1 * anchor * clip(clock(t)), with the offset in between,
///
/// where ' marks what the path of the one above follows, and above(t) is where that path has it.
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
  /// @param above        if given, the difference settles as seen from that path, of a node above this one
  /// @throws std::invalid_argument when `settings.clip` names no clip, or `above` is of a node that is not above.
  [[nodiscard]] Path recovered(double time, const HandBack& settings, const Motion& body, double released_at,
                               const Path* leader = nullptr, const Path* above = nullptr) const;

  /// The same path from the same motion at its beginning, with the difference settling as seen from `above`.
  /// @throws std::invalid_argument when that is of a node that is not above.
  [[nodiscard]] Path along(const Path& above) const;

  /// Whether it begins at `time` with a difference that settles.
  [[nodiscard]] bool starts_settling(double time) const noexcept { return since_ == time && !settle().over(time); }

  [[nodiscard]] const Animation& animation() const noexcept { return *animation_; }
  [[nodiscard]] std::size_t node() const noexcept { return node_; }

  /// The path as seen from which the offset settles; null for none.
  [[nodiscard]] const Path* above() const noexcept { return above_.get(); }

  /// The clock by which the animation runs for this body; the stage's own unless a hand-back has changed it.
  [[nodiscard]] const ClockOverride& clock() const noexcept { return clock_; }

  /// The side of `stage_time` that is used when `side` is asked for.
  [[nodiscard]] Side side_at(double stage_time, Side side) const noexcept {
    return stage_time <= since_ ? Side::out : side;
  }

  /// The same two, given the node's world motion in the animation's whole pose at that time by `clock()`, on `side_at`.
  [[nodiscard]] Motion at(double stage_time, const WorldMotion& authored, Side side = Side::out) const noexcept;
  [[nodiscard]] WorldMotion world(double stage_time, const WorldMotion& authored, Side side = Side::out) const noexcept;

  /// The same path over nodes or plays that have changed.
  [[nodiscard]] Path rebound(std::shared_ptr<const Animation> animation) const;

 private:
  friend struct saving::PathFields;
  [[nodiscard]] WorldMotion authored(double stage_time, Side side) const noexcept;
  [[nodiscard]] WorldMotion anchored(const WorldMotion& authored) const noexcept;
  [[nodiscard]] const SettleOffset& settle() const noexcept;
  void settle_from(const Motion& body, const Settle& settle, const Path* above);
  [[nodiscard]] bool settled(double stage_time) const noexcept;
  [[nodiscard]] Motion settling(double stage_time, const Motion& anchored, Side side) const noexcept;

  std::shared_ptr<const Animation> animation_;
  std::size_t node_;
  double since_;
  ClockOverride clock_;
  std::optional<Pose> anchor_;                  ///< rigid; absent: where it was authored
  std::shared_ptr<const SettleOffset> settle_;  ///< as seen from the path above, if there is one; null for none
  std::shared_ptr<const Path> above_;           ///< null for none
};

}  // namespace tweenfall
