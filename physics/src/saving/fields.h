#pragma once

/// The fields of everything in a world's state, each listed once, so that what is hashed, saved and loaded is the same.
/// A field that is added and not listed here does not compile.

#include <cstdint>

#include "saving/force_fields.h"
#include "state/blank.h"
#include "state/world_state.h"

namespace tweenfall::saving {

using state::Body;
using state::ContactMemory;
using state::Extra;
using state::IgnoredPairs;
using state::Joint;
using state::Makeup;
using state::MoreOfContact;
using state::PointMemory;
using state::RareOfContact;
using state::Stand;
using state::WholeContact;
using state::WorldState;

/// Names fields that follow from others.
inline void follows_from_others(const auto&...) {}
/// Names fields on which no later bit depends.
inline void leads_to_nothing(const auto&...) {}

// each_field(value, visit): calls `visit(field, field, ...)`, perhaps several times, with all of them in a fixed order.

template <Is<Pose> T, class Visit>
void each_field(T& pose, const Visit& visit) {
  auto& [position, rotation, scale] = pose;
  visit(position, rotation, scale);
}

template <Is<Twist> T, class Visit>
void each_field(T& twist, const Visit& visit) {
  auto& [linear, angular] = twist;
  visit(linear, angular);
}

template <Is<Motion> T, class Visit>
void each_field(T& motion, const Visit& visit) {
  auto& [pose, twist, scale_rate] = motion;
  visit(pose, twist, scale_rate);
}

template <Is<Drive> T, class Visit>
void each_field(T& drive, const Visit& visit) {
  auto& [hz, zeta, max_force, max_torque, gravity_compensation, frame] = drive;
  visit(hz, zeta, max_force, max_torque, gravity_compensation, frame);
}

template <Is<BodyId> T, class Visit>
void each_field(T& id, const Visit& visit) {
  auto& [index, generation] = id;
  visit(index, generation);
}

template <Is<Sphere> T, class Visit>
void each_field(T& sphere, const Visit& visit) {
  auto& [radius] = sphere;
  visit(radius);
}

template <Is<Box> T, class Visit>
void each_field(T& box, const Visit& visit) {
  auto& [half_extents] = box;
  visit(half_extents);
}

template <Is<Capsule> T, class Visit>
void each_field(T& capsule, const Visit& visit) {
  auto& [radius, half_height] = capsule;
  visit(radius, half_height);
}

template <Is<Plane> T, class Visit>
void each_field(T& plane, const Visit& visit) {
  auto& [normal, offset] = plane;
  visit(normal, offset);
}

template <Is<Hull> T, class Visit>
void each_field(T& hull, const Visit& visit) {
  auto& [convex] = hull;
  visit(convex);
}

template <Is<Cylinder> T, class Visit>
void each_field(T& cylinder, const Visit& visit) {
  auto& [radius, half_height] = cylinder;
  visit(radius, half_height);
}

template <Is<Cone> T, class Visit>
void each_field(T& cone, const Visit& visit) {
  auto& [radius, half_height] = cone;
  visit(radius, half_height);
}

template <Is<TaperedCapsule> T, class Visit>
void each_field(T& capsule, const Visit& visit) {
  auto& [bottom_radius, top_radius, half_height] = capsule;
  visit(bottom_radius, top_radius, half_height);
}

template <Is<Shape> T, class Visit>
void each_field(T& shape, const Visit& visit) {
  auto& [solid, offset] = shape;
  visit(solid, offset);
}

template <Is<MassProperties> T, class Visit>
void each_field(T& properties, const Visit& visit) {
  auto& [mass, center, inertia] = properties;
  visit(mass, center, inertia);
}

template <Is<Makeup> T, class Visit>
void each_field(T& makeup, const Visit& visit) {
  auto& [shape, mass, inverse_inertia, radius, roundness, linear_damping, angular_damping, friction, restitution,
         rolling_friction, spinning_friction, friction_combine, restitution_combine, collision, sensor, weighed,
         spherical, aligned, slender, turned] = makeup;
  visit(linear_damping, angular_damping, mass.mass, friction, restitution, rolling_friction, spinning_friction,
        friction_combine, restitution_combine, sensor, shape);
  visit.rarely(collision);
  visit.rarely(weighed);
  if (weighed) visit(mass.center, mass.inertia);  // otherwise they follow from the shape
  follows_from_others(inverse_inertia, radius, roundness, spherical, aligned, slender, turned);
}

template <Is<Extra> T, class Visit>
void each_field(T& extra, const Visit& visit) {
  auto& [target, reaction, surface_velocity] = extra;
  visit(target, reaction, surface_velocity);
}

template <Is<Body> T, class Visit>
void each_field(T& body, const Visit& visit) {
  auto& [alive, fixed, asleep, placed, has_target, led, saturated, squeezed, conveys, mirrored, generation, drive,
         still_for, center, twist, motion, work, filter, makeup, extra] = body;
  visit(alive, generation);
  if (!alive) return;  // only its index and generation matter
  visit(fixed, asleep, placed, has_target, led, drive, still_for, center, twist, motion);
  state::Work applied = work.value();
  visit(applied.force, applied.torque);
  visit.rarely(applied.across[0], applied.across[1], applied.across[2]);
  if constexpr (!std::is_const_v<T>)
    if (!state::blank(applied.force) || !state::blank(applied.torque) || !state::blank(applied.across))
      work.own() = applied;
  state::Filter its = filter.value();
  visit(its.groups, its.collides_with);
  if constexpr (!std::is_const_v<T>) body.set_filter(its);
  visit(makeup, extra);
  visit.rarely(saturated);
  visit.rarely(squeezed);
  follows_from_others(conveys, mirrored);
}

template <Is<PointMemory> T, class Visit>
void each_field(T& point, const Visit& visit) {
  auto& [position, penetration, kept_normal, kept_friction] = point;
  visit(position, penetration, kept_normal, kept_friction);
}

template <Is<Stand> T, class Visit>
void each_field(T& stand, const Visit& visit) {
  auto& [center, rotation] = stand;
  visit(center, rotation);
}

/// The number of points limited to the size of their array, whatever the count says.
[[nodiscard]] constexpr std::size_t within_four(int count) {
  return static_cast<std::size_t>(count < 0 ? 0 : count > 4 ? 4 : count);
}

template <Is<WholeContact> T, class Visit>
void each_field(T& contact, const Visit& visit) {
  auto& [memory, of_more, of_rare] = contact;
  auto& [a, b, feature, more, rare, count, marks, kept_step, normal, impulse, approach, total_impulse, first] = memory;
  auto& [points, features, kept_twist, stand_a, stand_b] = of_more;
  auto& [part_a, part_b, has_arms, kept_spin, passed_over, kept_rolling, arms_b] = of_rare;
  visit.rarely(part_a, part_b);
  visit(a, b, count, marks, kept_step, normal, impulse, approach, total_impulse);
  if (count > 0) visit(feature, first);
  for (std::size_t i = 1; i < within_four(count); ++i) visit(features[i - 1], points[i - 1]);
  visit(kept_twist, kept_spin, passed_over, kept_rolling, has_arms);
  if (memory.is(ContactMemory::holds)) visit(stand_a, stand_b);
  for (std::size_t i = 0; has_arms && i < within_four(count); ++i) visit(arms_b[i]);
  follows_from_others(more, rare);
}

template <Is<Limits> T, class Visit>
void each_field(T& limits, const Visit& visit) {
  auto& [low, high, hz, zeta] = limits;
  visit(low, high, hz, zeta);
}

template <Is<Motor> T, class Visit>
void each_field(T& motor, const Visit& visit) {
  auto& [speed, position, hz, zeta, max_force] = motor;
  visit(speed, position, hz, zeta, max_force);
}

template <class T, class Visit>
requires Is<T, BallJoint> || Is<T, FixedJoint>
void each_field(T&, const Visit&) {}

template <class T, class Visit>
requires Is<T, HingeJoint> || Is<T, SliderJoint>
void each_field(T& joint, const Visit& visit) {
  auto& [limits, motor] = joint;
  visit(limits, motor);
}

template <Is<DistanceJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [limits] = joint;
  visit(limits);
}

