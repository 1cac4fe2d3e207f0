// Source: Cuthill, McKee, Reducing the Bandwidth of Sparse Symmetric Matrices, 1969; reversed as in George, Liu,
// Computer Solution of Large Sparse Positive Definite Systems, 1981, 4.3, from the end of a longest way between nodes.

#include "actors/soft/node_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tweenfall::soft {

namespace {

/// Calls `join` for each two nodes that an edge, a bend or a tetrahedron joins.
template <typename Join>
void for_each_joined(const SoftSettings& made, const Join& join) {
  for (const SoftEdge& edge : made.edges) join(edge.a, edge.b);
  for (const SoftBend& bend : made.bends)
    for (std::size_t k = 1; k < 4; ++k)
      for (std::size_t other = 0; other < k; ++other)
        if (bend.weights[k] != 0 && bend.weights[other] != 0) join(bend.nodes[k], bend.nodes[other]);
  for (const SoftTetrahedron& solid : made.tetrahedra)
    for (std::size_t k = 1; k < 4; ++k)
      for (std::size_t other = 0; other < k; ++other) join(solid.nodes[k], solid.nodes[other]);
}

using Neighbors = std::vector<std::vector<std::uint32_t>>;

Neighbors neighbors_of(const SoftSettings& made) {
  Neighbors neighbors(made.positions.size());
  for_each_joined(made, [&](std::uint32_t a, std::uint32_t b) {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  });
  for (auto& all : neighbors) {
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  // Those with few neighbors first.
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(neighbors[a].size(), a) < std::pair(neighbors[b].size(), b);
  };
  for (auto& all : neighbors) std::ranges::sort(all, is_before);
  return neighbors;
}

/// Appends a node, its neighbors, theirs, and so on, as far as they are not there.
void append_from(std::uint32_t first, const Neighbors& neighbors, std::vector<char>& there,
                 std::vector<std::uint32_t>& order) {
  std::size_t next = order.size();
  order.push_back(first);
  there[first] = 1;
  for (; next < order.size(); ++next)
    for (const std::uint32_t node : neighbors[order[next]]) {
      if (there[node] != 0) continue;
      there[node] = 1;
      order.push_back(node);
    }
}

/// The last node that is reached from one: an end of what it belongs to.
std::uint32_t end_from(std::uint32_t first, const Neighbors& neighbors, std::vector<char> there) {
  std::vector<std::uint32_t> way;
  append_from(first, neighbors, there, way);
  return way.back();
}

std::vector<std::uint32_t> reversed_order(const SoftSettings& made) {
  const Neighbors neighbors = neighbors_of(made);
  std::vector<char> there(neighbors.size(), 0);
  std::vector<std::uint32_t> order;
  for (std::uint32_t node = 0; node < neighbors.size(); ++node) {
    if (there[node] != 0) continue;
    append_from(end_from(end_from(node, neighbors, there), neighbors, there), neighbors, there, order);
  }
  std::ranges::reverse(order);
  return order;
}

}  // namespace

NodeOrder::NodeOrder(const SoftSettings& made) : size_(made.positions.size()) {
  const auto reach_now = [&] {
    std::size_t reach = 0;
    for_each_joined(made, [&](std::uint32_t a, std::uint32_t b) {
      const std::size_t at_a = place_of(a), at_b = place_of(b);
      reach = std::max(reach, at_a > at_b ? at_a - at_b : at_b - at_a);
    });
    return reach;
  };
  reach_ = reach_now();
  // What is about as wide as long has no order that reaches much less than that.
  const double wide = 1.5 * std::sqrt(static_cast<double>(size_));
  if (static_cast<double>(reach_) <= wide) return;
  nodes_ = reversed_order(made);
  places_.resize(size_);
  for (std::uint32_t place = 0; place < size_; ++place) places_[nodes_[place]] = place;
  const std::size_t other = reach_now();
  if (other < reach_) {
    reach_ = other;
  } else {
    nodes_.clear();
    places_.clear();
  }
}

bool can_be_factored(const SoftSettings& made, const NodeOrder& order) {
  constexpr std::size_t most_reach = 64;
  constexpr double most_blocks = 2e6;  // 72 bytes each, twice
  return made.enclosures.empty() && order.reach() > 0 && order.reach() <= most_reach &&
         static_cast<double>(order.reach()) * static_cast<double>(order.size()) <= most_blocks;
}

}  // namespace tweenfall::soft
