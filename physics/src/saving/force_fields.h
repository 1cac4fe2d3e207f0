#pragma once

/// The fields of forces, each listed once, as in `saving/fields.h`. Opaque types are taken apart.

#include <concepts>
#include <string>
#include <vector>

#include "forces/forces.h"

namespace tweenfall::saving {

template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

/// A strength: a factor, keys or a formula.
struct StrengthParts {
  struct Beyond {
    Outside rule = Outside::hold;
    std::optional<double> slope;
    double plays = 0;
  };
  double factor = 1;
  std::vector<Span<double>> spans;
  Beyond before, after;
  std::string text;
};
[[nodiscard]] StrengthParts parts_of(const Strength& strength);
/// @throws std::invalid_argument for impossible parts
[[nodiscard]] Strength made_of(const StrengthParts& parts);

struct FormulaParts {
  std::vector<std::string> texts;
  std::vector<ForceFormula::Parameter> parameters;
};
[[nodiscard]] FormulaParts parts_of(const ForceFormula& formula);
/// @throws std::invalid_argument for impossible parts
[[nodiscard]] ForceFormula made_of(const FormulaParts& parts);

template <class T>
concept InParts = Is<T, Strength> || Is<T, ForceFormula>;

template <Is<StrengthParts::Beyond> T, class Visit>
void each_field(T& beyond, const Visit& visit) {
  auto& [rule, slope, plays] = beyond;
  visit(rule, slope, plays);
}

template <Is<Span<double>> T, class Visit>
void each_field(T& span, const Visit& visit) {
  auto& [start, duration, degree, coefficients, end, warp, starts_at_key] = span;
  visit(start, duration, degree, coefficients, end, starts_at_key);
  static_cast<void>(warp);  // strengths have none
}

template <Is<StrengthParts> T, class Visit>
void each_field(T& parts, const Visit& visit) {
  auto& [factor, spans, before, after, text] = parts;
  visit(factor, spans, before, after, text);
}

template <Is<ForceFormula::Parameter> T, class Visit>
void each_field(T& parameter, const Visit& visit) {
  auto& [name, value] = parameter;
  visit(name, value);
}

template <Is<FormulaParts> T, class Visit>
void each_field(T& parts, const Visit& visit) {
  auto& [texts, parameters] = parts;
  visit(texts, parameters);
}

template <Is<Drag> T, class Visit>
void each_field(T& drag, const Visit& visit) {
  auto& [linear, quadratic, angular] = drag;
  visit(linear, quadratic, angular);
}

template <Is<Spring> T, class Visit>
void each_field(T& spring, const Visit& visit) {
  auto& [a, b, anchor_a, anchor_b, rest_length, stiffness, damping] = spring;
  visit(a, b, anchor_a, anchor_b, rest_length, stiffness, damping);
}

template <Is<Damper> T, class Visit>
void each_field(T& damper, const Visit& visit) {
  auto& [a, b, anchor_a, anchor_b, damping] = damper;
  visit(a, b, anchor_a, anchor_b, damping);
}

template <Is<Wind> T, class Visit>
void each_field(T& wind, const Visit& visit) {
  auto& [velocity, linear, quadratic, angular, coefficient, density] = wind;
  visit(velocity, linear, quadratic, angular, coefficient, density);
}

template <Is<Buoyancy> T, class Visit>
void each_field(T& buoyancy, const Visit& visit) {
  auto& [normal, level, density, drag, flow] = buoyancy;
  visit(normal, level, density, drag, flow);
}

template <Is<Attractor> T, class Visit>
void each_field(T& attractor, const Visit& visit) {
  auto& [of, at, acceleration, power, softening, by_mass] = attractor;
  visit(of, at, acceleration, power, softening, by_mass);
}

template <Is<Vortex> T, class Visit>
void each_field(T& vortex, const Visit& visit) {
  auto& [at, axis, acceleration, inward, power, softening] = vortex;
  visit(at, axis, acceleration, inward, power, softening);
}

template <Is<Push> T, class Visit>
void each_field(T& push, const Visit& visit) {
  auto& [body, force, torque, at, turns] = push;
  visit(body, force, torque, at, turns);
}

template <Is<forces::NumberedForce> T, class Visit>
void each_field(T& entry, const Visit& visit) {
  auto& [number, force, settings] = entry;
  auto& [bodies, strength] = settings;
  visit(number, force);
  visit.rarely(bodies, strength);
}

}  // namespace tweenfall::saving
