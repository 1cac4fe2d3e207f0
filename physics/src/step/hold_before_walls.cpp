#include <algorithm>

#include "collision/surfaces/convex_piece.h"
#include "collision/surfaces/surface.h"
#include "queries/rays.h"
#include "queries/sweep.h"
#include "state/world_data.h"

/// A blow may turn a small body so fast that no row follows it to the end of the step, and its corners then pull it
/// through the body it struck. The middle of a body never passes through anything fixed or led: it is taken back to
/// where it first touches.

namespace tweenfall {

namespace step {
namespace {

/// A solid is checked if its middle moves in a step by more than this part of its size.
constexpr double farther_on = 0.02;
/// A led body that turns by more than this in the step is not checked, rad: seen from it, straight paths are bent.
constexpr double turns_away = 0.3;
/// Number of contacts that are worth a task of their own.
constexpr std::size_t walls_worth_a_part = 256;

/// About the distance from a solid's middle to its nearest surface point, m; 0 if only its core tells.
double thickness(const Solid& solid) {
  if (const auto* box = std::get_if<Box>(&solid)) return box->half_extents.minCoeff();
  if (const auto* sphere = std::get_if<Sphere>(&solid)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&solid)) return capsule->radius;
  if (const auto* hull = std::get_if<Hull>(&solid)) return hull->convex.inner_radius();
  return 0;
}

/// At least the distance that any point of the body moved in the step, m.
double came_on(const state::Body& body, const Start& start) {
  // The chord of a turn is no longer than that of the whole turn of a quaternion, which turns by half of it.
  const Vec4 turned = body.motion.pose.rotation.coeffs() - start.rotation.coeffs();
  return (body.center - start.center).norm() + 2 * body.radius() * turned.norm();
}

bool stands(const state::Body& body, const Start& start) {
  return body.center == start.center && body.motion.pose.rotation.coeffs() == start.rotation.coeffs();
}

const Shape& part_of(const state::Body& body, std::uint32_t number) {
  const auto* compound = std::get_if<Compound>(&body.shape().solid);
  return compound ? compound->parts()[number] : body.shape();
}

/// A contact of a movable body with one that is not.
struct WallContact {
  bool wall_is_a;
  std::uint32_t index, part, wall, wall_part;

  WallContact(const contacts::ContactConstraint& contact, const std::vector<state::Body>& bodies)
      : wall_is_a(bodies[contact.a].immovable()),
        index(wall_is_a ? contact.b : contact.a),
        part(wall_is_a ? contact.part_b : contact.part_a),
        wall(wall_is_a ? contact.a : contact.b),
        wall_part(wall_is_a ? contact.part_a : contact.part_b) {}
};

}  // namespace
}  // namespace step

/// Most bodies have not moved far enough, which shows without their cores.
bool World::Implementation::may_pass_wall(const contacts::ContactConstraint& contact, double dt) const {
  const step::WallContact its(contact, bodies);
  const state::Body &body = bodies[its.index], &wall = bodies[its.wall];
  // Behind a plane there is no other side.
  if (moved[its.index] == 0 || std::holds_alternative<Plane>(wall.shape().solid)) return false;
  const Shape& part = step::part_of(body, its.part);
  if (step::stands(wall, starts[its.wall]) &&
      step::came_on(body, starts[its.index]) <= step::farther_on * step::thickness(part.solid))
    return false;
  return !(passages[its.wall].course.angular.norm() * dt > step::turns_away);
}

void World::Implementation::hold_before_walls(double dt) {
  workers().ranges(active.size(), step::walls_worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (obstacles[i] == step::Obstacle::solid && !may_pass_wall(*active[i], dt)) obstacles[i] = step::Obstacle::none;
  });
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (obstacles[i] != step::Obstacle::solid) continue;
    const step::WallContact its(*active[i], bodies);
    const std::uint32_t index = its.index;
    state::Body& body = bodies[index];
    const state::Body& wall = bodies[its.wall];
    const Shape& part = step::part_of(body, its.part);
    const step::Start& start = starts[index];
    const step::Start& wall_start = starts[its.wall];
    const Shape& wall_part = step::part_of(wall, its.wall_part);
    const std::optional<convex::Core> core = surfaces::convex_piece(part.solid, {Vec3::Zero(), Mat3::Identity()});
    if (!core) continue;
    const Vec3 middle = surfaces::middle_of(part.solid);
    const auto middle_at = [&](const Pose& pose) -> Vec3 {
      const shapes::Placed placed = shapes::place(part, pose);
      return placed.center + placed.axes * middle;
    };
    Pose before;
    before.rotation = start.rotation;
    before.position = start.center - start.rotation * body.mass().center;
    // Relative to the wall, which may have moved meanwhile.
    const shapes::Placed wall_then = {wall_start.center, wall_start.rotation.toRotationMatrix()},
                         wall_now = {wall.center, wall.motion.pose.rotation.toRotationMatrix()};
    const Vec3 from =
        wall_now.center + wall_now.axes * (wall_then.axes.transpose() * (middle_at(before) - wall_then.center));
    const Vec3 way = middle_at(body.motion.pose) - from;
    const double length = way.norm();
    if (!(length > step::farther_on * core->size)) continue;
    const std::optional<RayHit> hit = queries::first_on_ray(wall_part, wall.motion.pose, {from, way / length, length});
    // A jointed body would be torn off.
    const auto joins = [index](const joints::JointLink& link) { return link.a == index || link.b == index; };
    if (!hit || hit->inside || std::any_of(links.begin(), links.end(), joins)) continue;
    Pose back = body.motion.pose;
    back.position -= way;
    double share = 0.999 * hit->distance / length;
    const std::optional<ShapeHit> touched = queries::first_on_way(part, back, way, wall_part, wall.motion.pose);
    if (touched && !touched->inside) share = std::min(share, touched->fraction);
    body.center -= (1 - share) * way;
    body.follow_center(Quat(body.motion.pose.rotation));
  }
}

}  // namespace tweenfall
