#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "planar/world_data.h"

namespace tweenfall::planar {

namespace inner {
namespace {

/// A pull that would bring a body to this part of the sleep speed before it fell asleep keeps it awake.
constexpr double pulling_share = 0.1;

}  // namespace
}  // namespace inner

using inner::Body;
using inner::Joint;
using inner::Meeting;

std::uint32_t World::Implementation::root_of(std::uint32_t index) {
  while (root[index] != index) index = root[index] = root[root[index]];
  return index;
}

/// Joins movable bodies that touch or are jointed.
void World::Implementation::join_islands() {
  root.resize(bodies.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto join = [this](std::uint32_t a, std::uint32_t b) {
    if (!bodies[a].movable || !bodies[b].movable) return;
    const std::uint32_t one = root_of(a), other = root_of(b);
    root[std::max(one, other)] = std::min(one, other);
  };
  for (const Meeting& meeting : meetings)
    if (meeting.count > 0 && !meeting.sensing) join(meeting.a, meeting.b);
  for (const Joint& joint : joints)
    if (joint.alive && joint.settings.a != BodyId{} && joint.settings.b != BodyId{})
      join(joint.settings.a.index, joint.settings.b.index);
}

/// Wakes the islands that something under way touches. @return whether there were any
bool World::Implementation::rouse() {
  join_islands();
  std::vector<char> stirred(bodies.size(), 0);
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].alive && bodies[i].movable && !bodies[i].asleep) stirred[root_of(i)] = 1;
  const auto stir = [&](std::uint32_t by, std::uint32_t other) {
    if (!bodies[by].movable && bodies[by].under_way && bodies[other].movable) stirred[root_of(other)] = 1;
  };
  for (const Meeting& meeting : meetings) {
    if (meeting.count == 0 || meeting.sensing) continue;
    stir(meeting.a, meeting.b);
    stir(meeting.b, meeting.a);
  }
  for (const Joint& joint : joints) {
    if (!joint.alive || joint.settings.a == BodyId{} || joint.settings.b == BodyId{}) continue;
    stir(joint.settings.a.index, joint.settings.b.index);
    stir(joint.settings.b.index, joint.settings.a.index);
  }
  bool any = false;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive || !body.asleep || !stirred[root_of(i)]) continue;
    wake(i);
    any = true;
    body.under_way = true;
    const inner::BodyRow& gain = solver.gains[i] = gain_of(body);
    body.travel = (Vec2(gain.x, gain.y).norm() + body.reach * std::abs(gain.turn)) * step_length * step_length;
    moving.push_back(i);
  }
  return any;
}

/// A change of the pull matters by the speed that it would give a body before it fell asleep again.
bool World::Implementation::bears_the_same(const Body& body) const {
  if (body.force == body.borne && body.torque == body.borne_torque) return true;
  const double change = body.inverse_mass * (body.force - body.borne).norm() +
                        body.inverse_moment * std::abs(body.torque - body.borne_torque) * body.reach;
  return change * settings.sleep_after < inner::pulling_share * settings.sleep_speed;
}

/// A body that starts to move under a pull is slow at first, but not at rest.
void World::Implementation::hold_in_the_air() {
  held.assign(bodies.size(), 0);
  for (const Meeting& meeting : meetings)
    if (meeting.count > 0 && !meeting.sensing) held[meeting.a] = held[meeting.b] = 1;
  for (const Joint& joint : joints)
    for (const BodyId& end : {joint.settings.a, joint.settings.b})
      if (joint.alive && end != BodyId{}) held[end.index] = 1;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive || !body.movable || body.driven || body.asleep || held[i]) continue;
    if (body.force == Vec2::Zero() && body.torque == 0) continue;
    const inner::BodyRow gain = gain_of(body);
    const double pull = Vec2(gain.x, gain.y).norm() + std::abs(gain.turn) * body.reach;
    if (!(pull * settings.sleep_after < inner::pulling_share * settings.sleep_speed)) body.still_for = 0;
  }
}

void World::Implementation::note_starts() {
  starts.resize(bodies.size());
  start_angles.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    starts[i] = bodies[i].center;
    start_angles[i] = bodies[i].angle;
  }
}

void World::Implementation::let_sleep(double dt) {
  bool pulled = false;
  bool drowsy = false;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive || !body.movable) continue;
    if (body.asleep) {
      body.still_for += dt;
      continue;
    }
    const double speed = settings.sleep_speed, way = speed * dt + 1e-14 * body.center.norm();
    // Removing overlap moves bodies without a speed. A driven body is never quite still while it nears its target.
    const bool still = body.velocity.norm() < speed * (body.driven ? 1e-3 : 1) &&
                       std::abs(body.spin) * body.reach < speed && (body.center - starts[i]).norm() <= way &&
                       std::abs(body.angle - start_angles[i]) * body.reach <= speed * dt + 1e-14 * body.reach;
    body.still_for = still ? body.still_for + dt : 0;
    pulled = pulled || body.force != Vec2::Zero() || body.torque != 0;
    drowsy = drowsy || body.still_for >= settings.sleep_after;
  }
  if (!drowsy) return;
  if (pulled) hold_in_the_air();
  join_islands();
  stillness.assign(bodies.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].alive && bodies[i].movable) {
      double& least = stillness[root_of(i)];
      least = std::min(least, bodies[i].still_for);
    }
  // A body that moves by its own will keeps awake those that it touches.
  for (const Meeting& meeting : meetings) {
    if (meeting.count == 0 || meeting.sensing) continue;
    for (const auto& [by, other] : {std::pair(meeting.a, meeting.b), std::pair(meeting.b, meeting.a)})
      if (!bodies[by].movable && bodies[by].under_way && bodies[other].movable) stillness[root_of(other)] = 0;
  }
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive || !body.movable || body.asleep || !(stillness[root_of(i)] >= settings.sleep_after)) continue;
    body.asleep = true;
    body.borne = body.force;
    body.borne_torque = body.torque;
    ++sleepers;
    body.velocity = Vec2(0, 0);
    body.spin = 0;
    body.under_way = false;
  }
}

}  // namespace tweenfall::planar
