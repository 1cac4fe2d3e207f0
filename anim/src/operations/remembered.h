#pragma once

// Caches the poses of an operation that is used several times, by springs or by several others.

#include "operations/operation.h"

namespace tweenfall::graphs {

/// Shows the pose of the operation. Without this cache, springs over springs would evaluate poses once for every path
/// through the graph.
class Remembered : public Operation {
 public:
  /// @param number index among the remembered operations of the graph
  Remembered(const Operation& operation, std::size_t number) : operation_(&operation), number_(number) {
    set_rooms(operation.rooms());
  }

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    const RecentPoses::Question question = question_at(log, moment);
    RecentPoses& recent = log.recent[number_];
    if (recent.recall(question, out)) return;
    operation_->pose(log, moment, scratch, out);
    recent.remember(question, out);
  }
  [[nodiscard]] bool recall(const Log& log, const Moment& moment, std::span<Motion> out) const noexcept override {
    return log.recent[number_].recall(question_at(log, moment), out);
  }

  [[nodiscard]] std::span<const Operation* const> operands() const noexcept override { return {&operation_, 1}; }
  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    operation_->bearers(log, moment, node, weight, out);
  }

 private:
  static RecentPoses::Question question_at(const Log& log, const Moment& moment) noexcept {
    return {moment.time, moment.start, last_instant(log, -1, moment.time, moment.side), moment.side};
  }

  const Operation* operation_;
  std::size_t number_;
};

}  // namespace tweenfall::graphs
