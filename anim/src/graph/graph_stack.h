#pragma once

// The graphs of an animation, each over the one before, the first over the plays; for use from any thread at any time.
//
// The inputs never change. Their consequences are computed by runners, which remember how far they have come; each
// runner is lent to one call at a time. Calls from one thread get the same runner again, without a lock; a concurrent
// call from another thread gets another one, which is created if necessary.

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph_player.h>
#include <tweenfall/anim/jump_search.h>

#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "graph/record.h"

namespace tweenfall::graphs {

/// Where the clips below graphs jump: found when first asked for, since only springs want to know.
struct GroundJumps {
  std::once_flag once{};
  JumpSearch search{};
};

class GraphStack {
 public:
  /// @param plays    what lies below all of them, without graphs
  /// @param changes  when these were changed, s, in order
  /// @throws std::invalid_argument listing all faults of the first that has any
  GraphStack(const std::shared_ptr<const Hierarchy>& nodes, const std::shared_ptr<const std::vector<Clip>>& clips,
             std::vector<GraphDescription> descriptions, const Animation& plays, std::vector<double> changes = {});
  /// Graphs with the same past, over the same plays of other nodes.
  GraphStack(const GraphStack& other, const std::shared_ptr<const Hierarchy>& nodes,
             const std::shared_ptr<const std::vector<Clip>>& clips, const Animation& plays);
  /// Graphs with the same past, over plays (without graphs) that may differ from the time `from` on.
  GraphStack(const GraphStack& other, const Animation& plays, double from);
  /// The same graphs over the same plays.
  [[nodiscard]] std::shared_ptr<GraphStack> copy() const;
  ~GraphStack();
  GraphStack(const GraphStack&) = delete;
  GraphStack& operator=(const GraphStack&) = delete;

  [[nodiscard]] std::span<const GraphDescription> descriptions() const noexcept { return *descriptions_; }
  [[nodiscard]] bool moves(std::size_t node) const noexcept;

  // Input. Only before the stack is shared.
  /// @throws std::invalid_argument as `GraphPlayer` does
  void put(std::size_t graph, const GraphInput& input);

  /// A player for one graph at a time; it keeps `stack` alive.
  [[nodiscard]] static GraphPlayer player(const std::shared_ptr<const GraphStack>& stack, std::size_t graph,
                                          double time);

  /// Writes the motions of the nodes that it was made for. Times before 0, and NaN, count as 0.
  void sample(double time, Side side, std::span<Motion> local) const;
  [[nodiscard]] Motion sample_node(std::size_t node, double time, Side side) const;
  [[nodiscard]] NodeLook look(std::size_t node, double time, Side side) const;
  [[nodiscard]] UserValue user_value(std::string_view track, double time, Side side) const;
  [[nodiscard]] std::size_t nodes() const noexcept { return nodes_; }

  [[nodiscard]] std::vector<GraphEvent> events(double from, double to) const;
  [[nodiscard]] std::optional<double> first_event(std::string_view name, std::size_t node, double from,
                                                  double to) const;
  [[nodiscard]] std::optional<double> first_instant(double from, double to) const;

 private:
  static constexpr double infinite_time = std::numeric_limits<double>::infinity();
  struct Runner;
  /// A runner for the duration of one call.
  class Lent;
  struct Put {
    std::size_t graph;
    GraphInput input;
  };
  static constexpr std::size_t most_idle = 8;

  [[nodiscard]] std::unique_ptr<Runner> new_runner() const;

  std::vector<std::shared_ptr<const Graph>> graphs_;
  std::shared_ptr<const std::vector<GraphDescription>> descriptions_;
  std::size_t nodes_;
  GraphStack(const GraphStack& other, std::vector<double> changes, GraphGround plays, double from);

  std::shared_ptr<GroundJumps> jumps_;
  std::vector<double> changes_;  // when the plays were changed, s, in order
  GraphGround plays_;
  Record<Put> puts_;  // in the order in which they were added
  mutable std::array<std::atomic<Runner*>, most_idle> idle_{};
};

/// The plays as the ground of graphs.
/// @param plays    without graphs
/// @param jumps    of the same clips
/// @param changes  when the plays were changed, s, in order
[[nodiscard]] GraphGround ground_of(const Animation& plays, const std::shared_ptr<GroundJumps>& jumps,
                                    const std::vector<double>& changes);

}  // namespace tweenfall::graphs
