#pragma once

// The way that a figure goes: the ways of the clips that bear it, from loop to loop and from clip to clip.

#include <tweenfall/anim/root_motion.h>

#include "graph/binder.h"

namespace tweenfall::graphs {

/// It runs from the start of the state around it, from where the clips have the figure then. The ways of several clips
/// are mixed step by step, 480 times a second from each instant on: on a step weights are cubics by what they and their
/// rates are at its ends, so that the way has no sudden changes of velocity that the clips do not have, and its rate is
/// everywhere that of its value. Where something happens on the way a step is broken off, and what it went faster there
/// than the clips have it, as where a weight kinks, dies away on the next.
/// Where one clip bears it alone, its loops are repeated in closed form, so that nothing drifts.
class Travel {
 public:
  /// @param base    what bears the figure; null for nothing
  /// @param number  among those of the graph
  Travel(const Hierarchy& nodes, RootMotion root, const Operation* base, std::size_t number);

  /// Where it has come to, with its rates.
  /// @param room  of one pose, to work in
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
  /// Where a clip has the figure, and in which of its loops.
  struct Place {
    Motion motion;
    double cycle;
  };
  /// From one stop to the next.
  struct Step {
    double start, from, end;  // `end`: unless something happens before
    bool alone;               // no more than one clip bears it, and that fully, until something happens
    Twist haste;              // see `TravelPlace`
  };
  [[nodiscard]] ClipClock clock_of(const Log& log, const Bearer& bearer, double time, Side side) const noexcept;
  [[nodiscard]] static Motion step_of(const Known& known, const Place& from, const Place& to) noexcept;
  /// By how much faster a step that is broken off went than the clips have it.
  [[nodiscard]] Twist haste_at(const Log& log, double start, double time, const Motion& step,
                               std::span<Motion> room) const noexcept;
  [[nodiscard]] Pose place_at_start(const Log& log, double start, std::span<Motion> room) const noexcept;
  /// @param first  those at its beginning
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
