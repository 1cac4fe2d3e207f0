#pragma once

#include <tweenfall/physics/world.h>

#include <memory>

#include "state/boxed.h"
#include "state/countable.h"

namespace tweenfall::state {

/// What a body is made of, unchanged from when it is added until it is removed.
struct Makeup {
  Shape shape;
  MassProperties mass;                  ///< kept while keyed; the solver masks it
  Mat3 inverse_inertia = Mat3::Zero();  ///< node axes
  double radius = 0;                    ///< farthest point from the center of mass, m; infinite for a plane
  double roundness = 0;                 ///< radius with which the surface rolls, of a ball or a capsule, m
  double linear_damping = 0;
  double angular_damping = 0;
  double friction = 0;
  double restitution = 0;
  double rolling_friction = 0;
  double spinning_friction = 0;
  Combine friction_combine = Combine::usual;
  Combine restitution_combine = Combine::usual;
  std::optional<Detection> collision{};
  bool sensor = false;
  bool weighed = false;    ///< its mass properties were given, not those of an even solid
  bool spherical = false;  ///< the same moment about every axis: spin feels no gyroscopic torque
  bool aligned = false;    ///< the node's axes are principal ones
  bool slender = false;    ///< like a rod: small errors of where it points would change the energy of its spin much
  bool turned = false;     ///< what it rolls with depends on where it is touched; also for a compound
};

/// The makeup of no body.
[[nodiscard]] const std::shared_ptr<const Makeup>& no_makeup();

/// Only for bodies that are led, carry others without moving, or have a moving surface.
struct Extra {
  Motion target;           ///< of the node's origin at the end of the step
  Vec3 reaction{0, 0, 0};  ///< N s
  Twist surface_velocity;  ///< at the center of mass, node axes
};

/// What the caller applied for the next step; and what only few bodies remember.
struct Work {
  Vec3 force{0, 0, 0};   ///< N
  Vec3 torque{0, 0, 0};  ///< N m
  Vec3 across{0, 0, 0};  ///< unit normal of a plane askew to the world's axes in which it was kept; 0: none
};

/// The planes in which all that a body touches is its own mirror image, and it with it: by their normals.
enum class Mirrored : std::uint8_t { in_none, along_x, along_y, along_z, askew, twice };

/// What a body may meet, as the caller last set it.
struct Filter {
  std::uint64_t groups = 1;
  std::uint64_t collides_with = ~std::uint64_t{0};
  bool operator==(const Filter&) const = default;
};

/// Everything the world knows about one body. Plain values: a copy of it steps to the same bits. What equal bodies
/// have in common is in `makeup`, and what only few have is in `extra`.
struct Body {
  bool alive = false;
  bool fixed = false;
  bool asleep = false;
  bool placed = true;       ///< added or moved by the caller since the last step: bodies asleep beside it wake
  bool has_target = false;  ///< a target was set since the last step
  bool led = false;         ///< driven, and its target moved
  bool saturated = false;   ///< its drive was at its limit in the last step
  bool squeezed = false;    ///< in the last step, bodies that are led threw it
  bool conveys = false;     ///< its surface moves
  Mirrored mirrored{};      ///< within a step
  std::uint32_t generation = 0;
  Drive drive;
  double still_for = 0;  ///< s

  Vec3 center{0, 0, 0};  ///< center of mass, world
  Twist twist;           ///< at the center of mass
  Motion motion;         ///< of the node's origin, exactly as set while keyed
  Boxed<Work> work;      ///< of bodies to which the caller applied some

  Boxed<Filter> filter;                                ///< of bodies that do not meet all others
  std::shared_ptr<const Makeup> makeup = no_makeup();  ///< never null
  Boxed<Extra> extra;                                  ///< of all that do not move by themselves alone

