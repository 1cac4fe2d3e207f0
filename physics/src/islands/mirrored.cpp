#include "islands/mirrored.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "joints/placement.h"
#include "step/keyed_step.h"

namespace tweenfall::islands {

namespace {

using state::Body;

/// Rounding of velocities and accelerations: relative, and in m/s, rad/s and so on.
constexpr double blur = 1e-13, faint = 1e-13;
/// Rounding of places, as a part of a body's size and of its distance from the world's origin.
constexpr double blur_of_place = 1e-12, blur_far_off = 1e-14;
/// Rounding of a direction, rad: many turns one after another add up to less.
constexpr double turned_off = 1e-11;
/// Sine of the least angle between two directions that tell the plane they are in; and spin, speed or distance above
/// which one tells.
constexpr double askew = 1e-3, least_spin = 1e-9;

constexpr std::uint32_t nobody = joints::JointLink::world;
static_assert(step::SpringRow::world == nobody);

/// Whether a vector lies in the plane.
bool within(const Vec3& vector, const Vec3& normal) {
  const double across = normal.dot(vector);
  return across * across <= blur * blur * vector.squaredNorm() + faint * faint;
}
/// Whether it is perpendicular to the plane, as turns and torques are that do not lead out of it.
bool about(const Vec3& vector, const Vec3& normal) {
  const Vec3 rest = vector - normal.dot(vector) * normal;
  return rest.squaredNorm() <= blur * blur * vector.squaredNorm() + faint * faint;
}
bool within(const Twist& twist, const Vec3& normal) {
  return within(twist.linear, normal) && about(twist.angular, normal);
}

/// Whether its forces and its velocity leave it in the plane.
bool stays(const Body& body, const forces::Load& load, const Vec3& normal) {
  return within(body.twist, normal) && within(load.acceleration, normal) && within(load.end_acceleration, normal) &&
         about(load.torque, normal) && body.drive.owner() != Owner::driven;
}

/// Whether its inertia does not mix turns about the normal with others.
bool balanced(const Body& body, const Vec3& normal) {
  if (body.spherical()) return true;
  const Vec3 axis = body.motion.pose.rotation.conjugate() * normal;
  const Vec3 momentum = body.mass().inertia * axis;
  const double moment = axis.dot(momentum);
  return (momentum - moment * axis).squaredNorm() <= 1e-22 * moment * moment;
}

bool is_led_within(const Body& body, const Vec3& normal, double dt) {
  const step::KeyedCourse course = step::keyed_course(body, dt);
  return within(course.mean, normal) && within(course.gain, normal) && within(course.bow, normal);
}

bool conveys_within(const Body& body, const Vec3& normal) {
  return !body.conveys || within(body.surface(), normal);
}

/// Whether a joint of the island holds nothing out of a plane, and lets nothing turn but about its normal.
bool holds_within(const joints::JointLink& link, const std::vector<Body>& bodies, const shapes::Mirror& mirror) {
  const joints::Placement at = joints::placement_in(*link.joint, bodies);
  for (const Vec3& end : {at.point_a(), at.point_b()}) {
    const double far = (end - mirror.point).norm() + end.norm() + mirror.point.norm();
    if (std::abs(mirror.normal.dot(end - mirror.point)) > blur_of_place * far) return false;
  }
  const auto along = [&](const Vec3& axis) { return axis.cross(mirror.normal).norm() <= turned_off; };
  const auto turned_alike = [&] {
    const Vec3 turn = (at.axes_b * at.axes_a.conjugate()).vec();
    return turn.cross(mirror.normal).norm() <= turned_off;
  };
  const JointKind& kind = link.joint->settings.kind;
  if (std::holds_alternative<BallJoint>(kind) || std::holds_alternative<DistanceJoint>(kind) ||
      std::holds_alternative<SpringJoint>(kind))
    return true;
  if (std::holds_alternative<HingeJoint>(kind) || std::holds_alternative<WheelJoint>(kind))
    return along(at.x_a()) && along(at.x_b());
  if (std::holds_alternative<SliderJoint>(kind))
    return std::abs(at.x_a().dot(mirror.normal)) <= turned_off && turned_alike();
  return std::holds_alternative<FixedJoint>(kind) && turned_alike();
}

/// Calls `see(a, b)` with the ends of all that holds an island together, until it returns true.
template <class See>
bool any_tie(const IslandContents& island, const See& see) {
  const auto any = [&](const auto& ties) {
    return std::any_of(ties.begin(), ties.end(), [&](const auto* tie) { return see(tie->a, tie->b); });
  };
  return any(island.contacts) || any(island.joints) || any(island.springs);
}

state::Mirrored kind_of(const Vec3& normal) {
  if (normal == Vec3::Unit(0)) return state::Mirrored::along_x;
  if (normal == Vec3::Unit(1)) return state::Mirrored::along_y;
  return normal == Vec3::Unit(2) ? state::Mirrored::along_z : state::Mirrored::askew;
}

/// Normals of planes in which an island may lie, most likely first; none along an axis of the world.
struct Candidates {
  std::array<Vec3, 3> normals;
  std::size_t count = 0;

