#pragma once

/// What a world accepts. All throw std::invalid_argument saying what is wrong.

#include <tweenfall/physics/world.h>

#include <optional>
#include <string>

#include "state/body.h"

namespace tweenfall::state {

void require(bool holds, const std::string& what);
void require_finite(const Vec3& value, const char* name);
void require_amount(double value, const char* name);

void validate(const WorldSettings& settings);
void validate(const Force& force);
void validate(const Drive& drive);
/// Friction, restitution, damping and collision.
void validate_surface(const Makeup& body);
void validate_surface(const Twist& velocity);

[[nodiscard]] inline bool conveys(const Twist& surface) {
  return surface.linear != Vec3::Zero() || surface.angular != Vec3::Zero();
}

/// Whether a body has a collision of its own that the default step does not know.
[[nodiscard]] bool asks_for_other_detection(const Makeup& body);

/// The motion with its rotation normalized if it is not yet.
[[nodiscard]] Motion checked(Motion motion);

/// Sets what follows from a body's shape and mass: mass properties, radius, roundness. A plane has none.
/// @param immovable  fixed or keyed
/// @param given  kg; absent: density times volume
/// @param weighed  in place of those of an even solid
void give_mass(Makeup& body, bool immovable, const std::optional<double>& given, double density,
               const std::optional<MassProperties>& weighed);

}  // namespace tweenfall::state
