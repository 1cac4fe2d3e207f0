#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "state/world_data.h"

namespace tweenfall {

namespace step {
namespace {

/// A driven body is never quite still while it nears its target: it counts as still below this part of the usual speed.
constexpr double driven_share = 1e-3;
/// A spring that would bring a body to this part of that speed before it fell asleep keeps it awake.
constexpr double pulling_share = 0.1;
/// A flag for bodies that something pulls and may also turn.
constexpr char turned_too = 2;
/// Displacements below this part of a position are rounding.
constexpr double displacement_rounding = 1e-14;
/// Number of bodies that are worth a task of their own.
constexpr std::size_t worth_sharing_sleep = 128;

/// Whether a body is slow and has hardly moved: a body pushed out of an overlap moves without a speed.
bool still(const state::Body& body, const Start& start, double speed, double dt) {
  if (!(body.twist.linear.norm() < speed && body.twist.angular.norm() * body.radius() < speed)) return false;
  const double turn = 2 * (body.motion.pose.rotation * start.rotation.conjugate()).vec().norm();
  return (body.center - start.center).norm() <= speed * dt + displacement_rounding * body.center.norm() &&
         turn * body.radius() <= speed * dt + displacement_rounding * body.radius();
}

/// How fast a body accelerates, m/s^2 and rad/s^2.
struct Pull {
  double linear, turning;
};

Pull pull_of(const state::Body& body, const forces::Load& load) {
  return {load.acceleration.norm(),
          (body.inverse_inertia() * (body.motion.pose.rotation.conjugate() * load.torque)).norm()};
}

/// The part of the pull that contacts do not hold.
Pull pull_beside_contacts(const state::Body& body, const Start& start, double dt) {
  return {(body.twist.linear - start.twist.linear).norm() / dt, (body.twist.angular - start.twist.angular).norm() / dt};
}

}  // namespace
}  // namespace step

bool World::Implementation::wake_islands() {
  islands.reset(bodies.size());
  flags.assign(bodies.size(), 0);
  carried.assign(bodies.size(), 0);
  const auto each_link_beside_contacts = [&](const auto& visit) {
    for (const std::uint32_t place : retained) visit(memories[place].a, memories[place].b);
    for (const forces::NumberedForce& entry : forces) forces::each_tie(entry, bodies, watched, visit);
    for (const joints::JointLink& link : links)
      if (link.a != joints::JointLink::world) visit(link.a, link.b);
  };
  const auto each_link = [&](const auto& visit) {
    for (const contacts::ContactConstraint* constraint : active) visit(constraint->a, constraint->b);
    each_link_beside_contacts(visit);
  };
  std::atomic<bool> disturbed = false;
  const auto both_move = [&](std::uint32_t a, std::uint32_t b) {
    bool result = true;
    for (const state::Body* body : {&bodies[a], &bodies[b]}) {
      const bool immovable = body->immovable();
      result = result && !immovable;
      if (body->conveys || (immovable && body->stirs())) disturbed.store(true, std::memory_order_relaxed);
    }
    return result;
  };
  active_ends.resize(active.size());
  workers().ranges(active.size(), step::worth_sharing_sleep, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t a = active[k]->a, b = active[k]->b;
      active_ends[k] = {a, both_move(a, b) ? b : a};
    }
  });
  for (const step::ContactEnds& ends : active_ends)
    if (ends.a != ends.b) islands.join(ends.a, ends.b);
  each_link_beside_contacts([&](std::uint32_t a, std::uint32_t b) {
    if (both_move(a, b)) islands.join(a, b);
  });
  if (!sleepers.empty())
    for (const std::uint32_t i : watched)
      if (!bodies[i].immovable() && !bodies[i].asleep) flags[islands.of(i)] = 1;
  const auto disturb = [&](const state::Body& by, std::uint32_t other) {
    // A body on a belt is moving, however slowly.
    if (by.conveys && !bodies[other].immovable()) carried[islands.of(other)] = 1;
    if (!by.immovable() || bodies[other].immovable() || !by.stirs()) return;
    flags[islands.of(other)] = 1;
    if (by.displaces()) carried[islands.of(other)] = 1;
  };
  if (disturbed)
    each_link([&](std::uint32_t a, std::uint32_t b) {
      disturb(bodies[a], b);
      disturb(bodies[b], a);
    });
  bool any = false;
  for (const std::uint32_t i : sleepers) {
    if (!bodies[i].asleep || !flags[islands.of(i)]) continue;
    wake(i);
    any = true;
  }
  return any;
}

void World::Implementation::let_sleep(double dt) {
  // A body that something pulls may start slowly.
  flags.assign(bodies.size(), 0);
  for (const forces::NumberedForce& entry : forces)
    if (!std::holds_alternative<Drag>(entry.force))
      forces::each_acted(entry, bodies, watched, [&](std::uint32_t i) {
        if (flags[i] == 0 || !std::holds_alternative<Spring>(entry.force))
          flags[i] = std::holds_alternative<Spring>(entry.force) ? 1 : step::turned_too;
      });
  std::atomic<bool> all_finite = true, some_drowsy = false;
  workers().ranges(watched.size(), step::worth_sharing_sleep, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = watched[k];
      state::Body& body = bodies[i];
      if (!body.finite()) all_finite.store(false, std::memory_order_relaxed);
      if (body.immovable()) continue;
      if (body.asleep) {
        body.still_for += dt;
        continue;
      }
      const bool driven = body.drive.owner() == Owner::driven;
      const double speed = settings.sleep_speed * (driven ? step::driven_share : 1);
      bool still = !carried[islands.root(i)] && !starts[i].led && step::still(body, starts[i], speed, dt);
      if (still && flags[i]) {
        const step::Pull pull =
            moved[i] ? step::pull_beside_contacts(body, starts[i], dt) : step::pull_of(body, loads[i]);
        const double most = step::pulling_share * speed / settings.sleep_after;
        still = pull.linear < most && (flags[i] != step::turned_too || pull.turning * body.radius() < most);
      }
      body.still_for = still ? body.still_for + dt : 0;
      if (body.still_for >= settings.sleep_after) some_drowsy.store(true, std::memory_order_relaxed);
    }
  });
  failed = !all_finite;
  if (!some_drowsy) return;
  // The shortest stillness in an island counts for all of it.
  stillness.assign(bodies.size(), std::numeric_limits<double>::infinity());
  drowsy.clear();
  for (const std::uint32_t i : watched) {
    const state::Body& body = bodies[i];
    if (body.immovable()) continue;
    double& shortest = stillness[islands.of(i)];
    shortest = std::min(shortest, body.still_for);
    if (!body.asleep && body.still_for >= settings.sleep_after) drowsy.push_back(i);
  }
  for (const std::uint32_t i : drowsy) {
    state::Body& body = bodies[i];
    if (!(stillness[islands.of(i)] >= settings.sleep_after)) continue;
    body.asleep = true;
    body.twist = {};
    body.motion.twist = {};
  }
}

}  // namespace tweenfall
