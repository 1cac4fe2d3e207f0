#include "document/actors/actors.h"
#include "document/fields/things.h"
#include "document/forces/force.h"
#include "document/forces/forces.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_expression.h"
#include "document/tracks/read_track.h"

#include <tweenfall/curves/expression.h>

namespace tweenfall::document::actors {

namespace {

using Kind = json::Value::Kind;
using Source = EmitterDescription;

fields::FormOf share_form(double most = 1) {
  return bounded("a number from 0 to " + std::to_string(static_cast<int>(most)), 0, false, most);
}

// A number, keys or an expression over the stage's time.
std::optional<Curve<double>> curve_of(const json::Value& value, Building& building) {
  if (value.is(Kind::number)) return Curve<double>(value.number());
  if (value.is(Kind::list)) return read_play_keys(value, building.fps, {}, 0, building.problems);
  const json::Value text = value.is(Kind::object) ? usable(value, "expression") : json::Value();
  if (!text) return {};
  try {
    return expression_curve(Expression(std::string(text.text())));
  } catch (const ExpressionError& fault) {
    add_fault_of_expression(text, fault, building.problems);
  }
  return {};
}

fields::Meaning<Source> curve(Curve<double> Source::*part, std::string standard) {
  return {[part](const json::Value& value, Source& emitter, Building& building) {
            if (const std::optional<Curve<double>> given = curve_of(value, building)) emitter.*part = *given;
          },
          std::move(standard)};
}

fields::Meaning<Source> seconds(double Source::*part, std::string standard) {
  return {[part](const json::Value& value, Source& emitter, Building& building) {
            const ClipTimes times(building.fps, {}, "stage time has none");
            if (const std::optional<double> given = times.seconds(value, {}, building.problems)) emitter.*part = *given;
          },
          std::move(standard)};
}

const fields::Table<Source>& emitter_table() {
  using fields::member;
  const fields::Meaning<Source> node = {[](const json::Value& value, Source& emitter, Building& building) {
    const auto found = building.nodes.find(value.text());
    if (found != building.nodes.end())
      emitter.node = found->second;
    else if (!building.excused(value.text()))
      building.problems.add(
          value, "there is no node " + json::in_quotes(value.text()) + suggestion(value.text(), building.node_names()));
  }};
  const fields::Meaning<Source> direction = {[](const json::Value& value, Source& emitter, Building& building) {
                                               if (const auto given = axis_of(value, building.problems))
                                                 emitter.direction = *given;
                                             },
                                             "\"y\""};
  const fields::Meaning<Source> spread = {[](const json::Value& value, Source& emitter, Building&) {
                                            if (value.is(Kind::number)) emitter.spread = radians(value.number());
                                          },
                                          "0"};
  static const fields::Table<Source> table(
      "an emitter",
      {{"node", &ValueForms::name, "it sits on this node and moves with it; absent: the world", node},
       {"position", &ValueForms::vector, "on that node or in the world, m", member<Source>(&Source::position)},
       {"direction", &ValueForms::axis, "in which particles leave, on the node", direction},
       {"rate",
        forces::strength_form,
        "particles per second",
        curve(&Source::rate, ""),
        true,
        {},
        {"flow", "per_second"}},
       {"speed", forces::strength_form, "m/s", curve(&Source::speed, "0"), false, {}, {"velocity"}},
       {"inherit", &ValueForms::number, "share of the node's velocity that the particles keep",
        member<Source>(&Source::inherit)},
       {"spread", bounded("an angle from 0 to 180 degrees", 0, false, 180),
        "half angle of the cone in which they leave, degrees", spread},
       {"speed_spread", share_form(), "they are faster or slower by up to this share",
        member<Source>(&Source::speed_spread)},
       {"size", &ValueForms::not_negative, "radius of the ball in which they begin, m", member<Source>(&Source::size)},
       {"start", &ValueForms::stage_time, "stage time", seconds(&Source::start, "0")},
       {"end", &ValueForms::stage_time, "stage time; absent: never", seconds(&Source::end, "")}});
  return table;
}

const Form* emitters_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(store.add(emitter_table().listing_form(store, values)), "a list of emitters"));
}