  void add(const Vec3& direction) {
    if (!(direction.squaredNorm() > askew * askew)) return;
    const Vec3 normal = direction.normalized();
    const auto is_along = [&](int axis) { return about(normal, Vec3::Unit(axis)); };
    if (!is_along(0) && !is_along(1) && !is_along(2)) normals[count++] = normal;
  }
  [[nodiscard]] auto begin() const { return normals.begin(); }
  [[nodiscard]] auto end() const { return normals.begin() + static_cast<std::ptrdiff_t>(count); }
};

/// Planes that the shape of a body tells, which hangs or stands still under a pull in this direction.
Candidates told_by_shape(const Body& body, const Vec3& down) {
  Candidates candidates;
  const Mat3 axes = (body.motion.pose.rotation * body.shape().offset.rotation).toRotationMatrix();
  const Solid& solid = body.shape().solid;
  if (std::holds_alternative<Box>(solid) || std::holds_alternative<Hull>(solid) ||
      std::holds_alternative<Compound>(solid)) {
    for (int i = 0; i < 3; ++i) candidates.add(axes.col(i));
    return candidates;
  }
  const Vec3 level = axes.col(1).cross(down);
  const Vec3 normal = level.norm() > askew ? level : Vec3(axes.col(0).cross(down));
  candidates.add(normal);
  candidates.add(down.cross(normal));
  return candidates;
}

/// Planes that are askew to all axes of the world.
Candidates askew_candidates(const IslandContents& island, const std::vector<Body>& bodies,
                            const std::vector<forces::Load>& loads) {
  const Body* first = nullptr;
  Vec3 down{0, 0, 0}, normal{0, 0, 0};
  const auto tells = [&](std::uint32_t index) {
    if (index == nobody || bodies[index].immovable()) return false;
    const Body& body = bodies[index];
    if (!first) {
      first = &body;
      down = loads[index].acceleration.normalized();
    }
    // At rest they could hardly tell it again.
    if (body.across() != Vec3::Zero()) {
      normal = body.across();
      return true;
    }
    if (body.twist.angular.squaredNorm() > least_spin * least_spin) {
      normal = body.twist.angular.normalized();
      return true;
    }
    // Without spins, two directions in the plane tell.
    for (const Vec3& other : {body.twist.linear, Vec3(body.center - first->center)}) {
      const Vec3 one = down == Vec3::Zero() ? Vec3(first->twist.linear.normalized()) : down;
      normal = one.cross(other);
      if (other.norm() > least_spin && normal.norm() > askew * other.norm()) return true;
    }
    return false;
  };
  const bool told = any_tie(island, [&](std::uint32_t a, std::uint32_t b) { return tells(a) || tells(b); });
  Candidates candidates;
  if (told) {
    normal.normalize();
    candidates.add(normal);
    // What only falls or rests may lie in the plane across this one, too.
    candidates.add(normal.cross(down));
  } else if (first && down != Vec3::Zero()) {
    candidates = told_by_shape(*first, down);
  }
  return candidates;
}

}  // namespace

void MirroredIslands::begin(std::size_t bodies) {
  looked_at_.resize(bodies, 0);
  kept_.clear();
  touches_.clear();
}

bool MirroredIslands::is_mover_mirrored(std::uint32_t index, const Scene& scene, const shapes::Mirror& mirror) {
  if (looked_at_[index] == look_) return true;
  const Body& body = scene.bodies[index];
  const auto is_in_plane = [&] {
    const double off = blur_of_place * body.radius() + blur_far_off * (body.center.norm() + mirror.point.norm());
    return std::abs(mirror.normal.dot(body.center - mirror.point)) <= off;
  };
  if (!stays(body, scene.loads[index], mirror.normal) || !is_in_plane() || !balanced(body, mirror.normal) ||
      !conveys_within(body, mirror.normal) ||
      !shapes::is_mirrored_near(body.shape(), body.motion.pose, {mirror.normal, body.center}, 0))
    return false;
  looked_at_[index] = look_;
  members_.push_back(index);
  return true;
}

bool MirroredIslands::is_mirrored(const IslandContents& island, const Scene& scene, const Vec3& normal) {
  members_.clear();
  ++look_;
  const std::vector<Body>& bodies = scene.bodies;
  const auto moves = [&](std::uint32_t index) { return index != nobody && !bodies[index].immovable(); };
  shapes::Mirror mirror{normal, Vec3::Zero()};
  if (!any_tie(island, [&](std::uint32_t a, std::uint32_t b) {
        if (!moves(a) && !moves(b)) return false;
        mirror.point = bodies[moves(a) ? a : b].center;
        return true;
      }))
    return false;
  const auto is_end_mirrored = [&](std::uint32_t index) {
    return index == nobody ||
           (moves(index) ? is_mover_mirrored(index, scene, mirror) : is_led_within(bodies[index], normal, scene.dt));
  };
  if (any_tie(island, [&](std::uint32_t a, std::uint32_t b) { return !is_end_mirrored(a) || !is_end_mirrored(b); }))
    return false;
  const auto are_obstacles_mirrored = [&](const contacts::ContactConstraint* contact) {
    const std::uint32_t index = moves(contact->a) ? contact->b : contact->a;
    const std::uint32_t mover = moves(contact->a) ? contact->a : contact->b;
    return moves(index) ||
           (conveys_within(bodies[index], normal) &&
            shapes::is_mirrored_near(bodies[index].shape(), bodies[index].motion.pose, mirror, bodies[mover].radius()));
  };
  const auto is_spring_mirrored = [&](const step::SpringRow* spring) {
    const auto is_in_plane = [&](std::uint32_t end, const Vec3& local) {
      const Vec3 place = end == nobody ? local : Vec3(bodies[end].center + bodies[end].motion.pose.rotation * local);
      return std::abs(normal.dot(place - mirror.point)) <=
             blur_of_place * (local.norm() + place.norm() + mirror.point.norm());
    };
    return is_in_plane(spring->a, spring->local_a) && is_in_plane(spring->b, spring->local_b);
  };
  return std::ranges::all_of(island.contacts, are_obstacles_mirrored) &&
         std::ranges::all_of(island.springs, is_spring_mirrored) &&
         std::ranges::all_of(island.joints, [&](const auto* link) { return holds_within(*link, bodies, mirror); });
}

void MirroredIslands::take(const IslandContents& island, std::vector<Body>& bodies, const Vec3& normal) {
  const bool held = !island.joints.empty();
  for (contacts::ContactConstraint* contact : island.contacts) touches_.push_back({contact, normal});
  const state::Mirrored kind = kind_of(normal);
  for (const std::uint32_t index : members_) {
    kept_.push_back({index, normal});
    Body& body = bodies[index];
    if (kind == state::Mirrored::askew) body.set_across(normal);
    if (!held) body.mirrored = body.mirrored == state::Mirrored::in_none ? kind : state::Mirrored::twice;
  }
}

/// Forgets the planes that its bodies have left.
void MirroredIslands::forget(const IslandContents& island, std::vector<Body>& bodies) {
  any_tie(island, [&](std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t index : {a, b})
      if (index != nobody && !bodies[index].immovable()) bodies[index].set_across(Vec3::Zero());
    return false;
  });
}

