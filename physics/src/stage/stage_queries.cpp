#include <tweenfall/physics/stage/detail.h>
#include <tweenfall/physics/stage/query.h>

#include <algorithm>
#include <stdexcept>

#include "queries/answers.h"
#include "stage/stage_implementation.h"

namespace tweenfall {

namespace queries {

/// Access of queries to a stage.
class InsideStage {
 public:
  explicit InsideStage(const Stage& stage)
      : timeline_(stage.inside()), scene_(timeline_.scene.get([this](Scene& scene) { arrange(scene); })) {}

  [[nodiscard]] static const staging::StageState& shown(const Stage& stage) { return stage.inside().current(); }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] NodeId id(std::uint32_t item) const { return timeline_.current().bodies[item].node; }
  /// @throws std::invalid_argument for a node without a body
  [[nodiscard]] const Item& body_of(NodeId node) const {
    return scene_[static_cast<std::uint32_t>(staging::body_index(timeline_.current(), node))];
  }

 private:
  void arrange(Scene& scene) const {
    const auto [from, to] = timeline_.around();
    const staging::StageState &first = *from, &second = *to;
    scene.arrange(first.bodies.size(), [&first, &second, this](std::uint32_t index) -> Item {
      const staging::StagedBody& body = first.bodies[index];
      if (!body.present) return {};
      return {&first.world.shape(body.id), staging::body_pose(first, second, index, timeline_.now()),
              std::uint64_t{body.id.generation} << 32 | body.id.index, first.world.groups(body.id),
              first.world.is_sensor(body.id)};
    });
  }

  const staging::Timeline& timeline_;
  const Scene& scene_;
};

}  // namespace queries

std::optional<NodeRayHit> cast_ray(const Stage& stage, const Vec3& from, const Vec3& direction, double length,
                                   const NodeFilter& filter) {
  const queries::Ray ray = queries::checked_ray(from, direction, length);
  return queries::first_on_ray<NodeRayHit>(queries::InsideStage(stage), ray, filter);
}

std::vector<NodeRayHit> cast_ray_through(const Stage& stage, const Vec3& from, const Vec3& direction, double length,
                                         const NodeFilter& filter) {
  const queries::Ray ray = queries::checked_ray(from, direction, length);
  return queries::all_on_ray<NodeRayHit>(queries::InsideStage(stage), ray, filter);
}

std::optional<NodeShapeHit> cast_shape(const Stage& stage, const Shape& shape, const Pose& start,
                                       const Vec3& displacement, const NodeFilter& filter) {
  return queries::first_on_way<NodeShapeHit>(queries::InsideStage(stage), shape, start, displacement, filter);
}

std::vector<NodeId> overlapping(const Stage& stage, const Shape& shape, const Pose& pose, const NodeFilter& filter) {
  return queries::all_overlapping<NodeId>(queries::InsideStage(stage), shape, pose, filter);
}

std::optional<NearestNode> nearest_body(const Stage& stage, const Vec3& point, double within,
                                        const NodeFilter& filter) {
  return queries::nearest<NearestNode>(queries::InsideStage(stage), point, within, filter);
}

Separation distance(const Stage& stage, NodeId a, NodeId b) {
  const queries::InsideStage inside(stage);
  const queries::Item &first = inside.body_of(a), &second = inside.body_of(b);
  return distance(*first.shape, first.pose, *second.shape, second.pose);
}

StageDetail detail_of(const Stage& stage) {
  const staging::StageState& state = queries::InsideStage::shown(stage);
  StageDetail detail;
  const auto node_of = [&](const BodyId& body) { return state.node_of[body.index]; };
  // For each island, by its first body, the first node.
  std::vector<NodeId> first(state.node_of.size(), no_node);
  const std::vector<BodyDetail> bodies = body_details(state.world);
  for (const BodyDetail& body : bodies) {
    detail.nodes.push_back({.node = node_of(body.body), .asleep = body.asleep, .box = body.box});
    if (body.island != BodyId{}) first[body.island.index] = std::min(first[body.island.index], node_of(body.body));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].island != BodyId{}) detail.nodes[i].island = first[bodies[i].island.index];
  std::ranges::sort(detail.nodes, {}, &NodeDetail::node);
  const std::vector<Vec3> places = contact_places(state.world);
  for (const Contact& contact : state.world.contacts())
    for (int i = 0; i < contact.manifold.count; ++i)
      detail.contacts.push_back({.a = node_of(contact.a),
                                 .b = node_of(contact.b),
                                 .point = places[detail.contacts.size()],
                                 .normal = contact.manifold.normal,
                                 .impulse = contact.impulse});
  return detail;
}

}  // namespace tweenfall
