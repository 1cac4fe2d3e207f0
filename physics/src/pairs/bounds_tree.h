#pragma once

#include <tweenfall/physics/shape.h>

#include <array>
#include <cstdint>
#include <vector>

#include "state/prefetch.h"

namespace tweenfall::pairs {

[[nodiscard]] inline bool overlap(const Bounds& a, const Bounds& b) {
  return a.low.x() <= b.high.x() && b.low.x() <= a.high.x() && a.low.y() <= b.high.y() && b.low.y() <= a.high.y() &&
         a.low.z() <= b.high.z() && b.low.z() <= a.high.z();
}

[[nodiscard]] inline bool contains(const Bounds& outer, const Bounds& inner) {
  return outer.low.x() <= inner.low.x() && inner.high.x() <= outer.high.x() && outer.low.y() <= inner.low.y() &&
         inner.high.y() <= outer.high.y() && outer.low.z() <= inner.low.z() && inner.high.z() <= outer.high.z();
}

/// Boxes of items, which are small numbers, kept from step to step in a binary tree of boxes. The shape of the tree
/// never affects what a visit finds, only the time it takes.
class BoundsTree {
 public:
  /// Adds the item or gives it another box, which must be finite. Visits do not see the change before `settle`.
  void set(std::uint32_t item, const Bounds& bounds);
  void remove(std::uint32_t item);
  [[nodiscard]] bool has(std::uint32_t item) const { return item < leaves_.size() && leaves_[item] != none; }
  [[nodiscard]] const Bounds& of(std::uint32_t item) const { return nodes_[leaves_[item]].bounds; }
  /// Prefetches this item.
  void fetch(std::uint32_t item) const {
    if (has(item)) state::fetch(&nodes_[leaves_[item]]);
  }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Inserts what is new, and rebuilds the tree when too many changes have made it bad.
  void settle();

  /// Calls `see(item)` for every item whose box meets `within`, in no particular order.
  template <class See>
  void visit(const Bounds& within, const See& see) const {
    walk(within, see, [](std::uint32_t) { return true; });
  }

  /// The same, as long as `goes_on()`.
  template <class GoesOn, class See>
  void visit_while(const Bounds& within, const GoesOn& goes_on, const See& see) const {
    walk(within, see, [&](std::uint32_t) { return goes_on(); });
  }

  /// Calls `see(item)` for every item in boxes for which `enters(box)`, which may become false for boxes that were
  /// entered before; of two branches, the one that lies first along a direction comes first.
  template <class Enters, class See>
  void visit_along(const Vec3& direction, const Enters& enters, const See& see) const {
    walk_boxes(enters, see, [&](const Bounds& left, const Bounds& right) {
      return direction.dot(right.low - left.low) + direction.dot(right.high - left.high) >= 0;
    });
  }
  /// The same, but of two branches the one nearer to a point comes first.
  template <class Enters, class See>
  void visit_near(const Vec3& point, const Enters& enters, const See& see) const {
    const auto away = [&](const Bounds& box) {
      return (box.low - point).cwiseMax(point - box.high).cwiseMax(0.0).squaredNorm();
    };
    walk_boxes(enters, see, [&](const Bounds& left, const Bounds& right) { return away(left) <= away(right); });
  }

  /// `visit_open` skips closed items, and whole branches where all are closed.
  void open_all() { closed_.assign(nodes_.size(), 0); }
  void close(std::uint32_t item);
  template <class See>
  void visit_open(const Bounds& within, const See& see) const {
    walk(within, see, [this](std::uint32_t node) { return closed_[node] == 0; });
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::size_t most_depth = 64;

  struct alignas(64) Node {
    Bounds bounds{Vec3::Zero(), Vec3::Zero()};
    std::uint32_t left = none, right = none;  ///< of a leaf: `none`
    std::uint32_t parent = none;
    std::uint32_t item = none;  ///< of a leaf
  };

  template <class See, class Enter>
  void walk(const Bounds& within, const See& see, const Enter& enter) const {
    if (root_ == none) return;
    std::array<std::uint32_t, most_depth + 2> ahead;
    std::size_t count = 0;
    ahead[count++] = root_;
    while (count > 0) {
      const std::uint32_t index = ahead[--count];
      const Node& node = nodes_[index];
      if (!overlap(node.bounds, within) || !enter(index)) continue;
      if (node.left == none) {
        see(node.item);
      } else {
        ahead[count++] = node.right;
        ahead[count++] = node.left;
      }
    }
  }

  template <class Enters, class See, class LeftFirst>
  void walk_boxes(const Enters& enters, const See& see, const LeftFirst& left_first) const {
    if (root_ == none) return;
    std::array<std::uint32_t, most_depth + 2> ahead;
    std::size_t count = 0;
    ahead[count++] = root_;
    while (count > 0) {
      const Node& node = nodes_[ahead[--count]];
      if (!enters(node.bounds)) continue;
      if (node.left == none) {
        see(node.item);
        continue;
      }
      const bool left = left_first(nodes_[node.left].bounds, nodes_[node.right].bounds);
      ahead[count++] = left ? node.right : node.left;
      ahead[count++] = left ? node.left : node.right;
    }
  }

  [[nodiscard]] bool linked(std::uint32_t leaf) const { return leaf == root_ || nodes_[leaf].parent != none; }
  std::uint32_t take_node();
  std::size_t link(std::uint32_t leaf);  ///< @returns its depth now
  void unlink(std::uint32_t leaf);
  void fit(std::uint32_t node);  ///< fits its box and those above it
  void rebuild();
  std::uint32_t build(std::size_t begin, std::size_t end, std::uint32_t parent);

  struct Planted {
    Vec3 middle;
    std::uint32_t item;
  };

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> unused_;  ///< in nodes_
  std::vector<std::uint32_t> leaves_;  ///< by item
  std::vector<std::uint32_t> fresh_;   ///< items that visits do not see yet
  std::vector<char> closed_;           ///< by node
  std::vector<Planted> planted_;       ///< working memory of `rebuild`
  std::vector<Node> before_;           ///< the tree that `rebuild` replaces
  std::uint32_t root_ = none;
  std::size_t size_ = 0;
  std::size_t changes_ = 0;  ///< since the tree was built
};

}  // namespace tweenfall::pairs
