#pragma once

/// What each kind of force does, one file per kind.

#include <optional>
#include <span>
#include <vector>

#include "forces/spring_pull.h"
#include "state/body.h"

namespace tweenfall::forces {

/// What a force does to one body, at its center of mass.
struct Effect {
  Vec3 force{0, 0, 0};            ///< N
  Vec3 torque{0, 0, 0};           ///< N m
  double resistance = 0;          ///< kg/s: an additional force of -resistance (velocity - medium)
  double angular_resistance = 0;  ///< kg m^2/s: an additional torque of -angular_resistance times the spin
  Vec3 medium{0, 0, 0};           ///< m/s
};

/// All bodies at the instant of evaluation.
class Moment {
 public:
  Moment(const std::vector<state::Body>& all, const Vec3& pull, double when, Side which = Side::out)
      : bodies(all), gravity(pull), time(when), side(which) {}
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;
  virtual ~Moment() = default;
  [[nodiscard]] virtual Glimpse of(std::uint32_t body) const = 0;

  const std::vector<state::Body>& bodies;
  Vec3 gravity;
  double time;  ///< of the world, s
  Side side;    ///< of what leaps then
};

/// A body at that instant.
struct Subject {
  const state::Body& body;
  Glimpse at;
};

// Forces that act on each body by itself
[[nodiscard]] Effect effect_of(const Drag& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Field& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Wind& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Buoyancy& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Attractor& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Vortex& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const ForceFormula& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Push& kind, double strength, const Subject& subject, const Moment& moment);

// Forces between two points, as springs
[[nodiscard]] Spring spring_of(const Spring& kind, double strength);
[[nodiscard]] Spring spring_of(const Damper& kind, double strength);

// Potential energy of one body, J. Kinds without a function of their own have none
[[nodiscard]] std::optional<double> energy_of(const Buoyancy& kind, double strength, const Subject&, const Moment&);
[[nodiscard]] std::optional<double> energy_of(const Attractor& kind, double strength, const Subject&, const Moment&);
[[nodiscard]] std::optional<double> energy_of(const ForceFormula& kind, double strength, const Subject&, const Moment&);
[[nodiscard]] std::optional<double> energy_of(const Push& kind, double strength, const Subject&, const Moment&);
template <class Kind>
[[nodiscard]] std::optional<double> energy_of(const Kind&, double, const Subject&, const Moment&) {
  return std::nullopt;
}
/// Of a spring between the bodies' positions.
[[nodiscard]] double energy_of(const Spring& spring, const Moment& moment);

// Check the numbers. All throw std::invalid_argument
void validate(const Drag& kind);
void validate(const Spring& kind);
void validate(const Field& kind);
void validate(const Damper& kind);
void validate(const Wind& kind);
void validate(const Buoyancy& kind);
void validate(const Attractor& kind);
void validate(const Vortex& kind);
void validate(const ForceFormula& kind);
void validate(const Push& kind);

// Bodies that a force names itself
struct Named {
  bool alone = false;            ///< it acts on no others
  std::array<BodyId, 2> ends{};  ///< the default handle: none
};
[[nodiscard]] inline Named named(const Spring& kind) {
  return {true, {kind.a, kind.b}};
}
[[nodiscard]] inline Named named(const Damper& kind) {
  return {true, {kind.a, kind.b}};
}
[[nodiscard]] inline Named named(const Attractor& kind) {
  return {false, {kind.of}};
}
[[nodiscard]] inline Named named(const Push& kind) {
  return {true, {kind.body}};
}
template <class Kind>
[[nodiscard]] Named named(const Kind&) {
  return {};
}

/// Drag of a medium on a body that moves through it with this speed.
[[nodiscard]] double resistance_of(const Drag& drag, double speed);
/// The strength that applies to resistance.
[[nodiscard]] inline double not_negative(double strength) {
  return strength > 0 ? strength : 0;
}
/// 1 / r^(power + 1) with r = sqrt(square): the factor for a vector of that length. 0 if it has no value.
[[nodiscard]] double fall_off(double square, double power);
void require_power(double power, const char* name);

}  // namespace tweenfall::forces
