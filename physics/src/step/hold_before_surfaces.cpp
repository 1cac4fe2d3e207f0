#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <limits>

#include "collision/surfaces/convex_piece.h"
#include "collision/surfaces/touch.h"
#include "queries/on_surface.h"
#include "queries/sweep.h"
#include "state/world_data.h"

namespace tweenfall {

namespace step {
namespace {

/// Number of contacts that are worth a task of their own.
constexpr std::size_t contacts_worth_a_part = 256;
/// A solid is checked if it moves forward in a step by more than this part of its size.
constexpr double far_on = 0.02;
/// Its middle stays in front by this part of its size: held there again and again, it would get closer than rounding
/// allows.
constexpr double in_front = 0.1;

/// Where a body would have been at a time in the step if nothing had touched it.
Pose pose_then(const Start& start, const collision::Course& course, const Vec3& mass_center, double time) {
  Pose pose;
  pose.rotation = normalized(exp_map(course.angular * time) * start.rotation);
  pose.position =
      start.center + course.linear * time + course.acceleration * (0.5 * time * time) - pose.rotation * mass_center;
  return pose;
}

}  // namespace
}  // namespace step

void World::Implementation::find_obstacles() {
  obstacles.resize(active.size());
  workers().ranges(active.size(), step::contacts_worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const state::Body &a = bodies[active[i]->a], &b = bodies[active[i]->b];
      const std::uint32_t mover = a.immovable() ? active[i]->b : active[i]->a;
      if (!by_strategies.empty() && by_strategies[mover] != 0) {
        obstacles[i] = step::Obstacle::none;
        continue;
      }
      const bool surface = surfaces::surface_of(a.shape().solid) || surfaces::surface_of(b.shape().solid);
      obstacles[i] = surface                          ? step::Obstacle::surface
                     : a.immovable() != b.immovable() ? step::Obstacle::solid
                                                      : step::Obstacle::none;
    }
  });
}

void World::Implementation::hold_before_surfaces() {
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (obstacles[i] != step::Obstacle::surface) continue;
    const contacts::ContactConstraint* contact = active[i];
    const bool surface_is_a = surfaces::surface_of(bodies[contact->a].shape().solid) != nullptr;
    const state::Body& ground = bodies[surface_is_a ? contact->a : contact->b];
    const surfaces::Surface* surface = surfaces::surface_of(ground.shape().solid);
    if (!surface) continue;
    const std::uint32_t index = surface_is_a ? contact->b : contact->a;
    state::Body& body = bodies[index];
    const auto* compound = std::get_if<Compound>(&body.shape().solid);
    const Shape& part = compound ? compound->parts()[surface_is_a ? contact->part_b : contact->part_a] : body.shape();
    const double met = contact->impact_time;
    const Pose then = step::pose_then(starts[index], passages[index].course, body.mass().center, met);
    const std::uint32_t ground_index = surface_is_a ? contact->a : contact->b;
    const collision::Course& ground_course = passages[ground_index].course;
    const bool ground_stands = ground_course.linear == Vec3::Zero() && ground_course.angular == Vec3::Zero();
    const Pose ground_then = ground_stands
                                 ? ground.motion.pose
                                 : step::pose_then(starts[ground_index], ground_course, ground.mass().center, met);
    const Vec3 middle = surfaces::middle_of(part.solid);
    const auto middle_at = [&](const Pose& pose, const Pose& ground_pose) {
      const shapes::Placed placed = shapes::place(part, pose);
      return surfaces::seen_from(shapes::place(ground.shape(), ground_pose),
                                 {placed.center + placed.axes * middle, Mat3::Identity()})
          .center;
    };
    const Vec3 from = middle_at(then, ground_then), to = middle_at(body.motion.pose, ground.motion.pose);
    const Vec3 way = to - from;
    const double length = way.norm();
    std::optional<convex::Core> core = surfaces::convex_piece(part.solid, {Vec3::Zero(), Mat3::Identity()});
    if (!core || !(length > step::far_on * core->size)) continue;
    const shapes::Placed here{Vec3::Zero(), Mat3::Identity()};
    const std::optional<RayHit> hit = queries::first_on_surface(*surface, here, {from, way / length, length});
    if (!hit) continue;
    // Back to where it first touches, or with its middle just before the surface.
    const shapes::Placed now = shapes::place(ground.shape(), ground.motion.pose);
    const Vec3 back = now.axes * way;
    Pose start = body.motion.pose;
    start.position -= back;
    double share = 0.999 * hit->distance / length;
    const std::optional<ShapeHit> touched =
        queries::first_on_way(part, start, back, ground.shape(), ground.motion.pose);
    if (touched && !touched->inside) share = std::min(share, touched->fraction);
    body.center -= (1 - share) * back;
    const double height = hit->normal.dot(from + share * way - hit->point);
    body.center += std::max(0.0, step::in_front * core->size - height) * (now.axes * hit->normal);
    body.follow_center(Quat(body.motion.pose.rotation));
  }
}

}  // namespace tweenfall
