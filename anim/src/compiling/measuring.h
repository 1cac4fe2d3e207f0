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
  double distance = 0;  ///< of a point of the figure from its place on the exact path, m
  double time = 0;      ///< s
};

/// Measures clips at given instants: at some of them while forms are still sought, then at all. Those at which one then
/// turns out to be too far off belong to the some from then on.
class Measuring {
 public:
  /// @param arm  as in `CrowdSettings`
  Measuring(const ExactPose& exact, double arm, std::vector<Instant> instants);

  /// @param known     largest error of that clip so far; written
  /// @param measured  at how many of some that was; written
  void at_some(const CompiledClip& clip, LargestError& known, std::size_t& measured) const;
  /// @param known  largest error of that clip at some
  /// @return the largest error of all, if it is at most `allowed`; else a larger one, and there are more of some
  [[nodiscard]] LargestError at_all(const CompiledClip& clip, const LargestError& known, double allowed);

 private:
  void add(const Instant& instant);

  const ExactPose& exact_;
  double arm_;
  std::vector<Instant> instants_, some_;
  std::vector<WorldFrame> frames_;  // of the exact path at the first of some, as long as there is room
};

}  // namespace tweenfall::crowd
