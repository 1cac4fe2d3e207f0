#pragma once

// The graphs of an animation, each over the one before, the first over the plays; asked from anywhere at any time.

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
  /// @param plays  writes what lies below all of them
  /// @throws std::invalid_argument listing all faults of the first that has any
  GraphStack(const std::shared_ptr<const Hierarchy>& nodes, const std::shared_ptr<const std::vector<Clip>>& clips,
             std::vector<GraphDescription> descriptions, PoseBelow plays);

  [[nodiscard]] std::span<const GraphDescription> descriptions() const noexcept { return descriptions_; }
  [[nodiscard]] bool moves(std::size_t node) const noexcept;

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

  std::vector<GraphDescription> descriptions_;
  std::size_t nodes_;
  std::vector<GraphPlayer> players_;
  std::mutex lock_;
  std::array<Kept, 4> kept_;
  std::size_t oldest_ = 0;
};

}  // namespace tweenfall::graphs