template <Is<UniversalJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [first_limits, second_limits, first_motor, second_motor] = joint;
  visit(first_limits, second_limits, first_motor, second_motor);
}

template <Is<SwingTwistJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [swing_y, swing_z, twist, toward, hz, zeta, max_torque] = joint;
  visit(swing_y, swing_z, twist, toward, hz, zeta, max_torque);
}

template <Is<WheelJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [hz, zeta, suspension, motor] = joint;
  visit(hz, zeta, suspension, motor);
}

template <Is<PulleyJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [pulley_a, pulley_b, ratio, length] = joint;
  visit(pulley_a, pulley_b, ratio, length);
}

template <Is<GearJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [ratio] = joint;
  visit(ratio);
}

template <Is<SpringJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [length, stiffness, damping] = joint;
  visit(length, stiffness, damping);
}

template <Is<JointId> T, class Visit>
void each_field(T& id, const Visit& visit) {
  auto& [index, generation] = id;
  visit(index, generation);
}

template <Is<JointSettings> T, class Visit>
void each_field(T& settings, const Visit& visit) {
  auto& [a, b, frame_a, frame_b, kind, break_force, break_torque, collide] = settings;
  visit(a, b, frame_a, frame_b, kind, break_force, break_torque, collide);
}

template <Is<Joint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [alive, generation, settings, kept, kept_step, passed_over, angles, side, force, torque] = joint;
  visit(alive, generation);
  if (!alive) return;
  visit(settings, kept, kept_step, passed_over, angles, side, force, torque);
}

template <Is<IgnoredPairs::Entry> T, class Visit>
void each_field(T& pair, const Visit& visit) {
  auto& [a, b, holders, asked] = pair;
  visit(a, b, holders, asked);
}

