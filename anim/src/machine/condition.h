#pragma once

// The conditions of transitions: the exact first instant at which one holds.

#include "graph/binder.h"

#include <optional>
#include <string_view>

namespace tweenfall::graphs {

/// A state as its conditions see it.
struct Standing {
  const Operation& pose;
  double since;
};

struct Condition {
  GraphCondition::Kind kind;
  std::string event;
  std::size_t parameter = 0;
  double value = 0;

  /// Whether it holds at a time. @param event the event handled; empty: those of the state's clips at that time
  [[nodiscard]] bool holds(const Log& log, const GraphDescription& description, const Standing& state, double time,
                           std::optional<std::string_view> event) const;

  /// The first time in (after, until] at which it may begin to hold without an input.
  [[nodiscard]] std::optional<double> next(const Log& log, const GraphDescription& description, const Standing& state,
                                           double after, double until) const;
};

/// @param place  of the condition
[[nodiscard]] std::optional<Condition> bound(const GraphCondition& condition, const Place& place, Binder& binder);

}  // namespace tweenfall::graphs
