#pragma once

// A place of an operation, bound to its node and parameters.

#include "operations/changing.h"

#include <array>
#include <optional>

namespace tweenfall::graphs {

class BoundPlace {
 public:
  BoundPlace(std::size_t node, std::array<Number, 3> at) : node_(node), at_(std::move(at)) {}

  /// The place in the world, with its velocity. @param pose of all nodes
  [[nodiscard]] Sample<Vec3> sample(const Log& log, const Moment& moment, const Hierarchy& nodes,
                                    std::span<const Motion> pose) const noexcept;

 private:
  std::size_t node_;  // `no_node`: the world
  std::array<Number, 3> at_;
};

/// @param carried  the first joint that the operation turns: a place that it carries is refused; `no_node` for none
[[nodiscard]] std::optional<BoundPlace> bound_place(const GraphPlace& described, const Place& place,
                                                    std::size_t carried, Binder& binder);

/// World motion of a node.
[[nodiscard]] inline WorldMotion world_of(std::size_t node, const Hierarchy& nodes,
                                          std::span<const Motion> pose) noexcept {
  return nodes.world_motion(node, [&](std::size_t i) -> const Motion& { return pose[i]; });
}

}  // namespace tweenfall::graphs
