#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/number_text.h>

#include "document/fields/things.h"
#include "document/judge/judge.h"
#include "document/read/values.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace tweenfall::document::judging {

namespace {

// The greatest number at any time, if there were room for all.
double wanted(const ParticlesDescription& particles) {
  constexpr double looked_at = 600;
  double sum = 0;
  for (const EmitterDescription& emitter : particles.emitters) {
    if (!(emitter.end > emitter.start)) continue;
    const Range rates = range(emitter.rate, emitter.start, std::min(emitter.end, emitter.start + looked_at));
    const double longest = particles.settings.life * (1 + particles.settings.life_spread);
    sum += std::max(0.0, rates.high) * std::min(longest, emitter.end - emitter.start);
  }
  return sum;
}

std::string counted(double many) {
  constexpr double most_told = 1e15;
  return many < most_told ? std::to_string(std::llround(many)) : "more than 1e15";
}

void judge_particles(Building& building, const ParticlesDescription& particles) {
  constexpr double slow = 200'000;
  const json::Value place = fields::place_of_particles(place_of_world(building), particles.name);
  const double many = wanted(particles), most = static_cast<double>(particles.settings.most);
  if (many > most)
    building.problems.note(below(place, {"most"}), "by their rates and lives up to " + counted(many) +
                                                       " particles would be there at a time; those beyond \"most\", " +
                                                       counted(most) + ", are not let go");
  if (std::min(many, most) > slow)
    building.problems.note(place, "up to " + counted(std::min(many, most)) +
                                      " particles at a time are slow: a hundred thousand fill a frame");
}

void judge_soft(Building& building, const SoftDescription& soft) {
  const json::Value place = fields::place_of_soft(place_of_world(building), soft.name);
  constexpr std::size_t slow = 10'000;
  if (soft.soft.positions.size() > slow)
    building.problems.note(place,
                           std::to_string(soft.soft.positions.size()) + " nodes are slow: a few thousand fill a frame");
  const auto reaches = [](const ForceDescription& force) {
    return std::holds_alternative<Wind>(force.force) && force.bodies.empty();
  };
  if (soft.soft.air_drag > 0 && std::ranges::none_of(building.stage.forces, reaches))
    building.problems.note(
        below(place, {"air_drag"}),
        "\"air_drag\" acts only with a wind among the world's forces that names no bodies; for still air, "
        "one of velocity 0");
  if (!(soft.soft.thickness > 0) || soft.soft.edges.empty()) return;
  double space = 0;
  for (const SoftEdge& edge : soft.soft.edges)
    space += (soft.soft.positions[edge.a] - soft.soft.positions[edge.b]).norm() /
             static_cast<double>(soft.soft.edges.size());
  if (soft.soft.thickness < 0.5 * space)
    building.problems.note(below(place, {"thickness"}), "its nodes are " + brief_text(space) +
                                                            " m from each other: with so small a \"thickness\" it "
                                                            "slips through itself between them");
}

}  // namespace

void judge_actors(Building& building) {
  for (const ParticlesDescription& particles : building.stage.particles) judge_particles(building, particles);
  for (const SoftDescription& soft : building.stage.softs) judge_soft(building, soft);
}

}  // namespace tweenfall::document::judging
