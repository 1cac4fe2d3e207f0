#include "machine/course.h"

#include <algorithm>

namespace tweenfall::graphs {

namespace {

class Course {
 public:
  Course(Log& log, const Graph& graph, const PoseBelow& below, std::span<Motion> room)
      : log_(log), graph_(graph), below_(below), room_(room) {}

  void run(double until) {
    if (log_.known < 0) {
      for (const Operation* machine : graph_.compiled().machines) as_machine(*machine).begin(log_);
      happen(0);
    }
    while (log_.known < until) {
      const std::optional<double> next = next_instant(until);
      if (!next) {
        log_.known = until;
        return;
      }
      happen(*next);
    }
  }

 private:
  static const Machine& as_machine(const Operation& operation) { return static_cast<const Machine&>(operation); }

  [[nodiscard]] std::optional<double> next_instant(double until) const {
    std::optional<double> first;
    const auto meet = [&](double time) {
      if (time > log_.known && time <= first.value_or(until)) first = time;
    };
    for (const std::vector<Setting>& settings : log_.settings)
      if (const auto next = std::ranges::upper_bound(settings, log_.known, {}, &Setting::time); next != settings.end())
        meet(next->time);
    if (const auto next = std::ranges::upper_bound(log_.sent, log_.known, {}, &Sending::time); next != log_.sent.end())
      meet(next->time);
    for (const Operation* machine : graph_.compiled().machines)
      if (const auto next = as_machine(*machine).next_instant(log_, log_.known, first.value_or(until))) meet(*next);
    return first;
  }

  void happen(double time) {
    for (std::size_t m = 0; m < graph_.compiled().machines.size(); ++m) happen(m, time);
    log_.known = time;
  }

  // Events of clips and what needs none come first, then what was sent, each through one transition.
  void happen(std::size_t number, double time) {
    const Machine& machine = as_machine(*graph_.compiled().machines[number]);
    std::size_t taken = 0;
    const auto take = [&](std::size_t transition) {
      const bool full = log_.passages[number].size() >= most_passages;
      if (!full) pass(machine, number, transition, time);
      if (!full && ++taken < most_transitions_at_once) return true;
      log_.stops.push_back({time, number});
      return false;
    };
    const auto settle_down = [&] {
      for (;;) {
        const std::size_t transition = machine.transition_at(log_, time, std::nullopt);
        if (transition == GraphPassage::no_transition) return true;
        if (!take(transition)) return false;
      }
    };
    if (!settle_down()) return;
    auto event = std::ranges::lower_bound(log_.sent, time, {}, &Sending::time);
    for (; event != log_.sent.end() && event->time == time; ++event) {
      const std::size_t transition = machine.transition_at(log_, time, event->event);
      if (transition == GraphPassage::no_transition) continue;
      if (!take(transition) || !settle_down()) return;
    }
  }

  void pass(const Machine& machine, std::size_t number, std::size_t transition, double time) {
    Passage passage = machine.passage(log_, transition, time);
    if (passage.settles) {
      const std::size_t nodes = graph_.nodes().size();
      const std::span<Motion> in = room_.first(nodes), out = room_.subspan(nodes, nodes);
      below_(time, Side::in, in);
      below_(time, Side::out, out);
      machine.measure(log_, passage, in, out, &below_, room_.data() + 2 * nodes);
    }
    log_.passages[number].push_back(std::move(passage));
  }

  Log& log_;
  const Graph& graph_;
  const PoseBelow& below_;
  std::span<Motion> room_;
};

}  // namespace

void make_known(Log& log, const Graph& graph, double until, const PoseBelow& below, std::span<Motion> room) {
  Course(log, graph, below, room).run(until);
}

std::size_t rooms_of(const Graph& graph) noexcept {
  std::size_t most = 0;
  for (const auto& operation : graph.compiled().operations) most = std::max(most, operation->rooms());
  return most + 4;  // two that lie below, and two that are compared
}

}  // namespace tweenfall::graphs
