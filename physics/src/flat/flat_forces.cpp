#include <algorithm>

#include "flat/axes.h"
#include "flat/flat.h"
#include "state/world_data.h"

namespace tweenfall {

namespace flat {
namespace {

/// One end of a spring that is too stiff to be taken as it is at the start of a step.
struct StiffEnd {
  Vec3 place, velocity, arm;
  double give = 0;  ///< inverse mass of its point along the spring, 1/kg
};

StiffEnd end_of(const state::Body& body, const Vec3& local) {
  StiffEnd end;
  end.arm = body.motion.pose.rotation * local;
  end.place = body.center + end.arm;
  end.velocity = velocity_at(body.twist, end.arm);
  return end;
}

void find_give(const state::Body& body, const Vec3& along, StiffEnd& end) {
  if (body.immovable() || body.asleep) return;
  const Vec3 lever = end.arm.cross(along);
  end.give = 1 / body.mass().mass + lever.dot(body.world_inverse_inertia(body.motion.pose.rotation) * lever);
}

}  // namespace

void Flat::begin_pushes(const state::WorldState& world) {
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i)
    if (!world.bodies[i].asleep) {
      entries_[i].force = Vec2(0, 0);
      entries_[i].torque = 0;
    }
}

void Flat::push(std::uint32_t index, const Vec3& force, const Vec3& torque, const Vec3& arm) {
  const Axes axes = Axes::of(plane_);
  entries_[index].force += axes.flat(force);
  entries_[index].torque += axes.sign * (torque + arm.cross(force))[axes.normal];
}

void Flat::exert(const state::WorldState& world) {
  const Axes axes = Axes::of(plane_);
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
    const Entry& entry = entries_[i];
    if (!world.bodies[i].alive || world.bodies[i].immovable()) continue;
    if (entry.force != Vec2::Zero()) world_.apply_force(entry.id, entry.force, axes.flat(world.bodies[i].center));
    if (entry.torque != 0) world_.apply_torque(entry.id, entry.torque);
  }
}

}  // namespace flat

/// Applies forces to bodies of a plane, constant through the step: the mean of their values at its start and where
/// bodies would be at its end. Resistance, and springs too stiff for the step, are taken as at its end, so that nothing
/// makes them grow; the plane bears what points out of it.
void World::Implementation::push_in_plane(double dt) {
  flat::Flat& plane = flat.own();
  plane.begin_pushes(*this);
  if (forces.empty()) {
    loads.assign(bodies.size(), {});
    return;
  }
  forces::gather_loads(bodies, watched, forces, settings, time, dt, workers(), loads, stiff_springs, flight);
  check_loads(time + dt);
  for (const std::uint32_t i : watched) {
    const state::Body& body = bodies[i];
    if (body.immovable() || body.asleep) continue;
    const forces::Load& load = loads[i];
    const double mass = body.mass().mass, drag = load.drag - body.makeup->linear_damping;
    const Vec3 own = settings.gravity + body.steady_force(settings.gravity) / mass;
    const Vec3 steady = 0.5 * (load.acceleration + load.end_acceleration);
    const Vec3 gain = (steady - drag * body.twist.linear) / (1 + drag * dt) - own;
    const Mat3 inverse = body.world_inverse_inertia(body.motion.pose.rotation);
    const Vec3 spin = body.twist.angular;
    const double heavy = spin.squaredNorm() > 0 ? spin.dot(inverse * spin) / spin.squaredNorm() : 0;
    const Vec3 torque = load.torque - body.torque() - load.angular_drag / (1 + load.angular_drag * dt * heavy) * spin;
    plane.push(i, mass * gain, torque, Vec3(0, 0, 0));
  }
  for (const step::SpringRow& row : stiff_springs) {
    const bool to_world = row.b == step::SpringRow::world;
    flat::StiffEnd a = flat::end_of(bodies[row.a], row.local_a);
    flat::StiffEnd b =
        to_world ? flat::StiffEnd{row.local_b, Vec3(0, 0, 0), Vec3(0, 0, 0)} : flat::end_of(bodies[row.b], row.local_b);
    const Vec3 between = a.place - b.place;
    const double length = between.norm();
    if (!(length > 0)) continue;
    const Vec3 along = between / length;
    flat::find_give(bodies[row.a], along, a);
    if (!to_world) flat::find_give(bodies[row.b], along, b);
    const double slows = row.damping + row.stiffness * dt;
    const double pull = -(row.stiffness * (length - row.rest_length) + slows * along.dot(a.velocity - b.velocity)) /
                        (1 + dt * slows * (a.give + b.give));
    const auto give = [&](std::uint32_t index, const flat::StiffEnd& end, const Vec3& force) {
      if (end.give > 0) plane.push(index, force, Vec3(0, 0, 0), end.arm);
    };
    give(row.a, a, pull * along);
    if (!to_world) give(row.b, b, -pull * along);
  }
  plane.exert(*this);
}

}  // namespace tweenfall
