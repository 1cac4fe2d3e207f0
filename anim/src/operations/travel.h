#pragma once

// The path of a figure: the root motion of its clips, accumulated from loop to loop and from clip to clip.

#include <tweenfall/anim/root_motion.h>

#include "graph/binder.h"

namespace tweenfall::graphs {

/// It begins at the start of the state around it, where the clips place the figure then. The movements of several clips
/// are mixed in steps, 480 per second from each instant on: within a step, weights are cubics from their values and
/// rates at its ends, so that the velocity jumps only where that of the clips does, and the rate is exactly the
/// derivative of the value. Something that happens within a step cuts it short; if the figure moved faster there than
/// the clips say, for example because a weight kinks, the excess decays in the next step. While a single clip moves the
/// figure, its loops are repeated in closed form, so that nothing drifts; and so is the lap after which several clips
/// of constant weights are all at their start again.
class Travel {
 public:
  /// @param base the pose whose clips move the figure; null for none
  /// @param number index among the travels of the graph
  Travel(const Hierarchy& nodes, RootMotion root, const Operation* base, std::size_t number);

  /// The pose reached, with its rates.
  /// @param room scratch space for one pose
  [[nodiscard]] Motion at(const Log& log, const Moment& moment, std::span<Motion> room) const noexcept;

 private:
  struct Known {
    const Operation* operation;
    std::size_t clip;
    const pose::BoundClip* bound;
    RootTravel travel;
  };
  void know(const Operation& operation);
  [[nodiscard]] std::vector<Known>::const_iterator known_of(const Bearer& bearer) const noexcept;
  [[nodiscard]] Bearers bearers_at(const Log& log, const Moment& moment) const noexcept;
  [[nodiscard]] Motion carried(const pose::BoundClip& clip, const ClipClock& clock,
                               std::span<Motion> room) const noexcept;
  /// The place of the figure by a clip, and the loop in which it is.
  struct Place {
    Motion motion;
    double cycle;
  };
  /// From one stop to the next.
  struct Step {
    double start, from, end;  // `end`: if nothing happens before
    bool alone;               // at most one clip moves it, with full weight, until something happens
    Twist haste;              // see `TravelPlace`
  };
  [[nodiscard]] ClipClock clock_of(const Log& log, const Bearer& bearer, double time, Side side) const noexcept;
  [[nodiscard]] static Motion step_of(const Known& known, const Place& from, const Place& to) noexcept;
  /// How much faster than the clips the figure moved at the end of a step that was cut short.
  [[nodiscard]] Twist haste_at(const Log& log, double start, double time, const Motion& step,
                               std::span<Motion> room) const noexcept;
  /// Beyond the first lap.
  [[nodiscard]] Motion lapped(const Log& log, const Moment& moment, const TravelPlace& reached,
                              std::span<Motion> room) const noexcept;
  /// After how many seconds these clips are all at their start again, or infinity; empty where their weights may
  /// change, or one of them does not go around for ever.
  [[nodiscard]] static std::optional<double> lap_of(const Log& log, const Bearers& bearers, double time) noexcept;
  [[nodiscard]] Pose place_at_start(const Log& log, double start, std::span<Motion> room) const noexcept;
  /// @param first the bearers at its beginning
  [[nodiscard]] Motion step(const Log& log, const Bearers& first, const Step& step, double to, Side side,
                            std::span<Motion> room) const noexcept;

  const Hierarchy& nodes_;
  RootMotion root_;
  std::vector<std::size_t> chain_;  // the node and all above it
  const Operation* base_;
  std::size_t number_;
  std::vector<Known> known_;
};

}  // namespace tweenfall::graphs
