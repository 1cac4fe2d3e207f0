#pragma once

// A node and all nodes below it, as a hierarchy of their own.

#include <tweenfall/anim/hierarchy.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tweenfall::graphs {

class Figure {
 public:
  Figure() = default;
  /// @param root  `no_node`: all nodes
  Figure(const Hierarchy& nodes, std::size_t root) {
    std::vector<std::size_t> own(nodes.size(), no_node);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t parent = nodes[i].parent, above = parent == no_node ? no_node : own[parent];
      if (root != no_node && i != root && above == no_node) continue;
      own[i] = joints_.size();
      joints_.push_back(i);
      Node node = nodes[i];
      node.parent = above;
      nodes_.add(std::move(node));
    }
  }

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  /// The node of each joint of the figure.
  [[nodiscard]] std::span<const std::size_t> joints() const noexcept { return joints_; }

  /// The figure's part of a whole pose. @param out  of the figure's size
  void take(std::span<const Motion> pose, std::span<Motion> out) const noexcept {
    for (std::size_t i = 0; i < joints_.size(); ++i) out[i] = pose[joints_[i]];
  }
  void put(std::span<const Motion> own, std::span<Motion> pose) const noexcept {
    for (std::size_t i = 0; i < joints_.size(); ++i) pose[joints_[i]] = own[i];
  }

 private:
  Hierarchy nodes_;
  std::vector<std::size_t> joints_;
};

}  // namespace tweenfall::graphs
