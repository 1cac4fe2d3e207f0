#pragma once

// The graphs of an animation, each over the one before, the first over the plays; asked from anywhere at any time.
//
// What came in to them never changes. What follows from it is found by runners, which remember how far they have come;
// each is lent to one question at a time. Whoever asks from one thread gets the same one again, without a lock; one who
// asks meanwhile from another thread gets another one, which is made where there is none yet.

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph_player.h>

#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "graph/record.h"

namespace tweenfall::graphs {

class GraphStack {
 public:
  /// @param plays  what lies below all of them
  /// @throws std::invalid_argument listing all faults of the first that has any
  GraphStack(const std::shared_ptr<const Hierarchy>& nodes, const std::shared_ptr<const std::vector<Clip>>& clips,
             std::vector<GraphDescription> descriptions, GraphGround plays);
  /// Graphs with the same past, over plays that may be others from a time on.
  GraphStack(const GraphStack& other, GraphGround plays, double from);
  ~GraphStack();
  GraphStack(const GraphStack&) = delete;
  GraphStack& operator=(const GraphStack&) = delete;

  [[nodiscard]] std::span<const GraphDescription> descriptions() const noexcept { return *descriptions_; }
  [[nodiscard]] bool moves(std::size_t node) const noexcept;

  // What comes in. Nobody else may know the stack yet.
  /// @throws std::invalid_argument as `GraphPlayer` does
  void put(std::size_t graph, const GraphInput& input);
  /// What came in to others of the same names.
  void put_all_of(const GraphStack& others);

  /// One of them at a time, for whoever keeps `stack`.
  [[nodiscard]] static GraphPlayer player(const std::shared_ptr<const GraphStack>& stack, std::size_t graph,
                                          double time);

  /// Of the nodes that it was made for. Times before 0, and those that are none, are taken as 0.
  void sample(double time, Side side, std::span<Motion> local) const;
  [[nodiscard]] Motion sample_node(std::size_t node, double time, Side side) const;
  [[nodiscard]] NodeLook look(std::size_t node, double time, Side side) const;
  [[nodiscard]] std::size_t nodes() const noexcept { return nodes_; }

  [[nodiscard]] std::vector<GraphEvent> events(double from, double to) const;
  [[nodiscard]] std::optional<double> first_event(std::string_view name, std::size_t node, double from,
                                                  double to) const;
  [[nodiscard]] std::optional<double> first_instant(double from, double to) const;

 private:
  static constexpr double infinite_time = std::numeric_limits<double>::infinity();
  struct Runner;
  /// A runner for as long as a question lasts.
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
  GraphGround plays_;
  Record<Put> puts_;  // as they came
  mutable std::array<std::atomic<Runner*>, most_idle> idle_{};
};

/// Plays as what graphs lie on. @param plays  without graphs
[[nodiscard]] GraphGround ground_of(const Animation& plays);

}  // namespace tweenfall::graphs
