#pragma once

#include <tweenfall/physics/shape.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::surfaces {

/// Boxes that never change, in a binary tree of boxes.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::span<const Bounds> items);

  [[nodiscard]] const Bounds& bounds() const noexcept { return nodes_.front().bounds; }

  /// Calls `see(item)` for every item in boxes for which `enters(box)`, which may become false for boxes that come
  /// later; of two branches, the left one comes first if `left_first(left, right)`.
  template <class Enters, class See, class LeftFirst>
  void walk(const Enters& enters, const See& see, const LeftFirst& left_first) const {
    std::array<std::uint32_t, most_depth> ahead;
    std::size_t count = 0;
    ahead[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[ahead[--count]];
      if (!enters(node.bounds)) continue;
      if (node.items > 0) {
        for (std::uint32_t i = 0; i < node.items; ++i) see(order_[node.first + i]);
        continue;
      }
      const bool left = left_first(nodes_[node.first].bounds, nodes_[node.first + 1].bounds);
      ahead[count++] = left ? node.first + 1 : node.first;
      ahead[count++] = left ? node.first : node.first + 1;
    }
  }

 private:
  static constexpr std::size_t most_depth = 64, leaf_size = 4;

  struct Node {
    Bounds bounds;
    std::uint32_t first = 0;  ///< of its items, or of its two branches
    std::uint32_t items = 0;  ///< 0: it has branches
  };

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

[[nodiscard]] inline Bounds united(const Bounds& a, const Bounds& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

/// Whether a box that moves along a straight path meets another one.
[[nodiscard]] bool meets_on_way(const Bounds& moving, const Vec3& way, const Bounds& box);

}  // namespace tweenfall::surfaces