  [[nodiscard]] const Shape& shape() const { return makeup->shape; }
  [[nodiscard]] const MassProperties& mass() const { return makeup->mass; }
  [[nodiscard]] const Mat3& inverse_inertia() const { return makeup->inverse_inertia; }
  [[nodiscard]] double radius() const { return makeup->radius; }
  [[nodiscard]] bool spherical() const { return makeup->spherical; }
  [[nodiscard]] bool aligned() const { return makeup->aligned; }
  [[nodiscard]] bool slender() const { return makeup->slender; }
  /// A ball around its center of mass: no contact without friction can turn it.
  [[nodiscard]] bool round() const {
    return spherical() && std::holds_alternative<Sphere>(shape().solid) && mass().center == shape().offset.position;
  }
  [[nodiscard]] bool sensor() const { return makeup->sensor; }
  [[nodiscard]] std::uint64_t groups() const { return filter.value().groups; }
  [[nodiscard]] std::uint64_t collides_with() const { return filter.value().collides_with; }
  /// Whether the filters of both let them meet.
  [[nodiscard]] bool may_meet(const Body& other) const {
    return (groups() & other.collides_with()) != 0 && (other.groups() & collides_with()) != 0;
  }
  void set_filter(const Filter& its);
  /// Of the node's origin at the end of the step.
  [[nodiscard]] const Motion& target() const { return extra.value().target; }
  [[nodiscard]] Motion& target() { return extra.own().target; }

  [[nodiscard]] const Vec3& force() const { return work.value().force; }
  [[nodiscard]] const Vec3& torque() const { return work.value().torque; }
  /// The normal of the last plane askew to the world's axes in which it was kept; 0: none.
  [[nodiscard]] const Vec3& across() const { return work.value().across; }
  void set_across(const Vec3& normal) {
    if (normal != across()) work.own().across = normal;
  }
  void clear_work() {
    if (work.has_value()) work.own().force = work.own().torque = Vec3::Zero();
  }

  [[nodiscard]] bool immovable() const { return fixed || drive.owner() == Owner::keyed; }
  /// What the caller applied, plus the share of the weight that a drive carries, N.
  [[nodiscard]] Vec3 steady_force(const Vec3& gravity) const {
    if (drive.gravity_compensation == 0 || drive.owner() != Owner::driven) return force();
    return force() - (drive.gravity_compensation * mass().mass) * gravity;
  }
  /// Whether it is moving to another place in this step.
  [[nodiscard]] bool displaces() const {
    return has_target && !fixed &&
           (target().pose.position != motion.pose.position ||
            target().pose.rotation.coeffs() != motion.pose.rotation.coeffs());
  }
  /// Whether it may change what touches it.
  [[nodiscard]] bool stirs() const { return placed || (immovable() ? displaces() : !asleep); }
  /// Whether its position and velocity are numbers that a world accepts.
  [[nodiscard]] bool finite() const {
    return countable(center) && countable(motion.pose.position) && motion.pose.rotation.coeffs().allFinite() &&
           countable(twist.linear) && countable(twist.angular) && countable(motion.twist.linear);
  }
  [[nodiscard]] Mat3 world_inertia(const Quat& rotation) const;
  /// Within a step, only for turns that do not lead out of its mirrors: each impulse comes with its mirror image.
  [[nodiscard]] Mat3 world_inverse_inertia(const Quat& rotation) const;

  /// How the surface moves relative to the body, at the center of mass, world axes.
  [[nodiscard]] Twist surface() const {
    const Twist& own = extra.value().surface_velocity;
    return {motion.pose.rotation * own.linear, motion.pose.rotation * own.angular};
  }

  /// Sets center and twist at the center of mass from the node's motion.
  void follow_motion();
  /// Sets the node's motion from center of mass, rotation and twist.
  void follow_center(const Quat& rotation);
};

/// The arm to a contact after its body turned: the core of the solid turns along, the round skin over it does not.
/// @param skin  from the core to the contact, m
[[nodiscard]] inline Vec3 carried(const Quat& turn, const Vec3& arm, const Vec3& skin) {
  return turn * (arm - skin) + skin;
}

}  // namespace tweenfall::state
