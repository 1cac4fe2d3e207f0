#pragma once

// The fields of what a stage is described by, each listed once, as those of a world in `saving/fields.h`.

#include "saving/bytes.h"
#include "stage/stage_data.h"

namespace tweenfall::saving {

template <>
inline constexpr int last_of<Cause> = static_cast<int>(Cause::caller);
template <>
inline constexpr int last_of<Owner> = static_cast<int>(Owner::free);
template <>
inline constexpr int last_of<TakeOver::Velocity> = static_cast<int>(TakeOver::Velocity::average);
template <>
inline constexpr int last_of<TakeOver::Overlap> = static_cast<int>(TakeOver::Overlap::veto);
template <>
inline constexpr int last_of<Settle::Kind> = static_cast<int>(Settle::Kind::dead_blend);
template <>
inline constexpr int last_of<HandBack::Clock> = static_cast<int>(HandBack::Clock::restart);
template <>
inline constexpr int last_of<HandBack::Anchor> = static_cast<int>(HandBack::Anchor::ground);
template <>
inline constexpr int last_of<Combine> = static_cast<int>(Combine::maximum);

// Rules

template <Is<when::At> T, class Visit>
void each_field(T& at, const Visit& visit) {
  auto& [time] = at;
  visit(time);
}

template <class T, class Visit>
requires Is<T, when::Marker> || Is<T, when::Event>
void each_field(T& named, const Visit& visit) {
  auto& [name] = named;
  visit(name);
}

template <class T, class Visit>
requires Is<T, when::ClipEnd> || Is<T, when::SpeedPeak>
void each_field(T&, const Visit&) {}

template <Is<when::ContactHit> T, class Visit>
void each_field(T& hit, const Visit& visit) {
  auto& [impulse, speed, with] = hit;
  visit(impulse, speed, with);
}

template <Is<when::Asleep> T, class Visit>
void each_field(T& asleep, const Visit& visit) {
  auto& [seconds] = asleep;
  visit(seconds);
}

template <class T, class Visit>
requires Is<T, when::Enter> || Is<T, when::Leave>
void each_field(T& trigger, const Visit& visit) {
  auto& [region, who] = trigger;
  visit(region, who);
}

template <class T, class Visit>
requires Is<T, when::Saturated> || Is<T, when::Error>
void each_field(T& trigger, const Visit& visit) {
  auto& [amount] = trigger;
  visit(amount);
}

template <Is<When> T, class Visit>
void each_field(T& when, const Visit& visit) {
  auto& [triggers, all] = when;
  visit(triggers, all);
}

template <Is<TakeOver> T, class Visit>
void each_field(T& take_over, const Visit& visit) {
  auto& [velocity, average_over, scale, add, overlap, rewind_within] = take_over;
  visit(velocity, average_over, scale, add, overlap, rewind_within);
}

template <Is<Settle> T, class Visit>
void each_field(T& settle, const Visit& visit) {
  auto& [kind, seconds] = settle;
  visit(kind, seconds);
}

template <Is<HandBack> T, class Visit>
void each_field(T& hand_back, const Visit& visit) {
  auto& [clip, clock, anchor, settle] = hand_back;
  visit(clip, clock, anchor, settle);
}

template <Is<OwnerChange> T, class Visit>
void each_field(T& change, const Visit& visit) {
  auto& [to, take_over, hand_back, ramp] = change;
  visit(to, take_over, hand_back, ramp);
}

template <Is<NextChange> T, class Visit>
void each_field(T& next, const Visit& visit) {
  auto& [after, change] = next;
  visit(after, change);
}

template <Is<Rule> T, class Visit>
void each_field(T& rule, const Visit& visit) {
  auto& [bodies, when, to, take_over, hand_back, once, ramp, then] = rule;
  visit(bodies, when, to, take_over, hand_back, once, ramp, then);
}

// What a stage is described by

template <Is<BodyDescription> T, class Visit>
void each_field(T& body, const Visit& visit) {
  auto& [shape, mass, density, mass_properties, friction, restitution, friction_combine, restitution_combine,
         rolling_friction, spinning_friction, surface_velocity, sensor, collision, groups, collides_with,
         linear_damping, angular_damping, fixed, drive, twist] = body;
  visit(shape, mass, density, mass_properties, friction, restitution, friction_combine, restitution_combine,
        rolling_friction, spinning_friction, surface_velocity, sensor, collision, groups, collides_with, linear_damping,
        angular_damping, fixed, drive, twist);
}

template <Is<NodeDescription> T, class Visit>
void each_field(T& node, const Visit& visit) {
  auto& [name, parent, rest, body, group, color] = node;
  visit(name);
  visit.places(parent);
  visit(rest, body, group, color);
}

template <Is<JointDescription> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [name, a, b, frame_a, frame_b, kind, break_force, break_torque, collide, until] = joint;
  visit(name);
  visit.places(a, b);
  visit(frame_a, frame_b, kind, break_force, break_torque, collide, until);
}

template <Is<SoftPinDescription> T, class Visit>
void each_field(T& pin, const Visit& visit) {
  auto& [node, to, point, until] = pin;
  visit(node, point, until);
  visit.places(to);
}

template <Is<SoftDescription> T, class Visit>
void each_field(T& described, const Visit& visit) {
  auto& [name, soft, pins, color] = described;
  visit(name, soft, pins);
  leads_to_nothing(color);
}

template <Is<WheelSettings> T, class Visit>
void each_field(T& wheel, const Visit& visit) {
  auto& [mount, radius, rest_length, stiffness, damping, moment, grip, side_grip, sharpness] = wheel;
  visit(mount, radius, rest_length, stiffness, damping, moment, grip, side_grip, sharpness);
}

template <Is<WheelDescription> T, class Visit>
void each_field(T& described, const Visit& visit) {
  auto& [name, wheel, torque, brake, lock] = described;
  visit(name, wheel, torque, brake, lock);
}

template <Is<VehicleDescription> T, class Visit>
void each_field(T& vehicle, const Visit& visit) {
  auto& [name, chassis, forward, up, wheels, throttle, brake, steer] = vehicle;
  visit(name);
  visit.places(chassis);
  visit(forward, up, wheels, throttle, brake, steer);
}

template <Is<ParticleSettings> T, class Visit>
void each_field(T& settings, const Visit& visit) {
  auto& [gravity, integrator, mass, radius, restitution, friction, life, life_spread, most, seed] = settings;
  visit(gravity, integrator, mass, radius, restitution, friction, life, life_spread, seed);
  visit.places(most);
}

}  // namespace tweenfall::saving
