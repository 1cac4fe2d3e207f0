#pragma once

// How large the errors of a compiled clip are.

#include <span>
#include <vector>

#include "compiling/exact_pose.h"
#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

struct Instant {
  double time;  ///< s
  Side side;
};

/// Instants that tell how large the errors of channels with these knots are: where something jumps or bends, from both
/// sides, and between two knots of each channel several.
/// @param channels  the knots of each, s
/// @param bends     knots of the curves in any order, s
[[nodiscard]] std::vector<Instant> telling_instants(std::span<const std::vector<double>* const> channels,
                                                    std::vector<double> bends, double duration);

struct LargestError {
  RoundErrors errors;   ///< bounds, over some instants
  double distance = 0;  ///< the largest that matters, m
  double time = 0;      ///< when it is about as large, s
};

/// Measures clips at given instants: at some of them while forms are still sought, then at all, and where errors are
/// large also in between. Those at which one then turns out to be too far off belong to the some from then on.
class Measuring {
 public:
  /// @param arm         as in `CrowdSettings`
  /// @param rounding    as from `reach_of`, m
  /// @param last_round  errors of this round matter, and of those before it; 0 for the first
  Measuring(const ExactPose& exact, double arm, double rounding, int last_round, std::vector<Instant> instants);

  /// @param known     largest error of that clip so far; written
  /// @param measured  at how many of some that was; written
  void at_some(const CompiledClip& clip, LargestError& known, std::size_t& measured) const;
  /// @return the largest error at any time, if it is at most `allowed`; else a larger one, and there are more of some
  [[nodiscard]] LargestError at_all(const CompiledClip& clip, double allowed);

 private:
  class Comparison;
  class Whole;

  void add(const Instant& instant);
  void include(LargestError& largest, const RoundErrors& errors, double time) const;

  const ExactPose& exact_;
  double arm_, rounding_;
  int last_round_;
  std::vector<Instant> instants_, some_;
  std::vector<Pose> poses_;  // of the joints on the exact path at the first of some, as long as there is room
};

}  // namespace tweenfall::crowd
