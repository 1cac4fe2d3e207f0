#pragma once

// The weights of a blend space, and the common phase of its clips.

#include <tweenfall/anim/blend_space.h>
#include <tweenfall/anim/marker_sync.h>

#include "operations/number.h"
#include "operations/operation.h"

#include <functional>
#include <variant>

namespace tweenfall::graphs {

class SpaceWeights {
 public:
  /// @throws std::invalid_argument for places that do not span a space
  SpaceWeights(const SpacePose& described, std::vector<Number> by);

  void sample(const Log& log, double time, Side side, std::span<Sample<double>> weights) const noexcept;

  /// The first time after `after` at which a parameter is set, or keys begin; infinity for none.
  [[nodiscard]] double next_setting(const Log& log, double after) const noexcept;
  /// When keys that come later begin to change the weights; infinity for none.
  [[nodiscard]] double first_change(double after) const noexcept;
  /// When a parameter was last set, or keys began, up to a time; -infinity for never.
  [[nodiscard]] double last_change(const Log& log, double time) const noexcept;
  /// The shortest of the times after which their keys come around; infinity where none do.
  [[nodiscard]] double round() const noexcept;
  /// The first setting that is hidden while looking ahead; infinity for none.
  [[nodiscard]] double first_unseen(const Log& log) const noexcept;
  /// Whether the weights may change from a time until the next setting.
  [[nodiscard]] bool flows(const Log& log, double time, Side side = Side::out) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  std::vector<Number> by_;
  std::size_t size_;
  std::variant<BlendLine, BlendPlane, BlendBands> space_;
};

/// The phase runs from the start of the state around it, with the first clip at its beginning. It stops at every
/// setting and, while weights change continuously, 480 times per second, and half as often whenever the time since then
/// has doubled from 4096 s on, so that results do not depend on the times sampled. Within a step, shares are cubics
/// from their values and rates at its ends, so that the rate is exactly the derivative of the value. A setting within a
/// step cuts it short; if the phase ran faster there than the weights say, as where a weight kinks, the excess decays
/// until the planned end of the step, so the rate does not jump.
class Phase {
 public:
  /// @param number index among the phases of the graph
  Phase(MarkerSync sync, SpaceWeights weights, std::size_t number);

  [[nodiscard]] const MarkerSync& sync() const noexcept { return sync_; }
  [[nodiscard]] const SpaceWeights& weights() const noexcept { return weights_; }

  /// The phase, with its rate.
  [[nodiscard]] Sample<double> at(const Log& log, const Moment& moment) const noexcept;

  /// How often a clip goes around between two times from `start` on.
  [[nodiscard]] double rounds(const Log& log, std::size_t clip, double duration, double start, double from,
                              double to) const noexcept;

  /// Calls `visit(time, clip, event, kind)` with the events of clips in (from, to], and at `start` where `from` is
  /// before it: those of each clip in order, but those of several clips only roughly. Where it returns false, only
  /// events of other clips that may be earlier follow.
  /// @param clips  one for each clip of the phase, with its duration; null: not asked for
  using Visit = std::function<bool(double, std::size_t, const ClipEvent&, GraphEvent::Kind)>;
  void each_event(const Log& log, std::span<const Clip* const> clips, double start, double from, double to,
                  const Visit& visit) const;

 private:
  class Step;
  struct Stop {
    double time;
    PhasePlace place;
  };
  /// The last stop from `start` up to a time; at that time itself only for `Side::out`.
  [[nodiscard]] Stop last_stop(const Log& log, double start, double time, Side side) const noexcept;
  /// The next stop without a setting.
  [[nodiscard]] double next_beat(const Log& log, double start, double after) const noexcept;
  [[nodiscard]] double next_stop(const Log& log, double start, double after) const noexcept;
  [[nodiscard]] double way(std::size_t clip, double duration, double phase) const noexcept;

  MarkerSync sync_;
  SpaceWeights weights_;
  std::size_t number_;
};

}  // namespace tweenfall::graphs
