#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// An order of a soft body's nodes in which those that are joined are near each other.
class NodeOrder {
 public:
  /// Where nodes are joined far across their numbers, as those of a cloth of long rows are, by the reversed order of
  /// Cuthill and McKee.
  explicit NodeOrder(const SoftSettings& made);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// The greatest distance of joined nodes.
  [[nodiscard]] std::size_t reach() const { return reach_; }
  /// Whether all nodes are where their numbers put them.
  [[nodiscard]] bool is_natural() const { return nodes_.empty(); }
  [[nodiscard]] std::size_t place_of(std::size_t node) const { return is_natural() ? node : places_[node]; }
  [[nodiscard]] std::size_t node_at(std::size_t place) const { return is_natural() ? place : nodes_[place]; }

 private:
  std::size_t size_ = 0, reach_ = 0;
  std::vector<std::uint32_t> nodes_, places_;
};

/// Whether the matrix of all nodes is narrow enough to be factored, where it is stiff enough to be worth it.
[[nodiscard]] bool can_be_factored(const SoftSettings& made, const NodeOrder& order);

}  // namespace tweenfall::soft
