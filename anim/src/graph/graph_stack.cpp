#include "graph/graph_stack.h"

#include <algorithm>

namespace tweenfall::graphs {

GraphStack::GraphStack(const std::shared_ptr<const Hierarchy>& nodes,
                       const std::shared_ptr<const std::vector<Clip>>& clips,
                       std::vector<GraphDescription> descriptions, PoseBelow plays)
    : descriptions_(std::move(descriptions)), nodes_(nodes->size()) {
  players_.reserve(descriptions_.size());  // each is asked by the next
  PoseBelow below = std::move(plays);
  for (const GraphDescription& description : descriptions_) {
    players_.emplace_back(std::make_shared<const Graph>(nodes, clips, description), below);
    below = [player = &players_.back()](double time, Side side, std::span<Motion> out) {
      player->pose_at(time, out, side);
    };
  }
  for (Kept& kept : kept_) kept.local.resize(nodes_);
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
