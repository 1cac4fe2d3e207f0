#include <tweenfall/anim/graph_doubts.h>
#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tweenfall {

namespace graphs {
namespace {

/// A stretch of the graph's time in which weights sum to zero.
struct Nothing {
  double from, to;  // s
};

/// The keys of a number, or of its parameter; null for none.
const Curve<double>* keys_of(const GraphNumber& number, const GraphDescription& description) {
  if (const auto* curve = std::get_if<Curve<double>>(&number)) return curve;
  const auto* by = std::get_if<ByParameter>(&number);
  if (!by) return nullptr;
  const auto parameter = std::ranges::find(description.parameters, by->name, &GraphParameter::name);
  return parameter != description.parameters.end() && parameter->curve ? &*parameter->curve : nullptr;
}

std::optional<Nothing> first_nothing(const BlendPose& blend, const GraphDescription& description) {
  std::vector<double> times{0};
  double longest = 1;
  std::vector<const Curve<double>*> curves;
  for (const BlendPose::Part& part : blend.parts) {
    if (const double* constant = std::get_if<double>(&part.weight)) {
      if (*constant != 0) return std::nullopt;
      continue;
    }
    const Curve<double>* keys = keys_of(part.weight, description);
    if (!keys || keys->knots().empty()) return std::nullopt;
    curves.push_back(keys);
    for (const double knot : keys->knots())
      if (knot > 0) times.push_back(knot);
    longest = std::max(longest, keys->duration());
  }
  if (curves.empty()) return std::nullopt;
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  // What comes again after the last key does so within this.
  const double end = times.back() + longest;
  times.push_back(end);
  std::optional<Nothing> found;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    // At its ends a stretch may belong to its neighbors. One that is zero in its middle is so throughout.
    const double quarter = 0.25 * (times[i + 1] - times[i]);
    const bool none = std::ranges::all_of(curves, [&](const Curve<double>* curve) {
      return range(*curve, times[i] + quarter, times[i + 1] - quarter).high <= 0;
    });
    if (!none && found) return found;
    if (none) found = Nothing{found ? found->from : times[i], times[i + 1]};
  }
  if (found && found->to == end) found->to = std::numeric_limits<double>::infinity();
  return found;
}

/// The states of a machine to which no transitions lead, by number.
std::vector<std::size_t> unreached(const MachinePose& machine) {
  // Where the start is missing, that is the fault to be told.
  if (std::ranges::find(machine.states, machine.start, &MachinePose::State::name) == machine.states.end()) return {};
  std::vector<std::string> reached{machine.start};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const GraphTransition& transition : machine.transitions) {
      const bool leaves =
          transition.from.empty() || std::ranges::find(transition.from, reached[i]) != transition.from.end();
      if (leaves && std::ranges::find(reached, transition.to) == reached.end()) reached.push_back(transition.to);
    }
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < machine.states.size(); ++i)
    if (std::ranges::find(reached, machine.states[i].name) == reached.end()) others.push_back(i);
  return others;
}

void doubt_machine(const GraphPose& pose, const MachinePose& machine, std::vector<GraphFault>& doubts) {
  for (const std::size_t state : unreached(machine))
    doubts.push_back({{"poses", pose.name, "machine", "states", machine.states[state].name},
                      "never shows: no transitions lead to it from the start, \"" + machine.start + "\""});
}

}  // namespace
}  // namespace graphs

std::vector<GraphFault> doubts_about(const GraphDescription& description) {
  std::vector<GraphFault> doubts;
  for (const GraphPose& pose : description.poses) {
    if (const auto* machine = std::get_if<MachinePose>(&pose.operation)) graphs::doubt_machine(pose, *machine, doubts);
    const auto* blend = std::get_if<BlendPose>(&pose.operation);
    if (!blend) continue;
    const std::optional<graphs::Nothing> nothing = graphs::first_nothing(*blend, description);
    // For ever is a fault.
    if (!nothing || (nothing->from == 0 && std::isinf(nothing->to))) continue;
    doubts.push_back({{"poses", pose.name, "blend"},
                      "these weights sum to zero from " + brief_text(nothing->from) + " s " +
                          (std::isinf(nothing->to) ? "on" : "to " + brief_text(nothing->to) + " s") +
                          ": the pose below the graph shows then"});
  }
  return doubts;
}

}  // namespace tweenfall
