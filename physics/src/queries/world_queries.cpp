#include <tweenfall/physics/detail.h>
#include <tweenfall/physics/query.h>

#include "islands/islands.h"
#include "queries/answers.h"
#include "queries/body_scene.h"
#include "queries/closest.h"
#include "state/world_data.h"

namespace tweenfall {

namespace queries {

/// Access of queries to a world.
class Inside {
 public:
  explicit Inside(const World& asked)
      : world_(asked.inside()),
        scene_(world_.scene.get([this](Scene& scene) { arrange_bodies(scene, world_.bodies); })) {}

  [[nodiscard]] static const World::Implementation& of(const World& asked) { return asked.inside(); }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] BodyId id(std::uint32_t index) const { return {index, world_.bodies[index].generation}; }

 private:
  const World::Implementation& world_;
  const Scene& scene_;
};

}  // namespace queries

std::optional<BodyRayHit> cast_ray(const World& world, const Vec3& from, const Vec3& direction, double length,
                                   const QueryFilter& filter) {
  const queries::Ray ray = queries::checked_ray(from, direction, length);
  return queries::first_on_ray<BodyRayHit>(queries::Inside(world), ray, filter);
}

std::vector<BodyRayHit> cast_ray_through(const World& world, const Vec3& from, const Vec3& direction, double length,
                                         const QueryFilter& filter) {
  const queries::Ray ray = queries::checked_ray(from, direction, length);
  return queries::all_on_ray<BodyRayHit>(queries::Inside(world), ray, filter);
}

std::optional<BodyShapeHit> cast_shape(const World& world, const Shape& shape, const Pose& start,
                                       const Vec3& displacement, const QueryFilter& filter) {
  return queries::first_on_way<BodyShapeHit>(queries::Inside(world), shape, start, displacement, filter);
}

std::vector<BodyId> overlapping(const World& world, const Shape& shape, const Pose& pose, const QueryFilter& filter) {
  return queries::all_overlapping<BodyId>(queries::Inside(world), shape, pose, filter);
}

std::optional<NearestBody> nearest_body(const World& world, const Vec3& point, double within,
                                        const QueryFilter& filter) {
  return queries::nearest<NearestBody>(queries::Inside(world), point, within, filter);
}

const std::vector<state::Body>& queries::bodies_of(const World& world) {
  return Inside::of(world).bodies;
}

const std::vector<forces::NumberedForce>& queries::forces_of(const World& world) {
  return Inside::of(world).forces;
}

std::vector<BodyDetail> body_details(const World& asked) {
  const auto& world = queries::Inside::of(asked);
  const std::vector<state::Body>& bodies = world.bodies;
  islands::Islands islands;
  islands.reset(bodies.size());
  const auto moves = [&](const BodyId& id) {
    const state::Body* body = forces::find_body(bodies, id);
    return body && !body->immovable() && !body->sensor();
  };
  const auto tie = [&](const BodyId& a, const BodyId& b) {
    if (moves(a) && moves(b)) islands.join(a.index, b.index);
  };
  for (const Contact& contact : asked.contacts()) tie(contact.a, contact.b);
  for (const state::Joint& joint : world.joints)
    if (joint.alive) tie(joint.settings.a, joint.settings.b);
  std::vector<std::uint32_t> there;
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].alive) there.push_back(i);
  for (const forces::NumberedForce& entry : world.forces)
    forces::each_tie(entry, bodies, there, [&](std::uint32_t a, std::uint32_t b) {
      tie({a, bodies[a].generation}, {b, bodies[b].generation});
    });
  std::vector<BodyDetail> details;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const state::Body& body = bodies[i];
    if (!body.alive) continue;
    BodyDetail detail{.body = {i, body.generation}, .island = {}, .asleep = body.asleep};
    if (moves(detail.body)) {
      const std::uint32_t first = islands.of(i);
      detail.island = {first, bodies[first].generation};
    }
    const Bounds* const box = world.broad_phase.box(i);
    detail.box = box ? *box : bounds(body.shape(), body.motion.pose);
    details.push_back(detail);
  }
  return details;
}

std::vector<Vec3> contact_places(const World& asked) {
  const auto& world = queries::Inside::of(asked);
  const auto body_of = [&](const BodyId& id) -> const state::Body* {
    if (world.flat.has_value() || id.index >= world.stands.size()) return nullptr;
    return forces::find_body(world.bodies, id);
  };
  const auto carried = [&](const state::Body& body, const BodyId& id, const Vec3& place, const Vec3& outward) -> Vec3 {
    const state::Stand& then = world.stands[id.index];
    const Quat turn = body.motion.pose.rotation * then.rotation.conjugate();
    return body.center + state::carried(turn, place - then.center, body.makeup->roundness * outward);
  };
  std::vector<Vec3> places;
  for (const Contact& contact : asked.contacts()) {
    const state::Body *a = body_of(contact.a), *b = body_of(contact.b);
    const Manifold& manifold = contact.manifold;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
      const Vec3& place = manifold.points[i].position;
      const Vec3 on_a = a ? carried(*a, contact.a, place, manifold.normal) : place;
      const Vec3 on_b = b ? carried(*b, contact.b, place, -manifold.normal) : place;
      const double share_of_b = !a || !b || a->immovable() == b->immovable() ? 0.5 : a->immovable() ? 1 : 0;
      places.push_back(on_a + share_of_b * (on_b - on_a));
    }
  }
  return places;
}

double complementarity_residual(const World& asked) {
  return queries::Inside::of(asked).complementarity;
}

Vec3 closest_point(const World& world, BodyId body, const Vec3& point) {
  return closest_point(world.shape(body), world.motion(body).pose, point);
}

}  // namespace tweenfall
