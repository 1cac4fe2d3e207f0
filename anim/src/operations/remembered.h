#pragma once

// An operation that is asked for the same pose again and again, as springs and those that several others name are.

#include "operations/operation.h"

namespace tweenfall::graphs {

/// Shows what the operation shows. Without it, springs over springs would ask for poses as often as there are ways
/// through the graph.
class Remembered : public Operation {
 public:
  /// @param number  among those of the graph that remember
  Remembered(const Operation& operation, std::size_t number) : operation_(operation), number_(number) {
    set_rooms(operation.rooms());
  }

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    const RecentPoses::Question question = question_at(log, moment);
    RecentPoses& recent = log.recent[number_];
    if (recent.recall(question, out)) return;
    operation_.pose(log, moment, scratch, out);
    recent.remember(question, out);
  }
  [[nodiscard]] bool recall(const Log& log, const Moment& moment, std::span<Motion> out) const noexcept override {
    return log.recent[number_].recall(question_at(log, moment), out);
  }

  [[nodiscard]] std::vector<const Operation*> operands() const override { return {&operation_}; }
  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    operation_.bearers(log, moment, node, weight, out);
  }

 private:
  static RecentPoses::Question question_at(const Log& log, const Moment& moment) noexcept {
    return {moment.time, moment.start, last_instant(log, -1, moment.time, moment.side), moment.side};
  }

  const Operation& operation_;
  std::size_t number_;
};

}  // namespace tweenfall::graphs
