#include "forces/forces.h"

#include <tweenfall/curves/rotation.h>

#include "forces/drive_law.h"
#include "forces/flight.h"
#include "forces/spring_pull.h"
#include "step/keyed_step.h"

namespace tweenfall::forces {

using state::Body;

namespace {

bool moves(const Body& body) {
  return !body.immovable() && !body.asleep;
}

Glimpse ahead(const Body& body, const Load& load, double dt) {
  if (body.has_target && body.immovable()) {
    const Vec3 arm = body.target().pose.rotation * body.mass().center;
    const Twist twist = shifted(body.target().twist, arm);
    return {body.target().pose.position + arm, twist.linear, twist.angular, body.target().pose.rotation};
  }
  if (!moves(body)) return {body.center, Vec3::Zero(), Vec3::Zero(), body.motion.pose.rotation};
  const Vec3 angular = body.twist.angular;
  return {body.center + body.twist.linear * dt + load.acceleration * (0.5 * dt * dt),
          body.twist.linear + load.acceleration * dt, angular, exp_map(angular * dt) * body.motion.pose.rotation};
}

/// Bodies that are worth a part of their own.
constexpr std::size_t worth_a_part = 256;

/// Above this a spring would ring through the step, and above 4 it would grow.
constexpr double most_springiness = 1;

void add_springiness(const std::vector<Body>& bodies, const Spring& spring, double dt, std::vector<Load>& loads) {
  const Body* a = find_body(bodies, spring.a);
  const Body* b = find_body(bodies, spring.b);
  if (!a || (!b && spring.b != BodyId{})) return;
  const auto inverse_mass = [](const Body& body, const Vec3& anchor) {
    if (!moves(body)) return 0.0;
    return 1 / body.mass().mass + (anchor - body.mass().center).squaredNorm() * body.inverse_inertia().norm();
  };
  const double stiffness = spring.stiffness * dt * dt + spring.damping * dt;
  const double felt = inverse_mass(*a, spring.anchor_a) + (b ? inverse_mass(*b, spring.anchor_b) : 0);
  if (moves(*a)) loads[spring.a.index].springiness += stiffness * felt;
  if (b && moves(*b)) loads[spring.b.index].springiness += stiffness * felt;
}

}  // namespace

const Body* find_body(const std::vector<Body>& bodies, const BodyId& id) {
  if (id.index >= bodies.size()) return nullptr;
  const Body& body = bodies[id.index];
  return body.alive && body.generation == id.generation ? &body : nullptr;
}

bool too_stiff(const Spring& spring, const std::vector<Body>& bodies, const std::vector<Load>& loads) {
  const auto stiff = [&](const BodyId& end) {
    return find_body(bodies, end) && loads[end.index].springiness > most_springiness;
  };
  return stiff(spring.a) || stiff(spring.b);
}

void gather_loads(const std::vector<Body>& bodies, std::span<const std::uint32_t> watched,
                  const std::vector<NumberedForce>& forces, const WorldSettings& settings, double time, double dt,
                  const threads::Workers& workers, std::vector<Load>& loads, std::vector<step::SpringRow>& stiff,
                  Flight& flight) {
  loads.resize(bodies.size());
  stiff.clear();
  const auto each_watched = [&](const auto& see) {
    workers.ranges(watched.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) see(watched[k]);
    });
  };
  each_watched([&](std::uint32_t i) {
    const Body& body = bodies[i];
    Load& load = loads[i];
    load = {};
    if (body.immovable()) load.acceleration = load.end_acceleration = step::keyed_course(body, dt).gain.linear / dt;
    if (!moves(body)) return;
    load.acceleration = settings.gravity + body.force / body.mass().mass;
    load.end_acceleration = load.acceleration;
    load.torque = body.torque;
    load.drag = body.makeup->linear_damping;
    load.angular_damping = body.makeup->angular_damping;
  });
  if (!implicit(settings.integrator))
    for (const NumberedForce& entry : forces)
      if (const auto* spring = std::get_if<Spring>(&entry.force)) add_springiness(bodies, *spring, dt, loads);
  for (const NumberedForce& entry : forces) {
    const auto* spring = std::get_if<Spring>(&entry.force);
    if (!spring) continue;
    const Body* a = find_body(bodies, spring->a);
    const Body* b = find_body(bodies, spring->b);
    if (!a || (!b && spring->b != BodyId{}) || !too_stiff(*spring, bodies, loads)) continue;
    step::SpringRow row;
    row.a = spring->a.index;
    if (b) row.b = spring->b.index;
    row.local_a = spring->anchor_a - a->mass().center;
    row.local_b = b ? Vec3(spring->anchor_b - b->mass().center) : spring->anchor_b;
    row.rest_length = spring->rest_length;
    row.stiffness = spring->stiffness;
    row.damping = spring->damping;
    stiff.push_back(row);
  }

  // Twice: at the start, and where the bodies would be at the end (velocity Verlet for untouched bodies).
  const double torque_share = settings.integrator == Integrator::exact_quadratic ? 0.5 : 1;
  const auto add = [&](bool at_end) {
    for (const NumberedForce& entry : forces) {
      if (const auto* drag = std::get_if<Drag>(&entry.force)) {
        if (at_end) continue;
        for (const std::uint32_t i : watched) {
          if (!moves(bodies[i])) continue;
          const double speed = bodies[i].twist.linear.norm();
          loads[i].drag += (drag->linear + drag->quadratic * speed) / bodies[i].mass().mass;
          loads[i].angular_drag += drag->angular;
        }
      } else if (const auto* spring = std::get_if<Spring>(&entry.force)) {
        const Body* a = find_body(bodies, spring->a);
        const Body* b = find_body(bodies, spring->b);
        if (!a || (!b && spring->b != BodyId{})) continue;  // an end was removed: the spring hangs loose
        if (too_stiff(*spring, bodies, loads)) continue;
        const Glimpse at_a = at_end ? ahead(*a, loads[spring->a.index], dt) : now(*a);
        const Glimpse at_b = !b ? Glimpse{} : at_end ? ahead(*b, loads[spring->b.index], dt) : now(*b);
        const Pull pull = pull_of(*spring, *a, at_a, b, at_b);
        const auto apply = [&](const Body& body, std::size_t index, const Vec3& force, const Vec3& arm) {
          if (!moves(body)) return;
          Load& load = loads[index];
          (at_end ? load.end_acceleration : load.acceleration) += force / body.mass().mass;
          load.torque += torque_share * arm.cross(force);
        };
        apply(*a, spring->a.index, pull.force, pull.arm_a);
        if (b) apply(*b, spring->b.index, -pull.force, pull.arm_b);
      } else if (const auto* field = std::get_if<Field>(&entry.force)) {
        for (const std::uint32_t i : watched) {
          if (!moves(bodies[i])) continue;
          const Glimpse at = at_end ? ahead(bodies[i], loads[i], dt) : now(bodies[i]);
          const double mass = bodies[i].mass().mass;
          const Vec3 force = (*field)(mass, at.center, at.linear, at_end ? time + dt : time);
          (at_end ? loads[i].end_acceleration : loads[i].acceleration) += force / mass;
        }
      }
    }
  };
  if (Integrate* integrate = asking(settings.integrator)) {
    flight.gather({bodies, forces, settings, time, dt}, watched, integrate, loads);
  } else if (!forces.empty()) {
    add(false);
    if (settings.integrator == Integrator::exact_quadratic) add(true);
  }
  each_watched([&](std::uint32_t i) {
    if (moves(bodies[i]) && bodies[i].drive.owner() == Owner::driven)
      loads[i].pulled = pulled(bodies[i], loads[i], settings.integrator, dt, loads[i].saturated);
  });
}

}  // namespace tweenfall::forces
