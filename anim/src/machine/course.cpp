#include "machine/course.h"

#include <algorithm>

namespace tweenfall::graphs {

namespace {

class Course {
 public:
  Course(Log& log, const Graph& graph, const GraphGround& ground, std::span<Motion> room)
      : log_(log), graph_(graph), ground_(ground), room_(room) {}

  void run(double until) {
    if (log_.known < 0) {
      for (const Operation* machine : graph_.compiled().machines) as_machine(*machine).begin(log_);
      happen(0);
    }
    while (log_.known < until) {
      const std::optional<double> told = next_told(until), own = next_own(told.value_or(until));
      if (!told && !own) {
        log_.known = until;
        return;
      }
      const double next = own.value_or(told.value_or(until));
      if (next != told) log_.instants.push_back(next);
      happen(next);
    }
  }

 private:
  static const Machine& as_machine(const Operation& operation) { return static_cast<const Machine&>(operation); }

  /// The time of the first input up to `until`.
  [[nodiscard]] std::optional<double> next_told(double until) const {
    std::optional<double> first;
    const auto meet = [&](double time) {
      if (time > log_.known && time <= first.value_or(until)) first = time;
    };
    for (const Record<Setting>& settings : log_.settings)
      if (const auto next = std::ranges::upper_bound(settings, log_.known, {}, &Setting::time); next != settings.end())
        meet(next->time);
    if (const auto next = std::ranges::upper_bound(log_.sent, log_.known, {}, &Sending::time); next != log_.sent.end())
      meet(next->time);
    return first;
  }

  /// The first time at which something may happen without an input.
  [[nodiscard]] std::optional<double> next_own(double until) const {
    std::optional<double> first;
    if (log_.instants.size() >= most_own_instants) return first;
    const auto meet = [&](double time) {
      if (time > log_.known && time <= first.value_or(until)) first = time;
    };
    for (const Operation* machine : graph_.compiled().machines)
      if (const auto next = as_machine(*machine).next_instant(log_, log_.known, first.value_or(until))) meet(*next);
    for (const GraphReaction& reaction : graph_.description().reactions)
      if (const auto next = next_event(reaction.event, log_.known, first.value_or(until))) meet(*next);
    return first;
  }

  /// The first event of a name in (after, until], of a clip in the graph or below it.
  [[nodiscard]] std::optional<double> next_event(const std::string& name, double after, double until) const {
    std::optional<double> first = graph_.compiled().output->next_event(log_, name, 0, after, until);
    if (ground_.next_event)
      if (const auto below = ground_.next_event(name, after, first.value_or(until))) first = below;
    return first;
  }

  /// Whether an event happens at a time in a clip that shows.
  [[nodiscard]] bool happens(const std::string& name, double time) const {
    const double before = std::nextafter(time, -1.0);
    if (ground_.next_event && ground_.next_event(name, before, time)) return true;
    if (!graph_.compiled().output->next_event(log_, name, 0, before, time)) return false;
    std::vector<GraphEvent> events;
    graph_.compiled().output->events(log_, {before, time, 0}, events);
    return std::ranges::any_of(events, [&](const GraphEvent& event) {
      return event.name == name && event.kind != GraphEvent::Kind::end && event.weight > 0;
    });
  }

  // A state that is entered may begin with an event to which the graph reacts in turn; repeated until nothing new
  // happens.
  void happen(double time) {
    const std::vector<GraphReaction>& reactions = graph_.description().reactions;
    std::vector<char> reacted(reactions.size(), 0);
    taken_.assign(log_.passages.size(), 0);
    std::size_t told =
        static_cast<std::size_t>(std::ranges::lower_bound(log_.sent, time, {}, &Sending::time) - log_.sent.begin());
    static_cast<void>(react(time, reacted));
    do {
      for (std::size_t m = 0; m < graph_.compiled().machines.size(); ++m) happen(m, time, told);
      while (told < log_.sent.size() && log_.sent[told].time == time) ++told;
    } while (react(time, reacted));
    log_.known = time;
  }

  /// Carries out reactions that have not yet been at this instant. @returns whether there were any
  bool react(double time, std::vector<char>& reacted) {
    const std::vector<GraphReaction>& reactions = graph_.description().reactions;
    bool any = false;
    for (std::size_t i = 0; i < reactions.size(); ++i) {
      const GraphReaction& reaction = reactions[i];
      if (reacted[i] || !happens(reaction.event, time)) continue;
      reacted[i] = 1;
      any = true;
      if (reaction.value)
        set(log_, graph_.description(), *graph_.compiled().reacting[i], time, *reaction.value, Origin::event);
      else
        send(log_, time, reaction.name, Origin::event);
    }
    return any;
  }

  // Transitions by events of clips, or without events, come first; then each event that was sent may take one.
  // @param told index of the first sent event that was not handled yet
  void happen(std::size_t number, double time, std::size_t told) {
    const Machine& machine = as_machine(*graph_.compiled().machines[number]);
    if (taken_[number] >= most_transitions_at_once) return;
    const auto take = [&](std::size_t transition) {
      const bool full = log_.passages[number].size() >= most_passages;
      if (!full) pass(machine, number, transition, time);
      if (!full && ++taken_[number] < most_transitions_at_once) return true;
      taken_[number] = most_transitions_at_once;
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
    for (; told < log_.sent.size() && log_.sent[told].time == time; ++told) {
      const std::size_t transition = machine.transition_at(log_, time, log_.sent[told].event);
      if (transition == GraphPassage::no_transition) continue;
      if (!take(transition) || !settle_down()) return;
    }
  }

  void pass(const Machine& machine, std::size_t number, std::size_t transition, double time) {
    Passage passage = machine.passage(log_, transition, time);
    if (passage.settles) {
      const std::size_t nodes = graph_.nodes().size();
      const std::span<Motion> in = room_.first(nodes), out = room_.subspan(nodes, nodes);
      ground_.pose(time, Side::in, in);
      ground_.pose(time, Side::out, out);
      machine.measure(log_, passage, in, out, &ground_, room_.data() + 2 * nodes);
    }
    Record<Passage>& passages = log_.passages[number];
    const std::size_t pages = passages.full_pages();
    passages.push_back(std::move(passage));
    if (passages.full_pages() > pages && !log_.keeps_all) let_go(passages, false);
    forget_marks(log_, time);
  }

  Log& log_;
  const Graph& graph_;
  const GraphGround& ground_;
  std::span<Motion> room_;
  std::vector<std::size_t> taken_{};  // by machine: transitions at this instant
};

}  // namespace

void make_known(Log& log, const Graph& graph, double until, const GraphGround& ground, std::span<Motion> room) {
  Course(log, graph, ground, room).run(until);
}

std::size_t rooms_of(const Graph& graph) noexcept {
  std::size_t most = 0;
  for (const auto& operation : graph.compiled().operations) most = std::max(most, operation->rooms());
  return most + 4;  // two for the poses below, and two to compare
}

}  // namespace tweenfall::graphs
