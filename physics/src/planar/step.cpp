#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planar/world_data.h"
#include "step/softness.h"

namespace tweenfall::planar {

using inner::Body;
using inner::Makeup;
using inner::Meeting;

namespace inner {
namespace {

constexpr double countable = 1e30;
/// Impulses of steps in more parts than this, and of those far shorter than the one before, are not kept: the earlier
/// ones are better, unless they are older than this many sub-steps.
constexpr double most_parts = 2, long_enough = 0.15, old_after = 24;

bool is_finite(const Body& body) {
  return std::abs(body.center.x()) <= countable && std::abs(body.center.y()) <= countable &&
         std::abs(body.velocity.x()) <= countable && std::abs(body.velocity.y()) <= countable &&
         std::abs(body.angle) <= countable && std::abs(body.spin) <= countable;
}

}  // namespace
}  // namespace inner

inner::BodyRow World::Implementation::gain_of(const Body& body) const {
  const Vec2 acceleration = settings.gravity + body.inverse_mass * body.force;
  return {.x = acceleration.x(), .y = acceleration.y(), .turn = body.inverse_moment * body.torque};
}

void World::Implementation::damp(std::uint32_t index, double h) {
  const Makeup& makeup = makeups[index];
  solver.damped[index] = {elementary::exp(-makeup.linear_damping * h), elementary::exp(-makeup.angular_damping * h)};
}

/// What each body does by itself: gains, keyed courses, how far it may get.
void World::Implementation::set_out(double dt) {
  moving.clear();
  solver.gains.assign(bodies.size(), {});
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive) continue;
    Makeup& makeup = makeups[i];
    body.under_way = false;
    body.travel = 0;
    double gained = 0;
    if (!body.movable) {
      if (makeup.fixed) continue;
      // The solver uses the mean velocity that takes it to its target.
      body.velocity = Vec2(0, 0);
      body.spin = 0;
      if (body.has_target) {
        const Vec2 end = makeup.target.position + inner::Turn::of(makeup.target.angle) * makeup.mass.center;
        body.velocity = (end - body.center) / dt;
        body.spin = (makeup.target.angle - body.angle) / dt;
      }
      body.under_way = body.velocity != Vec2::Zero() || body.spin != 0;
    } else {
      if (body.asleep && bears_the_same(body)) continue;
      if (body.asleep) wake(i);
      body.under_way = true;
      const inner::BodyRow& gain = solver.gains[i] = gain_of(body);
      gained = (Vec2(gain.x, gain.y).norm() + body.reach * std::abs(gain.turn)) * dt;
      if (body.driven) makeup.saturated = false;
      if (body.driven)
        gained += (makeup.target.position - motion_of(i).position).norm() / dt + makeup.target.velocity.norm();
    }
    if (!body.under_way) continue;
    moving.push_back(i);
    body.travel = (body.velocity.norm() + gained) * dt + std::min(2.0, std::abs(body.spin) * dt) * body.reach;
    // No box can be made of values that are not finite.
    if (!(body.travel <= inner::countable)) body.travel = inner::countable;
  }
}

void World::Implementation::find_meetings(double dt) {
  looked_at.assign(meetings.size(), 0);
  do {
    for (std::size_t k = 0; k < meetings.size(); ++k) {
      Meeting& meeting = meetings[k];
      if (looked_at[k] || meeting.sensing || !(bodies[meeting.a].under_way || bodies[meeting.b].under_way)) continue;
      looked_at[k] = 1;
      look_at(meeting, dt);
    }
  } while (sleepers > 0 && rouse());
}

/// Keyed bodies end exactly where they must, with the path's own velocity.
void World::Implementation::arrive(double dt) {
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive) continue;
    if (body.movable) body.has_target = false;
    if (body.movable && !body.driven) continue;
    Makeup& makeup = makeups[i];
    if (body.driven) {
      // It is still pulled to where it was last told to be.
      makeup.target.velocity = Vec2(0, 0);
      makeup.target.spin = 0;
      continue;
    }
    if (makeup.fixed) continue;
    Motion arrived = makeup.motion;
    if (body.has_target) {
      arrived = makeup.target;
    } else {
      arrived.velocity = Vec2(0, 0);
      arrived.spin = 0;
    }
    place(i, arrived);
  }
  time += dt;
}

void World::Implementation::forget_forces() {
  for (Body& body : bodies) {
    body.force = Vec2(0, 0);
    body.torque = 0;
  }
}

void World::Implementation::check_finite(double dt) {
  for (const std::uint32_t i : moving) {
    if (inner::is_finite(bodies[i])) continue;
    failed = true;
    throw NotFinite(handle(i), time + dt,
                    "a force, an impulse or a joint that is too strong for its mass, or a step that is too long");
  }
}

void World::Implementation::step(double dt, double parts) {
  if (!(dt > 0 && dt <= inner::countable))
    throw std::invalid_argument("the length of a step must be positive and finite, but is " + number_text(dt) + " s");
  if (failed) {
    moving.clear();
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].alive) moving.push_back(i);
    failed = false;
    check_finite(0);
  }
  step_length = dt;
  const bool lets_sleep = !std::isinf(settings.sleep_after);
  if (lets_sleep) note_starts();
  set_out(dt);
  check_finite(dt);
  near.update(bodies, makeups, kept_apart, meetings);
  find_meetings(dt);
  active.clear();
  for (std::uint32_t k = 0; k < meetings.size(); ++k)
    if (looked_at[k] && meetings[k].count > 0) active.push_back(k);
  const inner::Effort effort =
      settings.sub_steps ? inner::Effort{*settings.sub_steps} : depth.effort_for(bodies, meetings, active);
  sub_steps = effort.sub_steps;
  const double h = dt / sub_steps;
  solver.damped.resize(bodies.size());
  for (const std::uint32_t i : moving)
    if (bodies[i].damped && bodies[i].movable) damp(i, h);
  // In shorter steps impulses are smaller.
  const double warmth = last_h > 0 ? std::min(1.0, h / last_h) : 0;
  passed_over += dt;
  const double whole = step::kept_as_whole(parts);
  const bool keeps = last_h == 0 || (parts <= inner::most_parts && h >= inner::long_enough * last_h) ||
                     (passed_over >= inner::old_after * last_h && whole == parts);
  const double kept = keeps ? whole : 0;
  if (keeps) {
    last_h = kept * h;
    passed_over = 0;
  }
  solver.solve({bodies, makeups, meetings, joints, moving, active, settings.push_out_speed, dt, effort.sub_steps,
                effort.relaxes_each, warmth, parts, kept});
  arrive(dt);
  report();
  if (lets_sleep) let_sleep(dt);
  forget_forces();
  check_finite(0);
}

}  // namespace tweenfall::planar
