#pragma once

/// Questions about where the bodies of a stage are at its present instant, also between two steps: exactly on their
/// paths, and as `Stage::world` shows them.

#include <tweenfall/physics/query.h>
#include <tweenfall/physics/stage/stage.h>

namespace tweenfall {

using NodeFilter = Asked<NodeId>;

struct NodeRayHit : RayHit {
  NodeId node = no_node;
};
struct NodeShapeHit : ShapeHit {
  NodeId node = no_node;
};
struct NearestNode {
  NodeId node = no_node;
  double distance = 0;  ///< m; 0 inside
  Vec3 point{0, 0, 0};  ///< of the node's body, world
};

// As for a world; at equal distances, in the order of the bodies. All throw std::logic_error for a stage that was
// moved from.
[[nodiscard]] std::optional<NodeRayHit> cast_ray(const Stage& stage, const Vec3& from, const Vec3& direction,
                                                 double length = std::numeric_limits<double>::infinity(),
                                                 const NodeFilter& filter = {});
[[nodiscard]] std::vector<NodeRayHit> cast_ray_through(const Stage& stage, const Vec3& from, const Vec3& direction,
                                                       double length = std::numeric_limits<double>::infinity(),
                                                       const NodeFilter& filter = {});
[[nodiscard]] std::optional<NodeShapeHit> cast_shape(const Stage& stage, const Shape& shape, const Pose& start,
                                                     const Vec3& displacement, const NodeFilter& filter = {});
[[nodiscard]] std::vector<NodeId> overlapping(const Stage& stage, const Shape& shape, const Pose& pose,
                                              const NodeFilter& filter = {});
[[nodiscard]] std::optional<NearestNode> nearest_body(const Stage& stage, const Vec3& point,
                                                      double within = std::numeric_limits<double>::infinity(),
                                                      const NodeFilter& filter = {});
/// The gap between the bodies of two nodes, and their nearest points.
/// @throws std::invalid_argument for a node without a body, or two planes
[[nodiscard]] Separation distance(const Stage& stage, NodeId a, NodeId b);

}  // namespace tweenfall
