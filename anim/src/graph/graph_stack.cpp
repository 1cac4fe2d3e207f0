#include "graph/graph_stack.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/binder.h"

namespace tweenfall::graphs {

struct GraphStack::Runner {
  // Poses kept, because many nodes are sampled at the same time, and often at both ends of a step.
  struct Kept {
    double time = -1;
    Side side = Side::out;
    std::vector<Motion> local;
  };

  Runner(GraphGround below, std::size_t nodes, std::size_t graphs) : plays(std::move(below)) {
    players.reserve(graphs);  // no reallocation: each is used by the next
    for (Kept& each : kept) each.local.resize(nodes);
  }

  /// The ground of a graph.
  [[nodiscard]] GraphGround over(std::size_t graph) {
    if (graph == 0) return plays;
    GraphPlayer& player = players[graph - 1];
    const auto pose = [&player](double time, Side side, std::span<Motion> out) { player.pose_at(time, out, side); };
    const auto next_event = [&player, below = over(graph - 1).next_event](std::string_view name, double after,
                                                                          double until) {
      std::optional<double> first = player.first_event(name, after, until);
      if (below)
        if (const auto next = below(name, after, first.value_or(until))) first = next;
      return first;
    };
    const auto look = [&player](std::size_t node, double time, Side side) { return player.look_at(node, time, side); };
    const auto user_value = [&player](std::string_view track, double time, Side side) {
      return player.user_value_at(track, time, side);
    };
    const auto next_jump = [&player](double since, double after, double until) {
      return player.first_possible_jump(after, until, since);
    };
    return {pose, next_event, look, user_value, next_jump};
  }

  void put(std::size_t graph, const GraphInput& input) {
    GraphPlayer& player = players[graph];
    player.seek(input.time);
    if (input.value)
      player.set(input.name, *input.value);
    else
      player.send(input.name);
    // The graphs above have another ground from then on.
    double from = input.time;
    for (std::size_t i = graph + 1; i < players.size(); ++i) lay(i, players[i], from);
    for (Kept& each : kept) each.time = -1;
  }

  /// Lays a graph over those below it, which differ from a time on from what it lay on.
  /// @param from  s; then from when on the graph itself may differ: its springs have looked ahead
  void lay(std::size_t graph, const GraphPlayer& before, double& from) {
    GraphPlayer player(before, over(graph), from);
    if (graph < players.size())
      players[graph] = std::move(player);
    else
      players.push_back(std::move(player));
    from -= players[graph].graph().compiled().looks_ahead;
  }

  [[nodiscard]] const std::vector<Motion>& kept_at(double time, Side side) {
    time = std::isfinite(time) ? std::max(time, 0.0) : 0;
    for (const Kept& each : kept)
      if (each.time == time && each.side == side) return each.local;
    Kept& next = kept[oldest];
    oldest = (oldest + 1) % kept.size();
    players.back().pose_at(time, next.local, side);
    next.time = time;
    next.side = side;
    return next.local;
  }

  GraphGround plays;
  std::vector<GraphPlayer> players;
  std::array<Kept, 4> kept;
  std::size_t oldest = 0;
};

class GraphStack::Lent {
 public:
  explicit Lent(const GraphStack& stack) : stack_(stack) {
    for (std::atomic<Runner*>& place : stack.idle_)
      if (Runner* found = place.exchange(nullptr, std::memory_order_acquire)) {
        runner_.reset(found);
        return;
      }
    runner_ = stack.new_runner();
  }
  ~Lent() {
    for (std::atomic<Runner*>& place : stack_.idle_) {
      Runner* none = nullptr;
      if (!place.compare_exchange_strong(none, runner_.get(), std::memory_order_release)) continue;
      static_cast<void>(runner_.release());
      return;
    }
  }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

  Runner* operator->() const noexcept { return runner_.get(); }