void read_emitters(const json::Value& value, ParticlesDescription& particles, Building& building) {
  for (const json::Value& item : value.items()) {
    if (!item.is(Kind::object)) continue;
    emitter_table().read(item, particles.emitters.emplace_back(), building);
  }
}

const Form* forces_form(FormStore& store, const ValueForms& values) {
  Form forces = list_of(forces::form(store, values), "a list of forces", 0);
  forces.one_per_line = true;
  return store.add(std::move(forces));
}

void read_forces(const json::Value& value, ParticlesDescription& particles, Building& building) {
  for (const json::Value& force : value.items()) forces::read(force, particles.forces, building);
}

const fields::Table<ParticlesDescription>& particles_table() {
  const auto of_settings = [](auto ParticleSettings::*part) {
    return [part](ParticlesDescription & particles) -> auto& {
      return particles.settings.*part;
    };
  };
  const auto member_of = [&](auto ParticleSettings::*part) {
    return fields::member<ParticlesDescription>(of_settings(part));
  };
  fields::Meaning<ParticlesDescription> gravity = member_of(&ParticleSettings::gravity);
  gravity.standard = {};
  const fields::Meaning<ParticlesDescription> most = {
      [](const json::Value& value, ParticlesDescription& particles, Building&) {
        if (value.is(Kind::number)) particles.settings.most = static_cast<std::size_t>(value.number());
      },
      "1000000"};
  const fields::Meaning<ParticlesDescription> seed = {
      [](const json::Value& value, ParticlesDescription& particles, Building&) {
        if (value.is(Kind::number)) particles.settings.seed = static_cast<std::uint64_t>(value.number());
      },
      "1"};
  const auto color = [](ParticlesDescription& particles) -> std::optional<Color>& { return particles.color; };
  static const fields::Table<ParticlesDescription> table(
      "a kind of particles",
      {{"emitters", emitters_form, "where they come from", {read_emitters}, true},
       {"life", &ValueForms::positive, "s from when one is let go", member_of(&ParticleSettings::life)},
       {"life_spread", share_form(), "lives are longer or shorter by up to this share",
        member_of(&ParticleSettings::life_spread)},
       {"mass", &ValueForms::positive, "of each, kg", member_of(&ParticleSettings::mass)},
       {"radius", &ValueForms::not_negative, "how far from its middle one touches bodies, m",
        member_of(&ParticleSettings::radius)},
       {"restitution", share_form(), "of bounces", member_of(&ParticleSettings::restitution)},
       {"friction", &ValueForms::not_negative, "with bodies", member_of(&ParticleSettings::friction)},
       {"gravity", &ValueForms::vector, "m/s^2; absent: the world's", gravity},
       fields::one_of<ParticlesDescription, Integrator>("integrator", "an integrator", fields::integrator_words(),
                                                        "the method of integration",
                                                        of_settings(&ParticleSettings::integrator)),
       {"forces", forces_form, "that act on them alone; only kinds that name no bodies", {read_forces, "[]"}},
       {"collide", &ValueForms::boolean, "whether they bounce off bodies",
        fields::member<ParticlesDescription>(&ParticlesDescription::collide)},
       {"most", bounded("a whole number from 1 to 1000000", 1, false, 1'000'000, true), "at a time", most},
       {"seed", bounded("a whole number of at least 0", 0, false, 9e15, true), "of their random numbers", seed},
       {"color", &ValueForms::color, "", fields::member<ParticlesDescription>(color)}});
  return table;
}

}  // namespace

const Form* particles_form(FormStore& store, const ValueForms& values) {
  Form particles = particles_table().form(store, values);
  particles.definition = "particles";
  return store.add(map_of(store.add(std::move(particles)), "an object with particles by name"));
}

void read_particles(const json::Value& value, Building& building) {
  const auto begin = [&](std::string name) {
    ParticlesDescription particles{.name = std::move(name)};
    particles.settings.gravity = building.stage.world.gravity;
    return particles;
  };
  read_by_name(value, particles_table(), building, building.stage.particles, begin);
}

}  // namespace tweenfall::document::actors
