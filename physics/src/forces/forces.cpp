#include "forces/forces.h"

#include <tweenfall/curves/rotation.h>

#include <limits>

#include "forces/drive_law.h"
#include "forces/flight.h"
#include "forces/kinds/kinds.h"
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

/// Number of bodies that are worth a task of their own.
constexpr std::size_t worth_a_part = 256;

/// Above this a spring would ring through the step, and above 4 it would grow.
constexpr double most_springiness = 1;

/// Torques are not split between both ends of a step, so that a spring on a lever would gain energy, however soft.
bool on_lever(const Body& body, const Vec3& anchor) {
  return moves(body) && anchor != body.mass().center;
}

void add_springiness(const std::vector<Body>& bodies, const Spring& spring, const WorldSettings& settings, double dt,
                     std::vector<Load>& loads) {
  const Body* a = find_body(bodies, spring.a);
  const Body* b = find_body(bodies, spring.b);
  const auto inverse_mass = [](const Body& body, const Vec3& anchor) {
    if (!moves(body)) return 0.0;
    return 1 / body.mass().mass + (anchor - body.mass().center).squaredNorm() * body.inverse_inertia().norm();
  };
  const double stiffness = spring.stiffness * dt * dt + spring.damping * dt;
  const double felt = inverse_mass(*a, spring.anchor_a) + (b ? inverse_mass(*b, spring.anchor_b) : 0);
  const bool turns = settings.integrator == Integrator::exact_quadratic && settings.plane == WorldPlane::none &&
                     (on_lever(*a, spring.anchor_a) || (b && on_lever(*b, spring.anchor_b)));
  const double its = turns ? std::numeric_limits<double>::infinity() : stiffness * felt;
  if (moves(*a)) loads[spring.a.index].springiness += its;
  if (b && moves(*b)) loads[spring.b.index].springiness += its;
}

/// The start of a step, or its end, with bodies where they would be if loads did not change during the step.
class EndOfStep : public Moment {
 public:
  EndOfStep(const std::vector<Body>& all, const WorldSettings& settings, double start, bool later, double dt,
            const std::vector<Load>& loads)
      : Moment(all, settings.gravity, later ? start + dt : start, later ? Side::in : Side::out),
        loads_(loads),
        dt_(dt),
        later_(later) {}
  [[nodiscard]] Glimpse of(std::uint32_t body) const override {
    return later_ ? ahead(bodies[body], loads_[body], dt_) : now(bodies[body]);
  }

 private:
  const std::vector<Load>& loads_;
  double dt_;
  bool later_;
};

/// @param torque_share  share of the torque that counts, since torques are not split between both ends of the step
void put(const Effect& effect, double mass, bool at_end, double torque_share, Load& load) {
  if (effect.force != Vec3::Zero()) (at_end ? load.end_acceleration : load.acceleration) += effect.force / mass;
  if (effect.torque != Vec3::Zero()) load.torque += torque_share * effect.torque;
  if (at_end) return;
  load.drag += effect.resistance / mass;
  load.angular_drag += effect.angular_resistance;
  if (effect.resistance == 0 || effect.medium == Vec3::Zero()) return;
  const Vec3 carried = effect.resistance / mass * effect.medium;
  load.carried += carried;
  load.acceleration += carried;
  load.end_acceleration += carried;
}

}  // namespace

const Body* find_body(const std::vector<Body>& bodies, const BodyId& id) {
  if (id.index >= bodies.size()) return nullptr;
  const Body& body = bodies[id.index];
  return body.alive && body.generation == id.generation ? &body : nullptr;
}

std::optional<Spring> spring_between(const Force& force, double strength, const std::vector<Body>& bodies) {
  std::optional<Spring> spring;
  if (const auto* elastic = std::get_if<Spring>(&force)) spring = spring_of(*elastic, strength);
  if (const auto* damper = std::get_if<Damper>(&force)) spring = spring_of(*damper, strength);
  // If a body at one end was removed, the spring hangs loose.
  if (spring && (!find_body(bodies, spring->a) || (spring->b != BodyId{} && !find_body(bodies, spring->b))))
    spring.reset();
  return spring;
}

Effect effect_of(const Force& force, double strength, const Subject& subject, const Moment& moment) {
  return std::visit(
      [&](const auto& kind) -> Effect {
        if constexpr (requires { spring_of(kind, strength); })
          return {};
        else
          return effect_of(kind, strength, subject, moment);
      },
      force);
}

Named named(const Force& force) {
  return std::visit([](const auto& kind) { return named(kind); }, force);
}

bool stirs(const NumberedForce& entry, double from, double to) {
  if (std::holds_alternative<Field>(entry.force)) return true;
  const auto* formula = std::get_if<ForceFormula>(&entry.force);
  return (formula && formula->reads_time()) || entry.settings.strength.changes(from, to);
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
    load.acceleration = settings.gravity + body.steady_force(settings.gravity) / body.mass().mass;
    load.end_acceleration = load.acceleration;
    load.torque = body.torque();
    load.drag = body.makeup->linear_damping;
    load.angular_damping = body.makeup->angular_damping;
  });
  // A spring has its strength at the middle of the step, unless it is explicit and evaluated at both ends.
  const auto spring_at = [&](const NumberedForce& entry, double when, Side side) {
    return spring_between(entry.force, entry.settings.strength.at(when, side), bodies);
  };
  if (!implicit(settings.integrator))
    for (const NumberedForce& entry : forces)
      if (const auto spring = spring_at(entry, time + 0.5 * dt, Side::out))
        add_springiness(bodies, *spring, settings, dt, loads);
  for (const NumberedForce& entry : forces) {
    const std::optional<Spring> spring = spring_at(entry, time + 0.5 * dt, Side::out);
    if (!spring || !too_stiff(*spring, bodies, loads)) continue;
    const Body* a = find_body(bodies, spring->a);
    const Body* b = find_body(bodies, spring->b);
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
    const EndOfStep moment(bodies, settings, time, at_end, dt, loads);
    for (const NumberedForce& entry : forces) {
      const double strength = entry.settings.strength.at(moment.time, moment.side);
      if (named(entry.force).alone && !std::holds_alternative<Push>(entry.force)) {
        const std::optional<Spring> spring = spring_between(entry.force, strength, bodies);
        if (!spring || too_stiff(*spring, bodies, loads)) continue;
        const Body* a = find_body(bodies, spring->a);
        const Body* b = find_body(bodies, spring->b);
        const Glimpse at_a = moment.of(spring->a.index), at_b = b ? moment.of(spring->b.index) : Glimpse{};
        const Pull pull = pull_of(*spring, *a, at_a, b, at_b);
        const auto apply = [&](const Body& body, std::size_t index, const Vec3& force, const Vec3& arm) {
          if (!moves(body)) return;
          Load& load = loads[index];
          (at_end ? load.end_acceleration : load.acceleration) += force / body.mass().mass;
          load.torque += torque_share * arm.cross(force);
        };
        apply(*a, spring->a.index, pull.force, pull.arm_a);
        if (b) apply(*b, spring->b.index, -pull.force, pull.arm_b);
        continue;
      }
      if (at_end && std::holds_alternative<Drag>(entry.force)) continue;
      each_acted(entry, bodies, watched, [&](std::uint32_t i) {
        if (!moves(bodies[i])) return;
        put(effect_of(entry.force, strength, {bodies[i], moment.of(i)}, moment), bodies[i].mass().mass, at_end,
            torque_share, loads[i]);
      });
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
