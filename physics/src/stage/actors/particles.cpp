#include "stage/actors/particles.h"

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/hermite.h>
#include <tweenfall/curves/keys.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stage/actors/named.h"
#include "stage/between.h"

namespace tweenfall::staging {

namespace {

Curve<Vec3> velocity_of(const EmitterDescription& emitter) {
  if (!(std::abs(emitter.direction.norm() - 1) < 1e-9))
    throw std::invalid_argument("the direction of an emitter must be a unit vector");
  return combined<Vec3>(std::array{emitter.speed}, std::array{emitter.direction});
}

Particles particles_of(const StageState& state, const ParticlesDescription& described) {
  Particles particles(described.settings);
  for (std::size_t i = 0; i < described.emitters.size(); ++i) {
    const EmitterDescription& emitter = described.emitters[i];
    if (emitter.node != no_node && emitter.node >= state.nodes->size())
      throw std::invalid_argument("its emitter " + std::to_string(i) + ": there is no node number " +
                                  std::to_string(emitter.node));
    try {
      particles.add({.position = Curve<Vec3>(emitter.position),
                     .rate = emitter.rate,
                     .velocity = velocity_of(emitter),
                     .inherit = emitter.inherit,
                     .spread = emitter.spread,
                     .speed_spread = emitter.speed_spread,
                     .size = emitter.size,
                     .start = emitter.start,
                     .end = emitter.end});
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument("its emitter " + std::to_string(i) + ": " + fault.what());
    }
  }
  for (const ForceDescription& force : described.forces) {
    if (force.a != no_node || force.b != no_node || !force.bodies.empty())
      throw std::invalid_argument("forces on particles cannot name bodies");
    particles.add_force(force.force, force.strength);
  }
  return particles;
}

}  // namespace

void add_particles(StageState& state, const StageDescription& description, std::vector<StageFault>& faults) {
  for (std::size_t i = 0; i < description.particles.size(); ++i) {
    const ParticlesDescription& described = description.particles[i];
    const auto refuse = [&](const std::string& why) {
      faults.push_back({StageFault::Part::particles, i, "the particles \"" + described.name + "\": " + why});
    };
    if (std::ranges::any_of(state.particles,
                            [&](const auto& other) { return other.described->name == described.name; }))
      refuse("others have this name");
    try {
      state.particles.push_back(
          {std::make_shared<const ParticlesDescription>(described), particles_of(state, described)});
    } catch (const std::invalid_argument& fault) {
      refuse(fault.what());
    }
  }
}

ParticleStep::Place ParticleStep::place_of(const StageState& state, const EmitterDescription& emitter, double time) {
  const WorldMotion world = node_world(state, state, emitter.node, time);
  return {world.point(emitter.position), world.point_velocity(emitter.position), world.motion.pose.rotation};
}

ParticleStep::ParticleStep(const StageState& state) : from_(state.time) {
  for (const StagedParticles& staged : state.particles) {
    std::vector<Place>& starts = starts_.emplace_back();
    for (const EmitterDescription& emitter : staged.described->emitters)
      starts.push_back(emitter.node != no_node && state.present[emitter.node] ? place_of(state, emitter, state.time)
                                                                              : Place{});
  }
}

void ParticleStep::take(StageState& state) const {
  const double dt = state.time - from_;
  for (std::size_t kind = 0; kind < state.particles.size(); ++kind) {
    StagedParticles& staged = state.particles[kind];
    Particles& particles = staged.particles;
    for (std::size_t i = 0; i < staged.described->emitters.size(); ++i) {
      const EmitterDescription& emitter = staged.described->emitters[i];
      if (emitter.node == no_node) continue;
      if (!state.present[emitter.node]) {
        particles.halt(i);
        continue;
      }
      // If a path jumps at the end, particles that leave before the jump leave from this side.
      const Place& start = starts_[kind][i];
      const Place end = place_of(state, emitter, state.time - sliver);
      const double now = particles.time();
      const auto given = [](const Vec3& rate) { return Tangent<Vec3>{TangentKind::given, rate}; };
      particles.place(i,
                      keyed_curve<Vec3>({{.time = now, .value = start.point, .out = given(start.velocity)},
                                         {.time = now + dt, .value = end.point, .in = given(end.velocity)}}),
                      keyed_curve<Quat>({{.time = now, .value = start.rotation, .ease = Ease::linear()},
                                         {.time = now + dt, .value = end.rotation}}));
    }
    if (staged.described->collide)
      particles.step(dt, state.world);
    else
      particles.step(dt);
  }
}

StageParticles stage_particles(const StageState& from, const StageState& to, std::string_view name, double time) {
  const std::size_t index = index_called(to.particles, name, "kind of particles");
  const Particles& after = to.particles[index].particles;
  StageParticles shown;
  const auto add = [&](const Vec3& position, const Vec3& velocity, std::uint64_t number) {
    shown.positions.push_back(position);
    shown.velocities.push_back(velocity);
    shown.numbers.push_back(number);
  };
  const bool between = is_between(from, to, time);
  std::size_t next = 0;
  if (between) {
    const Particles& before = from.particles[index].particles;
    const double span = to.time - from.time, since = time - from.time;
    const double now = before.time() + since;
    // Both lists are in order of age; particles only in the first die within the step.
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (next < after.size() && after.numbers()[next] == before.numbers()[i]) {
        const Sample<Vec3> way = hermite::sample<Vec3>(before.position(i), before.velocity(i), after.position(next),
                                                       after.velocity(next), span, since / span);
        add(way.value, way.rate, before.numbers()[i]);
        ++next;
      } else if (before.dies()[i] > now) {
        add(before.position(i) + since * before.velocity(i), before.velocity(i), before.numbers()[i]);
      }
    }
    for (; next < after.size(); ++next)
      if (after.born()[next] <= now)
        add(after.position(next) - (to.time - time) * after.velocity(next), after.velocity(next),
            after.numbers()[next]);
    return shown;
  }
  for (; next < after.size(); ++next)
    add(after.position(next) + (time - to.time) * after.velocity(next), after.velocity(next), after.numbers()[next]);
  return shown;
}

}  // namespace tweenfall::staging