template <Is<ContactPoint> T, class Visit>
void each_field(T& point, const Visit& visit) {
  auto& [position, penetration, feature] = point;
  visit(position, penetration, feature);
}

template <Is<Manifold> T, class Visit>
void each_field(T& manifold, const Visit& visit) {
  auto& [normal, points, count] = manifold;
  visit(normal, count);
  for (std::size_t i = 0; i < within_four(count); ++i) visit(points[i]);
}

template <Is<Contact> T, class Visit>
void each_field(T& contact, const Visit& visit) {
  auto& [a, b, manifold, impulse, total_impulse, approach_speed, began, part_a, part_b] = contact;
  visit.rarely(part_a, part_b);
  visit(a, b, manifold, impulse, total_impulse, approach_speed, began);
}

template <Is<EndedContact> T, class Visit>
void each_field(T& ended, const Visit& visit) {
  auto& [a, b] = ended;
  visit(a, b);
}

template <Is<SensorOverlap> T, class Visit>
void each_field(T& overlap, const Visit& visit) {
  auto& [sensor, body, began] = overlap;
  visit(sensor, body, began);
}

template <Is<SoftId> T, class Visit>
void each_field(T& id, const Visit& visit) {
  auto& [index, generation] = id;
  visit(index, generation);
}

template <Is<SoftEdge> T, class Visit>
void each_field(T& edge, const Visit& visit) {
  auto& [a, b, length, stiffness, damping, tear] = edge;
  visit(a, b, length, stiffness, damping, tear);
}

template <Is<SoftBend> T, class Visit>
void each_field(T& bend, const Visit& visit) {
  auto& [nodes, weights, stiffness] = bend;
  visit(nodes, weights, stiffness);
}

template <Is<SoftTetrahedron> T, class Visit>
void each_field(T& solid, const Visit& visit) {
  auto& [nodes, stiffness, volume] = solid;
  visit(nodes, stiffness, volume);
}

template <Is<SoftEnclosure> T, class Visit>
void each_field(T& enclosure, const Visit& visit) {
  auto& [triangles, stiffness, volume] = enclosure;
  visit(triangles, stiffness, volume);
}

template <Is<SoftPin> T, class Visit>
void each_field(T& pin, const Visit& visit) {
  auto& [node, body, point, in_place] = pin;
  visit(node, body, point, in_place);
}

template <Is<SoftSettings> T, class Visit>
void each_field(T& settings, const Visit& visit) {
  auto& [positions, velocities, masses, edges, bends, tetrahedra, enclosures, triangles, pins, solver, sub_step,
         iterations, radius, friction, linear_damping, collide, groups, collides_with, thickness, air_drag] = settings;
  visit(positions, velocities, masses, edges, bends, tetrahedra, enclosures, triangles, pins, solver, sub_step,
        iterations, radius, friction, linear_damping, collide, groups, collides_with);
  visit.rarely(thickness, air_drag);
}

template <Is<soft::PinState> T, class Visit>
void each_field(T& state, const Visit& visit) {
  auto& [pin, target, velocity, force] = state;
  visit(pin, target, velocity, force);
}

template <Is<soft::SoftBody> T, class Visit>
void each_field(T& body, const Visit& visit) {
  auto& [alive, generation, made, positions, velocities, torn, pins, pace, gone, tears] = body;
  visit(alive, generation);
  if (!alive) return;
  visit(made, positions, velocities, torn, pins, pace);
  follows_from_others(gone);
  leads_to_nothing(tears);
}

template <Is<WorldSettings> T, class Visit>
void each_field(T& settings, const Visit& visit) {
  auto& [gravity, integrator, iterations, sleep_speed, sleep_after, push_out_speed, solver, separation, collision,
         broad_phase, plane, threads] = settings;
  visit(gravity, integrator, iterations, sleep_speed, sleep_after, push_out_speed);
  visit.rarely(solver, separation, collision, broad_phase);
  visit.rarely(plane);
  leads_to_nothing(threads);
}

template <Is<WorldState> T, class Visit>
void each_field(T& world, const Visit& visit) {
  auto& [settings, bodies, unused, forces, next_force, time, failed, memories, stands, ignored, joints, unused_joints,
         broken, planar_contacts, ended, gone_contacts, sensors, overlaps, left_sensors, other_detections, softs,
         unused_softs, flat] = world;
  visit(settings, bodies, unused, forces, next_force, time, memories, stands, ignored, joints, unused_joints, broken,
        planar_contacts, ended, gone_contacts, overlaps, left_sensors);
  bool has_softs = !softs.empty();
  visit.rarely(has_softs);
  if (has_softs) visit(softs, unused_softs);
  follows_from_others(sensors, other_detections);
  follows_from_others(flat);    // saved after everything else, if there is a plane
  follows_from_others(failed);  // a body that is not finite cannot be saved, and is found again
}

}  // namespace tweenfall::saving
