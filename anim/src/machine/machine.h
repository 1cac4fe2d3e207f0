#pragma once

// A state machine: its states, its transitions, and its pose.

#include "machine/condition.h"

namespace tweenfall::graphs {

/// The first `count` passages of a machine.
struct Passages {
  const Record<Passage>* list;
  std::size_t count;

  [[nodiscard]] const Passage& operator[](std::size_t i) const noexcept { return (*list)[i]; }
};

class Machine : public Operation {
 public:
  struct Transition {
    std::vector<char> from;  // by state
    std::size_t to;
    std::vector<Condition> when;
    GraphChange change;
  };
  Machine(const GraphDescription& description, std::size_t number, std::vector<const Operation*> states,
          std::vector<Transition> transitions, std::size_t start);

  // Output
  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override;
  [[nodiscard]] std::span<const Operation* const> operands() const noexcept override { return states_; }
  void events(const Log& log, const Stretch& stretch, std::vector<GraphEvent>& out) const override;
  [[nodiscard]] std::optional<double> next_event(const Log& log, std::string_view name, double start, double after,
                                                 double until) const override;
  [[nodiscard]] double end(const Log& log, double start) const noexcept override;
  [[nodiscard]] std::optional<double> next_jump(const Log& log, double start, const Search& search) const override;
  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override;
  [[nodiscard]] std::vector<GraphActivity> activity(const Log& log, double time) const;

  // Course
  void begin(Log& log) const;
  /// The first time in (after, until] at which it may leave its state without an input.
  [[nodiscard]] std::optional<double> next_instant(const Log& log, double after, double until) const;
  /// The first transition whose conditions hold at a time; `no_transition` for none.
  /// @param event the event handled; empty: those of the state's clips
  [[nodiscard]] std::size_t transition_at(const Log& log, double time, std::optional<std::string_view> event) const;
  [[nodiscard]] const Transition& transition(std::size_t index) const noexcept { return transitions_[index]; }
  /// The passage made by a transition. If its difference settles, that must still be measured.
  [[nodiscard]] Passage passage(const Log& log, std::size_t transition, double time) const;
  /// Measures the difference, before the passage is in the log. @param below_in, below_out, below the pose below the
  /// graph, arriving and leaving, and at any time @param free `rooms() + 2` poses
  void measure(const Log& log, Passage& passage, std::span<const Motion> below_in, std::span<const Motion> below_out,
               const GraphGround* below, Motion* free) const;

 private:
  void show(const Log& log, const Passages& passages, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept;
  [[nodiscard]] const Passage& current(const Log& log) const noexcept { return log.passages[number_].back(); }
  [[nodiscard]] Standing standing(const Log& log) const noexcept {
    return {*states_[current(log).state], current(log).time};
  }

  const GraphDescription& description_;
  std::size_t number_;
  std::vector<const Operation*> states_;
  std::vector<Transition> transitions_;
  std::size_t start_;
};

}  // namespace tweenfall::graphs
