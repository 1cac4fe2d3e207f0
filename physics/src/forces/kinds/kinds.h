#pragma once

/// What each kind of force does, one file for each.

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
  double resistance = 0;          ///< kg/s: besides that, -resistance (velocity - medium)
  double angular_resistance = 0;  ///< kg m^2/s: besides that, -angular_resistance times the spin
  Vec3 medium{0, 0, 0};           ///< m/s
};

/// All bodies at an instant that is asked about.
class Moment {
 public:
  Moment(const std::vector<state::Body>& all, const Vec3& pull, double when) : bodies(all), gravity(pull), time(when) {}
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;
  virtual ~Moment() = default;
  [[nodiscard]] virtual Glimpse of(std::uint32_t body) const = 0;

  const std::vector<state::Body>& bodies;
  Vec3 gravity;
  double time;  ///< of the world, s
};

/// A body at that instant.
struct Subject {
  const state::Body& body;
  Glimpse at;
};

// Of those that act on each body by itself
[[nodiscard]] Effect effect_of(const Drag& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Field& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Wind& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Buoyancy& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Attractor& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Vortex& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const ForceFormula& kind, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Effect effect_of(const Push& kind, double strength, const Subject& subject, const Moment& moment);

// Of those that are between two points: as springs
[[nodiscard]] Spring spring_of(const Spring& kind, double strength);
[[nodiscard]] Spring spring_of(const Damper& kind, double strength);

// Energy of one body in it, J. What has no file of its own for it has none
[[nodiscard]] std::optional<double> energy_of(const Buoyancy& kind, double strength, const Subject&, const Moment&);
[[nodiscard]] std::optional<double> energy_of(const Attractor& kind, double strength, const Subject&, const Moment&);
[[nodiscard]] std::optional<double> energy_of(const ForceFormula& kind, double strength, const Subject&, const Moment&);
[[nodiscard]] std::optional<double> energy_of(const Push& kind, double strength, const Subject&, const Moment&);
template <class Kind>
[[nodiscard]] std::optional<double> energy_of(const Kind&, double, const Subject&, const Moment&) {
  return std::nullopt;
}
/// Of a spring as it stands.
[[nodiscard]] double energy_of(const Spring& spring, const Moment& moment);

// Whether their numbers can be. All throw std::invalid_argument
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

// Which bodies a kind names itself
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

/// Drag of a medium against which a body moves so fast.
[[nodiscard]] double resistance_of(const Drag& drag, double speed);
/// The share of a strength that what resists has.
[[nodiscard]] inline double not_negative(double strength) {
  return strength > 0 ? strength : 0;
}
/// 1 / r^(power + 1) for r = sqrt(square): what a vector of that length is multiplied with. 0 where it has no value.
[[nodiscard]] double fall_off(double square, double power);
void require_power(double power, const char* name);

}  // namespace tweenfall::forces
