#pragma once

// The animation of a whole stage at one moment, sampled once for all bodies that follow it.

#include "stage/stage_data.h"

namespace tweenfall::staging {

class WholePose {
 public:
  /// Nothing is sampled before the first query.
  WholePose(const StageState& state, double time, Side side) : state_(state), time_(time), side_(side) {}

  [[nodiscard]] const Motion& local(NodeId node);          ///< by the stage's own clock
  [[nodiscard]] const WorldMotion& authored(NodeId node);  ///< the same, in the world

  /// Where a body's path has it; a body with a clock of its own is sampled separately.
  [[nodiscard]] Motion at(const StagedBody& body);
  [[nodiscard]] WorldMotion world(const StagedBody& body);

 private:
  [[nodiscard]] bool follows(const StagedBody& body) const;

  const StageState& state_;
  double time_;
  Side side_;
  std::vector<Motion> local_;
  std::vector<WorldMotion> world_;
};

}  // namespace tweenfall::staging
