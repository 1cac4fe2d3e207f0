#include <tweenfall/physics/query.h>

#include "queries/answers.h"
#include "queries/body_scene.h"
#include "queries/closest.h"
#include "state/world_data.h"

namespace tweenfall {

namespace queries {

/// What questions may see of a world.
class Inside {
 public:
  explicit Inside(const World& asked)
      : world_(asked.inside()),
        scene_(world_.scene.get([this](Scene& scene) { arrange_bodies(scene, world_.bodies); })) {}

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

Vec3 closest_point(const World& world, BodyId body, const Vec3& point) {
  return closest_point(world.shape(body), world.motion(body).pose, point);
}

}  // namespace tweenfall
