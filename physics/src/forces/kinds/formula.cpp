#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "forces/formula_leaps.h"
#include "forces/kinds/kinds.h"

namespace tweenfall {

namespace forces {
namespace {

constexpr std::size_t variables_of_force = 8;
const std::array<std::string, variables_of_force>& variable_names() {
  static const std::array<std::string, variables_of_force> names{"x", "y", "z", "mass", "t", "vx", "vy", "vz"};
  return names;
}
constexpr std::size_t variables_of_potential = 5, time_variable = 4;

double finite_or_zero(double value) {
  return std::isfinite(value) ? value : 0;
}

}  // namespace
}  // namespace forces

ForceFormula::ForceFormula(Texts texts, std::vector<Parameter> parameters)
    : texts_(std::move(texts.all)), parameters_(std::move(parameters)) {
  const std::span<const std::string> names(forces::variable_names().data(), texts_.size() == 1
                                                                                ? forces::variables_of_potential
                                                                                : forces::variables_of_force);
  for (const std::string& text : texts_) {
    const Expression& formula = expressions_.emplace_back(text, names, parameters_);
    reads_time_ = reads_time_ || formula.reads(forces::time_variable);
    for (const Expression& part : formula.jumping_parts())
      if (part.reads(0) || part.reads(1) || part.reads(2)) leaping_by_place_.push_back(part);
  }
  leaping_by_time_ = forces::leaping_parts(expressions_, forces::time_variable, names.size());
}

ForceFormula::ForceFormula(std::array<std::string, 3> force, std::vector<Parameter> parameters)
    : ForceFormula(Texts{{force.begin(), force.end()}}, std::move(parameters)) {}

ForceFormula ForceFormula::potential(std::string energy, std::vector<Parameter> parameters) {
  return {Texts{{std::move(energy)}}, std::move(parameters)};
}

Vec3 ForceFormula::force(double mass, const Vec3& position, const Vec3& velocity, double time,
                         Side side) const noexcept {
  time = forces::beside_leaps(leaping_by_time_, forces::time_variable, time, side);
  std::array<Sample<double>, forces::variables_of_force> at{};
  const std::array<double, forces::variables_of_force> values{position.x(), position.y(), position.z(), mass,
                                                              time,         velocity.x(), velocity.y(), velocity.z()};
  for (std::size_t i = 0; i < values.size(); ++i) at[i] = {values[i], 0, 0};
  Vec3 force;
  for (std::size_t i = 0; i < 3; ++i) {
    if (expressions_.size() == 1) at[i].rate = 1;
    const Sample<double> sample = expressions_[expressions_.size() == 1 ? 0 : i].sample(at);
    force[static_cast<Eigen::Index>(i)] =
        forces::finite_or_zero(expressions_.size() == 1 ? -sample.rate : sample.value);
    at[i].rate = 0;
  }
  return force;
}

void ForceFormula::forces(double mass, const Lists& positions, const Lists& velocities, double time, Side side,
                          const std::array<std::span<double>, 3>& out) const noexcept {
  time = forces::beside_leaps(leaping_by_time_, forces::time_variable, time, side);
  using List = std::span<const double>;
  const std::array<List, forces::variables_of_force> at{positions[0],   positions[1],  positions[2],  List(&mass, 1),
                                                        List(&time, 1), velocities[0], velocities[1], velocities[2]};
  const bool from_potential = expressions_.size() == 1;
  if (from_potential) expressions_[0].slopes(at, 0, out);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!from_potential) expressions_[axis].values(at, out[axis]);
    for (double& force : out[axis]) force = forces::finite_or_zero(from_potential ? -force : force);
  }
}

double ForceFormula::next_leap(double from, double to) const noexcept {
  double first = std::numeric_limits<double>::infinity();
  for (const Expression& part : leaping_by_time_)
    first = std::min(first, forces::next_leap(forces::by_time(part, forces::time_variable), from, std::min(to, first)));
  return first;
}

std::vector<double> ForceFormula::leaps_on_way(double mass, const Vec3& from, const Vec3& to, double time,
                                               double dt) const {
  constexpr std::size_t most = 8;
  const Vec3 velocity = (to - from) / dt;
  std::vector<double> leaps;
  for (const Expression& part : leaping_by_place_) {
    const auto along = [&](double since, Side side) {
      const Vec3 at = from + since * velocity;
      const std::array<Sample<double>, forces::variables_of_force> there{{{at.x(), velocity.x(), 0},
                                                                          {at.y(), velocity.y(), 0},
                                                                          {at.z(), velocity.z(), 0},
                                                                          {mass, 0, 0},
                                                                          {time + since, 1, 0},
                                                                          {velocity.x(), 0, 0},
                                                                          {velocity.y(), 0, 0},
                                                                          {velocity.z(), 0, 0}}};
      return part.sample(there, side);
    };
    for (double since = 0; leaps.size() < most;) {
      since = forces::next_leap(along, since, dt);
      if (!(since <= dt)) break;
      leaps.push_back(since);
    }
  }
  std::ranges::sort(leaps);
  return leaps;
}

std::optional<double> ForceFormula::energy(double mass, const Vec3& position, double time) const noexcept {
  if (expressions_.size() != 1) return std::nullopt;
  const std::array<Sample<double>, forces::variables_of_potential> at{
      {{position.x(), 0, 0}, {position.y(), 0, 0}, {position.z(), 0, 0}, {mass, 0, 0}, {time, 0, 0}}};
  return forces::finite_or_zero(expressions_[0].sample(at).value);
}

namespace forces {

Effect effect_of(const ForceFormula& kind, double strength, const Subject& subject, const Moment& moment) {
  Effect effect;
  effect.force =
      strength * kind.force(subject.body.mass().mass, subject.at.center, subject.at.linear, moment.time, moment.side);
  return effect;
}

std::optional<double> energy_of(const ForceFormula& kind, double strength, const Subject& subject,
                                const Moment& moment) {
  const std::optional<double> energy = kind.energy(subject.body.mass().mass, subject.at.center, moment.time);
  if (!energy) return std::nullopt;
  return strength * *energy;
}

void validate(const ForceFormula&) {}

}  // namespace forces
}  // namespace tweenfall