void MirroredIslands::find(std::span<const IslandContents> islands, std::vector<Body>& bodies,
                           const std::vector<forces::Load>& loads, double dt) {
  if (any()) return;
  const Scene scene{bodies, loads, dt};
  for (const IslandContents& island : islands) {
    const Candidates candidates = askew_candidates(island, bodies, loads);
    bool any_askew = false;
    for (const Vec3& normal : candidates)
      if (is_mirrored(island, scene, normal)) {
        take(island, bodies, normal);
        any_askew = true;
      }
    if (any_askew) continue;
    if (candidates.count > 0) forget(island, bodies);
    for (int i = 0; i < 3; ++i)
      if (is_mirrored(island, scene, Vec3::Unit(i))) take(island, bodies, Vec3::Unit(i));
  }
}

void MirroredIslands::keep(Body& body, const FreeStart& start, const Vec3& normal) {
  const bool turned = body.motion.pose.rotation.coeffs() != start.rotation.coeffs();
  const double off = normal.dot(start.center - body.center), leaving = normal.dot(body.twist.linear);
  const Vec3 spin = normal.dot(body.twist.angular) * normal;
  if (off == 0 && leaving == 0 && spin == body.twist.angular && !turned) return;
  body.center += off * normal;
  body.twist.linear -= leaving * normal;
  body.twist.angular = spin;
  if (!turned) {
    body.follow_center(start.rotation);
    return;
  }
  const Quat turn = body.motion.pose.rotation * start.rotation.conjugate();
  const Vec3 about_normal = normal.dot(turn.vec()) * normal;
  Quat kept(turn.w(), about_normal.x(), about_normal.y(), about_normal.z());
  kept = kept * start.rotation;
  if (!(kept.squaredNorm() > 0)) kept = start.rotation;
  body.follow_center(kept.normalized());
}

void MirroredIslands::keep(contacts::ContactConstraint& contact, const Vec3& normal) {
  for (contacts::PointConstraint& point : contact.points)
    point.total_friction -= normal.dot(point.total_friction) * normal;
}

void MirroredIslands::end(std::vector<Body>& bodies) const {
  for (const Member& member : kept_) bodies[member.index].mirrored = state::Mirrored::in_none;
}

}  // namespace tweenfall::islands