 private:
  const GraphStack& stack_;
  std::unique_ptr<Runner> runner_;
};

GraphStack::GraphStack(const std::shared_ptr<const Hierarchy>& nodes,
                       const std::shared_ptr<const std::vector<Clip>>& clips,
                       std::vector<GraphDescription> descriptions, const Animation& plays, std::vector<double> changes)
    : descriptions_(std::make_shared<const std::vector<GraphDescription>>(std::move(descriptions))),
      nodes_(nodes->size()),
      jumps_(std::make_shared<GroundJumps>()),
      changes_(std::move(changes)),
      plays_(ground_of(plays, jumps_, changes_)) {
  for (const GraphDescription& each : *descriptions_)
    graphs_.push_back(std::make_shared<const Graph>(nodes, clips, each));
  idle_[0] = new_runner().release();
}

GraphStack::GraphStack(const GraphStack& other, const std::shared_ptr<const Hierarchy>& nodes,
                       const std::shared_ptr<const std::vector<Clip>>& clips, const Animation& plays)
    : GraphStack(nodes, clips, *other.descriptions_, plays, other.changes_) {
  for (const Put& each : other.puts_) put(each.graph, each.input);
}

GraphStack::GraphStack(const GraphStack& other, std::vector<double> changes, GraphGround plays, double from)
    : graphs_(other.graphs_),
      descriptions_(other.descriptions_),
      nodes_(other.nodes_),
      jumps_(other.jumps_),
      changes_(std::move(changes)),
      plays_(std::move(plays)),
      puts_(other.puts_) {
  const Lent lent(other);
  auto runner = std::make_unique<Runner>(plays_, nodes_, graphs_.size());
  for (std::size_t i = 0; i < graphs_.size(); ++i) runner->lay(i, lent->players[i], from);
  idle_[0] = runner.release();
}

namespace {

std::vector<double> with(std::vector<double> times, double time) {
  times.insert(std::ranges::upper_bound(times, time), time);
  return times;
}

}  // namespace

GraphStack::GraphStack(const GraphStack& other, const Animation& plays, double from)
    : GraphStack(other, with(other.changes_, from), ground_of(plays, other.jumps_, with(other.changes_, from)), from) {}

std::shared_ptr<GraphStack> GraphStack::copy() const {
  return std::shared_ptr<GraphStack>(new GraphStack(*this, changes_, plays_, infinite_time));
}

GraphStack::~GraphStack() {
  for (const std::atomic<Runner*>& place : idle_) delete place.load();
}

std::unique_ptr<GraphStack::Runner> GraphStack::new_runner() const {
  auto runner = std::make_unique<Runner>(plays_, nodes_, graphs_.size());
  for (std::size_t i = 0; i < graphs_.size(); ++i) runner->players.emplace_back(graphs_[i], runner->over(i));
  for (const Put& each : puts_) runner->put(each.graph, each.input);
  return runner;
}

void GraphStack::put(std::size_t graph, const GraphInput& input) {
  Lent(*this)->put(graph, input);
  puts_.push_back({graph, input});
}

GraphPlayer GraphStack::player(const std::shared_ptr<const GraphStack>& stack, std::size_t graph, double time) {
  // It outlives this call, and samples what lies below it on its own.
  GraphGround ground = stack->plays_;
  if (graph > 0) {
    ground.pose = [stack, graph](double at, Side side, std::span<Motion> out) {
      Lent(*stack)->players[graph - 1].pose_at(at, out, side);
    };
    ground.look = [stack, graph](std::size_t node, double at, Side side) {
      return Lent(*stack)->players[graph - 1].look_at(node, at, side);
    };
    ground.user_value = [stack, graph](std::string_view track, double at, Side side) {
      return Lent(*stack)->players[graph - 1].user_value_at(track, at, side);
    };
    ground.next_jump = [stack, graph](double since, double after, double until) {
      return Lent(*stack)->players[graph - 1].first_possible_jump(after, until, since);
    };
    ground.next_event = [stack, graph](std::string_view name, double after, double until) {
      const Lent lent(*stack);
      return lent->over(graph).next_event(name, after, until);
    };
  }
  GraphPlayer player = [&] {
    const Lent lent(*stack);
    return GraphPlayer(lent->players[graph], std::move(ground), infinite_time);
  }();
  player.seek(time);
  return player;
}

bool GraphStack::moves(std::size_t node) const noexcept {
  return std::ranges::any_of(graphs_, [&](const auto& graph) { return graph->moves(node); });
}

void GraphStack::sample(double time, Side side, std::span<Motion> local) const {
  const Lent lent(*this);
  std::ranges::copy(lent->kept_at(time, side), local.begin());
}

Motion GraphStack::sample_node(std::size_t node, double time, Side side) const {
  const Lent lent(*this);
  return lent->kept_at(time, side)[node];
}

NodeLook GraphStack::look(std::size_t node, double time, Side side) const {
  const Lent lent(*this);
  return lent->players.back().look_at(node, std::isfinite(time) ? std::max(time, 0.0) : 0, side);
}

UserValue GraphStack::user_value(std::string_view track, double time, Side side) const {
  const Lent lent(*this);
  return lent->players.back().user_value_at(track, std::isfinite(time) ? std::max(time, 0.0) : 0, side);
}

std::vector<GraphEvent> GraphStack::events(double from, double to) const {
  const Lent lent(*this);
  std::vector<GraphEvent> events;
  for (GraphPlayer& player : lent->players)
    for (GraphEvent& event : player.events(from, to)) events.push_back(std::move(event));
  std::ranges::stable_sort(events, {}, &GraphEvent::time);
  return events;
}

std::optional<double> GraphStack::first_event(std::string_view name, std::size_t node, double from, double to) const {
  const Lent lent(*this);
  std::optional<double> first;
  for (GraphPlayer& player : lent->players) {
    if (node != no_node && !player.graph().moves(node)) continue;
    for (const GraphEvent& event : player.events(from, to))
      if (event.name == name && event.kind != GraphEvent::Kind::end && event.time < first.value_or(infinite_time))
        first = event.time;
  }
  return first;
}

std::optional<double> GraphStack::first_instant(double from, double to) const {
  const Lent lent(*this);
  std::optional<double> first;
  for (GraphPlayer& player : lent->players)
    if (const auto instant = player.first_instant(from, first.value_or(to))) first = instant;
  return first;
}

}  // namespace tweenfall::graphs
