#pragma once

/// The fields of everything in a world in a plane, each listed once, so that what is hashed, saved and loaded is the
/// same. A field that is added and not listed here does not compile. Fields shared with space are in
/// saving/fields.h.

#include "planar/body.h"
#include "saving/fields.h"

namespace tweenfall::planar::inner {

using saving::Is;

template <Is<Circle> T, class Visit>
void each_field(T& circle, const Visit& visit) {
  auto& [radius] = circle;
  visit(radius);
}
template <Is<Capsule> T, class Visit>
void each_field(T& capsule, const Visit& visit) {
  auto& [radius, half_height] = capsule;
  visit(radius, half_height);
}
template <Is<Box> T, class Visit>
void each_field(T& box, const Visit& visit) {
  auto& [half_extents] = box;
  visit(half_extents);
}
template <Is<Polygon> T, class Visit>
void each_field(T& polygon, const Visit& visit) {
  auto& [corners] = polygon;
  visit(corners);
}
template <Is<HalfPlane> T, class Visit>
void each_field(T& half, const Visit& visit) {
  auto& [normal, offset] = half;
  visit(normal, offset);
}
template <Is<Part> T, class Visit>
void each_field(T& part, const Visit& visit) {
  auto& [outline, offset, angle] = part;
  visit(outline, offset, angle);
}
template <Is<Compound> T, class Visit>
void each_field(T& compound, const Visit& visit) {
  auto& [parts] = compound;
  visit(parts);
}
template <Is<Shape> T, class Visit>
void each_field(T& shape, const Visit& visit) {
  auto& [outline, offset, angle] = shape;
  visit(outline, offset, angle);
}
template <Is<MassProperties> T, class Visit>
void each_field(T& mass, const Visit& visit) {
  auto& [kilograms, center, moment] = mass;
  visit(kilograms, center, moment);
}
template <Is<Motion> T, class Visit>
void each_field(T& motion, const Visit& visit) {
  auto& [position, angle, velocity, spin] = motion;
  visit(position, angle, velocity, spin);
}
template <Is<WorldSettings> T, class Visit>
void each_field(T& settings, const Visit& visit) {
  auto& [gravity, sub_steps, sleep_speed, sleep_after, push_out_speed] = settings;
  visit(gravity, sub_steps, sleep_speed, sleep_after, push_out_speed);
}
template <Is<Turn> T, class Visit>
void each_field(T& turn, const Visit& visit) {
  auto& [cos, sin] = turn;
  visit(cos, sin);
}

template <Is<Body> T, class Visit>
void each_field(T& body, const Visit& visit) {
  auto& [center, angle, turn, velocity, spin, inverse_mass, inverse_moment, reach, skin, least, travel, force, torque,
         borne, borne_torque, still_for, boxed_center, boxed_angle, boxed_room, boxed, has_target, alive, asleep,
         movable, lone, compound, driven, damped, under_way] = body;
  visit(center, angle, velocity, spin, force, torque, borne, borne_torque, still_for, boxed_center, boxed_angle,
        boxed_room, boxed, has_target, alive, asleep);
  saving::follows_from_others(turn, inverse_mass, inverse_moment, reach, skin, least, travel, movable, lone, compound,
                              driven, damped, under_way);
}
template <Is<Makeup> T, class Visit>
void each_field(T& makeup, const Visit& visit) {
  auto& [generation, shape, plates, mass, friction, restitution, rolling_friction, friction_combine,
         restitution_combine, linear_damping, angular_damping, fixed, sensor, saturated, groups, collides_with, drive,
         motion, target, reaction] = makeup;
  visit(generation, shape, mass, friction, restitution, rolling_friction, friction_combine, restitution_combine,
        linear_damping, angular_damping, fixed, sensor, saturated, groups, collides_with, drive, motion, target,
        reaction);
  saving::follows_from_others(plates);
}
template <Is<Meeting> T, class Visit>
void each_field(T& meeting, const Visit& visit) {
  auto& [a, b, part_a, part_b, friction, restitution, rolling_friction, sensing, touching, count, exact, clear, apart,
         relative, normal, core_a, core_b, feature, pressing, dragging, rolling] = meeting;
  visit(a, b, part_a, part_b, friction, restitution, rolling_friction, sensing, touching, count, exact, clear, apart,
        relative, normal, core_a, core_b, feature, pressing, dragging, rolling);
}
template <Is<Hinge> T, class Visit>
void each_field(T& hinge, const Visit& visit) {
  auto& [limits, motor] = hinge;
  visit(limits, motor);
}
template <Is<Slider> T, class Visit>
void each_field(T& slider, const Visit& visit) {
  auto& [axis, angle, limits, motor] = slider;
  visit(axis, angle, limits, motor);
}
template <Is<Weld> T, class Visit>
void each_field(T& weld, const Visit& visit) {
  auto& [angle] = weld;
  visit(angle);
}
template <Is<Distance> T, class Visit>
void each_field(T& distance, const Visit& visit) {
  auto& [limits] = distance;
  visit(limits);
}
template <Is<Spring> T, class Visit>
void each_field(T& spring, const Visit& visit) {
  auto& [length, stiffness, damping] = spring;
  visit(length, stiffness, damping);
}
template <Is<Pulley> T, class Visit>
void each_field(T& pulley, const Visit& visit) {
  auto& [pulley_a, pulley_b, ratio, length] = pulley;
  visit(pulley_a, pulley_b, ratio, length);
}
template <Is<Gear> T, class Visit>
void each_field(T& gear, const Visit& visit) {
  auto& [ratio, turned_a, turned_b] = gear;
  visit(ratio, turned_a, turned_b);
}
template <Is<Wheel> T, class Visit>
void each_field(T& wheel, const Visit& visit) {
  auto& [axis, hz, zeta, suspension, motor] = wheel;
  visit(axis, hz, zeta, suspension, motor);
}
template <Is<JointSettings> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [a, b, anchor_a, anchor_b, kind, collide] = joint;
  visit(a, b, anchor_a, anchor_b, kind, collide);
}
template <Is<Joint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [alive, generation, settings, held, motor, lower, upper, spring, turned_a, turned_b, total, total_turn] = joint;
  visit(alive, generation, settings, held, motor, lower, upper, spring, turned_a, turned_b, total, total_turn);
}
template <Is<ContactPoint> T, class Visit>
void each_field(T& point, const Visit& visit) {
  auto& [position, penetration, feature] = point;
  visit(position, penetration, feature);
}
template <Is<Manifold> T, class Visit>
void each_field(T& manifold, const Visit& visit) {
  auto& [normal, points, count] = manifold;
  visit(normal, points, count);
}
template <Is<Contact> T, class Visit>
void each_field(T& contact, const Visit& visit) {
  auto& [a, b, manifold, impulse, total_impulse, approach_speed, began, part_a, part_b] = contact;
  visit(a, b, manifold, impulse, total_impulse, approach_speed, began, part_a, part_b);
}

}  // namespace tweenfall::planar::inner
