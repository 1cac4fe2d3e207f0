#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/number_text.h>

#include "machine/machine.h"
#include "operations/account.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::graphs {

namespace {

/// Binds a machine to its states and transitions; reports unknown states.
class MachineBinder {
 public:
  MachineBinder(const MachinePose& described, Binder& binder) : described_(described), binder_(binder) {}

  [[nodiscard]] std::optional<std::size_t> state(const std::string& name, const Place& place) {
    for (std::size_t i = 0; i < described_.states.size(); ++i)
      if (described_.states[i].name == name) return i;
    std::vector<std::string> names;
    names.reserve(described_.states.size());
    for (const MachinePose::State& each : described_.states) names.push_back(each.name);
    const std::string nearest = nearest_name(name, names);
    binder_.fault(
        place, "there is no state \"" + name + "\"" + (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
    return std::nullopt;
  }

  [[nodiscard]] std::vector<const Operation*> states() {
    std::vector<const Operation*> poses;
    poses.reserve(described_.states.size());
    for (std::size_t i = 0; i < described_.states.size(); ++i) {
      const MachinePose::State& each = described_.states[i];
      const Place place = {"machine", "states", each.name};
      for (std::size_t j = 0; j < i; ++j)
        if (described_.states[j].name == each.name) binder_.fault(place, "two states are named \"" + each.name + "\"");
      poses.push_back(binder_.pose(each.pose, place));
    }
    if (poses.empty()) binder_.fault({"machine", "states"}, "a machine has states; this one has none");
    return poses;
  }

  [[nodiscard]] std::optional<Machine::Transition> transition(std::size_t index) {
    const GraphTransition& each = described_.transitions[index];
    const auto place = [&](const char* part) { return Place{"machine", "transitions", std::to_string(index), part}; };
    Machine::Transition made;
    bool whole = true;
    made.from.assign(described_.states.size(), each.from.empty());
    for (const std::string& name : each.from) {
      const std::optional<std::size_t> from = state(name, place("from"));
      whole = whole && from;
      if (from) made.from[*from] = 1;
    }
    const std::optional<std::size_t> to = state(each.to, place("to"));
    whole = whole && to;
    if (to) {
      made.to = *to;
      if (each.from.empty()) made.from[*to] = 0;
    }
    for (const GraphCondition& condition : each.when) {
      std::optional<Condition> when = bound(condition, place("when"), binder_);
      whole = whole && when;
      if (when) made.when.push_back(std::move(*when));
    }
    made.change = change(each.change, index);
    if (!whole) return std::nullopt;
    return made;
  }

 private:
  [[nodiscard]] GraphChange change(const GraphChange& change, std::size_t index) {
    const bool fade = change.kind == GraphChange::Kind::fade;
    const auto place = [&](const char* part) { return Place{"machine", "transitions", std::to_string(index), part}; };
    if (!std::isfinite(change.seconds) || !(fade ? change.seconds >= 0 : change.seconds > 0))
      binder_.fault(place(fade ? "fade" : "settle"),
                    std::string(fade ? "a fade lasts 0 s or more; this one " : "settling takes more than 0 s; this ") +
                        number_text(change.seconds) + " s");
    if (change.ease && !fade) binder_.fault(place("ease"), "an ease is for fades; what settles has none");
    if (change.ease && change.ease->rule() != Ease::Rule::shape && change.ease->rule() != Ease::Rule::linear)
      binder_.fault(place("ease"), "\"" + change.ease->name() +
                                       "\" depends on keys, and a fade has none; say \"linear\" "
                                       "or a shape, such as \"quad-in-out\"");
    constexpr double longest = 1e12;  // s; longer is practically for ever, and powers of it would overflow
    if (change.seconds > longest) return {.kind = change.kind, .seconds = longest, .ease = change.ease};
    if (change.seconds < shortest_change) return {.kind = GraphChange::Kind::fade, .seconds = 0};
    return change;
  }

  const MachinePose& described_;
  Binder& binder_;
};

/// A state from which transitions without conditions go on for ever; empty if there is none.
std::optional<std::size_t> restless(const std::vector<Machine::Transition>& transitions, std::size_t states) {
  std::vector<std::size_t> next(states, states);
  for (const Machine::Transition& each : transitions)
    for (std::size_t state = 0; each.when.empty() && state < states; ++state)
      if (each.from[state] && next[state] == states) next[state] = each.to;
  std::vector<std::size_t> walk(states, states);  // the walk on which each state was visited
  for (std::size_t start = 0; start < states; ++start)
    for (std::size_t at = start; at < states; at = next[at]) {
      if (walk[at] == start) return at;
      if (walk[at] < states) break;
      walk[at] = start;
    }
  return std::nullopt;
}

}  // namespace

void tell(const MachinePose& pose, Account& account) {
  account.words = "machine";
  account.tell(pose.start);
  for (const MachinePose::State& state : pose.states) {
    account.pose(state.pose, state.name);
    account.tell(state.name);
  }
  for (const GraphTransition& transition : pose.transitions)
    account.tell(transition.from, transition.to, transition.when, transition.change);
}

std::unique_ptr<Operation> bound(const MachinePose& described, Binder& binder) {
  MachineBinder parts(described, binder);
  std::vector<const Operation*> states = parts.states();
  bool whole = std::ranges::find(states, nullptr) == states.end();
  std::vector<Machine::Transition> transitions;
  transitions.reserve(described.transitions.size());
  for (std::size_t i = 0; i < described.transitions.size(); ++i) {
    std::optional<Machine::Transition> made = parts.transition(i);
    whole = whole && made;
    if (made) transitions.push_back(std::move(*made));
  }
  const std::optional<std::size_t> start = parts.state(described.start, {"machine", "start"});
  if (const auto state = restless(transitions, states.size()))
    binder.fault({"machine", "states", described.states[*state].name},
                 "transitions without conditions lead on from here for ever; give one of them a \"when\"");
  if (!whole || !start || states.empty()) return nullptr;
  auto operation = std::make_unique<Machine>(binder.description(), binder.machine_number(), std::move(states),
                                             std::move(transitions), *start);
  operation->set_rooms(1);
  return operation;
}

}  // namespace tweenfall::graphs
