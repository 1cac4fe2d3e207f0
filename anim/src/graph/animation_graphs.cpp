#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/jump_search.h>
#include <tweenfall/curves/nearest_name.h>

#include "graph/graph_stack.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace tweenfall {

namespace graphs {

GraphGround ground_of(const Animation& plays, const std::shared_ptr<GroundJumps>& jumps,
                      const std::vector<double>& changes) {
  const auto pose = [plays](double time, Side side, std::span<Motion> out) { plays.sample(time, out, side); };
  const auto next_event = [plays](std::string_view name, double after, double until) {
    std::optional<double> first;
    for (const Player& player : plays.players())
      if (const auto next =
              player.first_event(plays.clips()[player.play().clip], after, first.value_or(until), false, name))
        first = next->time;
    return first;
  };
  const auto look = [plays](std::size_t node, double time, Side side) { return plays.look(node, time, side); };
  const auto user_value = [plays](std::string_view track, double time, Side side) {
    return plays.user_value(track, time, side);
  };
  const auto next_jump = [plays, changes, jumps, own = std::make_shared<GroundJumps>()](double, double after,
                                                                                        double until) {
    std::call_once(own->once, [&] {
      std::call_once(jumps->once, [&] { jumps->search = JumpSearch(plays, moves_its_node); });
      own->search = jumps->search.with_plays_of(plays, moves_its_node);
    });
    double first = own->search.first_behind(plays, after, until);
    const auto change = std::ranges::upper_bound(changes, after);
    if (change != changes.end()) first = std::min(first, *change);
    return first <= until ? std::optional(first) : std::nullopt;
  };
  return {pose, next_event, look, user_value, next_jump};
}

}  // namespace graphs

Animation Animation::with_graphs(std::vector<GraphDescription> graphs) const {
  Animation other = *this;
  other.graphs_ = nullptr;
  if (!graphs.empty()) other.graphs_ = std::make_shared<graphs::GraphStack>(nodes_, clips_, std::move(graphs), other);
  other.bind_plays();
  return other;
}

Animation Animation::with_input(std::string_view graph, const GraphInput& input) const {
  const std::size_t number = graph_named(graph);
  Animation other = *this;
  other.graphs_ = graphs_->copy();
  other.graphs_->put(number, input);
  return other;
}

std::size_t Animation::graph_named(std::string_view name) const {
  std::vector<std::string> names;
  for (const GraphDescription& each : graphs()) {
    if (each.name == name) return names.size();
    names.push_back(each.name);
  }
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no graph \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

GraphPlayer Animation::graph(std::string_view name, double time) const {
  return graphs::GraphStack::player(graphs_, graph_named(name), time);
}

std::span<const GraphDescription> Animation::graphs() const noexcept {
  if (!graphs_) return {};
  return graphs_->descriptions();
}

std::vector<GraphEvent> Animation::graph_events(double from, double to) const {
  if (!graphs_) return {};
  return graphs_->events(from, to);
}

std::optional<double> Animation::first_graph_event(std::string_view name, std::size_t node, double from,
                                                   double to) const {
  return graphs_ ? graphs_->first_event(name, node, from, to) : std::nullopt;
}

std::optional<double> Animation::first_graph_instant(double from, double to) const {
  return graphs_ ? graphs_->first_instant(from, to) : std::nullopt;
}

}  // namespace tweenfall
