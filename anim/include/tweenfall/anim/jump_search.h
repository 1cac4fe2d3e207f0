#pragma once

/// When what an animation shows may jump: whoever follows it, or draws between two samples of it, must not take a jump
/// for a movement.

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/clip_jumps.h>

#include <memory>
#include <vector>

namespace tweenfall {

namespace clips {
class FormulaJumps;
}

/// Keeps where the tracks of an animation's clips jump, so that asking is fast. For any number of threads.
class JumpSearch {
 public:
  JumpSearch() = default;
  /// @param counts  which tracks are followed; none: all
  explicit JumpSearch(const Animation& animation, const TrackFilter& counts = {});
  /// The same clips and tracks, by the plays of another animation.
  [[nodiscard]] JumpSearch with_plays_of(const Animation& animation, const TrackFilter& counts = {}) const;

  /// The first time in (from, to] at which the animation may jump; infinity for none. A track jumps, a loop begins anew
  /// somewhere else, a play begins, is stopped or has a key of its weight that jumps, or it is an instant of a graph.
  /// @param animation  the one that this was made for
  [[nodiscard]] double first(const Animation& animation, double from, double to, const ClockOverride& clock = {}) const;
  /// The same, exactly the first time at which clocks, as they round, are behind the jump: just before it they are not.
  [[nodiscard]] double first_behind(const Animation& animation, double from, double to) const;

 private:
  template <class Told>
  [[nodiscard]] double first_of(const Animation& animation, double from, double to, const ClockOverride& clock,
                                const Told& told) const;

  std::vector<Clip> clips_;               // for each clip one without tracks, whose events are its jumps
  std::vector<std::vector<Clip>> seams_;  // by player, for each of its sections: the same of its loop
  std::vector<char> follows_;             // by clip: whether any of its tracks counts
  std::vector<std::shared_ptr<const clips::FormulaJumps>> formulas_;  // by clip; null where none leaps without end
};

}  // namespace tweenfall
