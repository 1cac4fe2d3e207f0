#include <cmath>
#include <utility>

#include "forces/kinds/kinds.h"

namespace tweenfall {

namespace forces {
namespace {

constexpr std::size_t variables_of_force = 8;
const std::array<std::string, variables_of_force>& variable_names() {
  static const std::array<std::string, variables_of_force> names{"x", "y", "z", "mass", "t", "vx", "vy", "vz"};
  return names;
}
constexpr std::size_t variables_of_potential = 5;

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
  std::vector<std::string> timeless(names.begin(), names.end());
  std::erase(timeless, "t");
  for (const std::string& text : texts_) {
    expressions_.emplace_back(text, names, parameters_);
    try {
      static_cast<void>(Expression(text, timeless, parameters_));
    } catch (const ExpressionError&) {
      reads_time_ = true;
    }
  }
}

ForceFormula::ForceFormula(std::array<std::string, 3> force, std::vector<Parameter> parameters)
    : ForceFormula(Texts{{force.begin(), force.end()}}, std::move(parameters)) {}

ForceFormula ForceFormula::potential(std::string energy, std::vector<Parameter> parameters) {
  return {Texts{{std::move(energy)}}, std::move(parameters)};
}

Vec3 ForceFormula::force(double mass, const Vec3& position, const Vec3& velocity, double time) const noexcept {
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

std::optional<double> ForceFormula::energy(double mass, const Vec3& position, double time) const noexcept {
  if (expressions_.size() != 1) return std::nullopt;
  const std::array<Sample<double>, forces::variables_of_potential> at{
      {{position.x(), 0, 0}, {position.y(), 0, 0}, {position.z(), 0, 0}, {mass, 0, 0}, {time, 0, 0}}};
  return forces::finite_or_zero(expressions_[0].sample(at).value);
}

namespace forces {

Effect effect_of(const ForceFormula& kind, double strength, const Subject& subject, const Moment& moment) {
  Effect effect;
  effect.force = strength * kind.force(subject.body.mass().mass, subject.at.center, subject.at.linear, moment.time);
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
