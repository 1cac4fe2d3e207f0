#pragma once

/// What a world in a plane accepts. All throw std::invalid_argument saying what is wrong.

#include <tweenfall/physics/planar_world.h>

#include <string>

namespace tweenfall::planar::inner {

void demand(bool holds, const std::string& what);
void demand_number(double value, const char* name);
void demand_numbers(const Vec2& value, const char* name);
void demand_amount(double value, const char* name);
void demand_motion(const Motion& motion);
void demand_settings(const WorldSettings& settings);
void demand_body(const BodySettings& body);
void validate_joint(const JointSettings& joint);

/// Zero for a half-plane.
[[nodiscard]] MassProperties mass_of(const BodySettings& body);

}  // namespace tweenfall::planar::inner
