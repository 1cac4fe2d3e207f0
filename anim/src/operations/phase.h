#pragma once

// The weights of a blend space, and the phase in which its clips run.

#include <tweenfall/anim/blend_space.h>
#include <tweenfall/anim/marker_sync.h>

#include "operations/number.h"
#include "operations/operation.h"

#include <functional>
#include <variant>

namespace tweenfall::graphs {

class SpaceWeights {
 public:
  /// @throws std::invalid_argument for places that span no space
  SpaceWeights(const SpacePose& described, std::vector<Number> by);

  void sample(const Log& log, double time, Side side, std::span<Sample<double>> weights) const noexcept;

  /// The first time after `after` at which a parameter is set; infinity for none.
  [[nodiscard]] double next_setting(const Log& log, double after) const noexcept;
  /// The first setting that is not seen; infinity for none.
  [[nodiscard]] double first_unseen(const Log& log) const noexcept;
  /// Whether they may change between settings.
  [[nodiscard]] bool flows() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  std::vector<Number> by_;
  std::size_t size_;
  std::variant<BlendLine, BlendPlane, BlendBands> space_;
};

/// It runs from the start of the state around it, with the first clip at its beginning. On the way it stops at every
/// setting and, where the weights flow, 480 times a second: wherever it is asked from, it comes the same way. On a step
/// shares are cubics by what they and their rates are at its ends, so that its rate is everywhere that of its value.
/// Where something is set on the way, the step is broken off, and what it went faster there than by the weights
/// themselves, as where one kinks, dies away until the step would have ended: the rate has no jump of its own.
class Phase {
 public:
  /// @param number  among the phases of the graph
  Phase(MarkerSync sync, SpaceWeights weights, std::size_t number);

  [[nodiscard]] const MarkerSync& sync() const noexcept { return sync_; }
  [[nodiscard]] const SpaceWeights& weights() const noexcept { return weights_; }

  /// With its rate.
  [[nodiscard]] Sample<double> at(const Log& log, const Moment& moment) const noexcept;

  /// Calls `visit(time, event, kind)` with the events of a clip in (from, to], and at `start` where `from` is before
  /// it, in order, until it returns false.
  using Visit = std::function<bool(double, const ClipEvent&, GraphEvent::Kind)>;
  void each_event(const Log& log, std::size_t clip, const Clip& described, double start, double from, double to,
                  const Visit& visit) const;

 private:
  class Step;
  struct Stop {
    double time;
    PhasePlace place;
  };
  /// The last stop from `start` to a time; at that time itself only where it leaves.
  [[nodiscard]] Stop last_stop(const Log& log, double start, double time, Side side) const noexcept;
  /// The next stop where nothing is set.
  [[nodiscard]] double next_beat(double start, double after) const noexcept;
  [[nodiscard]] double next_stop(const Log& log, double start, double after) const noexcept;
  [[nodiscard]] double way(std::size_t clip, double duration, double phase) const noexcept;

  MarkerSync sync_;
  SpaceWeights weights_;
  std::size_t number_;
};

}  // namespace tweenfall::graphs
