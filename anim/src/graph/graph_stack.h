#pragma once

// The graphs of an animation, each over the one before, the first over the plays; asked from anywhere at any time.

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph_player.h>

#include <array>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace tweenfall::graphs {

class GraphStack {
 public:
  /// @param plays  what lies below all of them
  /// @throws std::invalid_argument listing all faults of the first that has any
  GraphStack(const std::shared_ptr<const Hierarchy>& nodes, const std::shared_ptr<const std::vector<Clip>>& clips,
             std::vector<GraphDescription> descriptions, GraphGround plays);
  /// Graphs with the same past, over plays that may be others from a time on.
  GraphStack(GraphStack& other, GraphGround plays, double from);

  [[nodiscard]] std::span<const GraphDescription> descriptions() const noexcept { return *descriptions_; }
  [[nodiscard]] bool moves(std::size_t node) const noexcept;

  // What comes in. Nobody else may know the stack yet.
  /// @throws std::invalid_argument as `GraphPlayer` does
  void put(std::size_t graph, const GraphInput& input);
  /// What came in to others of the same names.
  void put_all_of(GraphStack& others);

  /// One of them at a time, for whoever keeps `stack`.
  [[nodiscard]] static GraphPlayer player(const std::shared_ptr<GraphStack>& stack, std::size_t graph, double time);

  /// Of the nodes that it was made for. Times before 0 are taken as 0.
  void sample(double time, Side side, std::span<Motion> local);
  [[nodiscard]] Motion sample_node(std::size_t node, double time, Side side);
  [[nodiscard]] std::size_t nodes() const noexcept { return nodes_; }

  [[nodiscard]] std::vector<GraphEvent> events(double from, double to);
  [[nodiscard]] std::optional<double> first_event(std::string_view name, std::size_t node, double from, double to);
  [[nodiscard]] std::optional<double> first_instant(double from, double to);

 private:
  // Questions about many nodes at one time, and about both ends of a step, are many.
  static constexpr double infinite_time = std::numeric_limits<double>::infinity();
  struct Kept {
    double time = -1;
    Side side = Side::out;
    std::vector<Motion> local;
  };
  [[nodiscard]] const std::vector<Motion>& kept_at(double time, Side side);
  [[nodiscard]] GraphGround over(std::size_t graph);
  void forget_kept();

  std::shared_ptr<const std::vector<GraphDescription>> descriptions_;
  std::size_t nodes_;
  GraphGround plays_;
  std::vector<GraphPlayer> players_;
  std::recursive_mutex lock_;  // a player that was given away asks on its own
  std::array<Kept, 4> kept_;
  std::size_t oldest_ = 0;
};

/// Plays as what graphs lie on. @param plays  without graphs
[[nodiscard]] GraphGround ground_of(const Animation& plays);

}  // namespace tweenfall::graphs
