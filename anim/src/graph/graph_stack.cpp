#include "graph/graph_stack.h"

#include <algorithm>

namespace tweenfall::graphs {

GraphStack::GraphStack(const std::shared_ptr<const Hierarchy>& nodes,
                       const std::shared_ptr<const std::vector<Clip>>& clips,
                       std::vector<GraphDescription> descriptions, GraphGround plays)
    : descriptions_(std::make_shared<const std::vector<GraphDescription>>(std::move(descriptions))),
      nodes_(nodes->size()),
      plays_(std::move(plays)) {
  players_.reserve(descriptions_->size());  // each is asked by the next
  for (std::size_t i = 0; i < descriptions_->size(); ++i)
    players_.emplace_back(std::make_shared<const Graph>(nodes, clips, (*descriptions_)[i]), over(i));
  for (Kept& kept : kept_) kept.local.resize(nodes_);
}

GraphStack::GraphStack(GraphStack& other, GraphGround plays, double from)
    : descriptions_(other.descriptions_), nodes_(other.nodes_), plays_(std::move(plays)) {
  const std::lock_guard guard(other.lock_);
  players_.reserve(other.players_.size());
  for (std::size_t i = 0; i < other.players_.size(); ++i) players_.emplace_back(other.players_[i], over(i), from);
  for (Kept& kept : kept_) kept.local.resize(nodes_);
}

GraphGround GraphStack::over(std::size_t graph) {
  if (graph == 0) return plays_;
  GraphPlayer& player = players_[graph - 1];
  const auto pose = [&player](double time, Side side, std::span<Motion> out) { player.pose_at(time, out, side); };
  const auto next_event = [&player, below = over(graph - 1).next_event](std::string_view name, double after,
                                                                        double until) {
    std::optional<double> first = player.first_event(name, after, until);
    if (below)
      if (const auto next = below(name, after, first.value_or(until))) first = next;
    return first;
  };
  return {pose, next_event};
}

void GraphStack::put(std::size_t graph, const GraphInput& input) {
  GraphPlayer& player = players_[graph];
  player.seek(input.time);
  if (input.value)
    player.set(input.name, *input.value);
  else
    player.send(input.name);
  // Those above lie on another ground from then on.
  for (std::size_t i = graph + 1; i < players_.size(); ++i) players_[i] = GraphPlayer(players_[i], over(i), input.time);
  forget_kept();
}

void GraphStack::put_all_of(GraphStack& others) {
  const std::lock_guard guard(others.lock_);
  for (std::size_t i = 0; i < players_.size(); ++i)
    for (const GraphInput& input : others.players_[i].own_inputs()) put(i, input);
}

void GraphStack::forget_kept() {
  for (Kept& kept : kept_) kept.time = -1;
}

GraphPlayer GraphStack::player(const std::shared_ptr<GraphStack>& stack, std::size_t graph, double time) {
  const GraphGround ground = stack->over(graph);
  GraphGround locked{.pose = [stack, ground](double at, Side side, std::span<Motion> out) {
    const std::lock_guard guard(stack->lock_);
    ground.pose(at, side, out);
  }};
  if (ground.next_event)
    locked.next_event = [stack, ground](std::string_view name, double after, double until) {
      const std::lock_guard guard(stack->lock_);
      return ground.next_event(name, after, until);
    };
  const std::lock_guard guard(stack->lock_);
  GraphPlayer player(stack->players_[graph], std::move(locked), infinite_time);
  player.seek(time);
  return player;
}

bool GraphStack::moves(std::size_t node) const noexcept {
  return std::ranges::any_of(players_, [&](const GraphPlayer& player) { return player.graph().moves(node); });
}

const std::vector<Motion>& GraphStack::kept_at(double time, Side side) {
  time = std::max(time, 0.0);
  for (const Kept& kept : kept_)
    if (kept.time == time && kept.side == side) return kept.local;
  Kept& kept = kept_[oldest_];
  oldest_ = (oldest_ + 1) % kept_.size();
  players_.back().pose_at(time, kept.local, side);
  kept.time = time;
  kept.side = side;
  return kept.local;
}

void GraphStack::sample(double time, Side side, std::span<Motion> local) {
  const std::lock_guard guard(lock_);
  std::ranges::copy(kept_at(time, side), local.begin());
}

Motion GraphStack::sample_node(std::size_t node, double time, Side side) {
  const std::lock_guard guard(lock_);
  return kept_at(time, side)[node];
}

std::vector<GraphEvent> GraphStack::events(double from, double to) {
  const std::lock_guard guard(lock_);
  std::vector<GraphEvent> events;
  for (GraphPlayer& player : players_)
    for (GraphEvent& event : player.events(from, to)) events.push_back(std::move(event));
  std::ranges::stable_sort(events, {}, &GraphEvent::time);
  return events;
}

std::optional<double> GraphStack::first_event(std::string_view name, std::size_t node, double from, double to) {
  const std::lock_guard guard(lock_);
  std::optional<double> first;
  for (GraphPlayer& player : players_) {
    if (node != no_node && !player.graph().moves(node)) continue;
    for (const GraphEvent& event : player.events(from, to))
      if (event.name == name && event.kind != GraphEvent::Kind::end && event.time < first.value_or(infinite_time))
        first = event.time;
  }
  return first;
}

std::optional<double> GraphStack::first_instant(double from, double to) {
  const std::lock_guard guard(lock_);
  std::optional<double> first;
  for (GraphPlayer& player : players_)
    if (const auto instant = player.first_instant(from, first.value_or(to))) first = instant;
  return first;
}

}  // namespace tweenfall::graphs
