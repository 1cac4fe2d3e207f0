#include "planar/checks.h"

#include <tweenfall/curves/number_text.h>

#include <cmath>
#include <stdexcept>

#include "state/checks.h"

namespace tweenfall::planar {

namespace inner {

namespace {

constexpr double largest = 1e30;

}  // namespace

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}
void demand_number(double value, const char* name) {
  demand(std::abs(value) <= largest,
         std::string(name) + " must be finite and at most 1e30, but is " + number_text(value));
}
void demand_numbers(const Vec2& value, const char* name) {
  demand(std::abs(value.x()) <= largest && std::abs(value.y()) <= largest,
         std::string(name) + " must be finite and at most 1e30, but is (" + number_text(value.x()) + ", " +
             number_text(value.y()) + ")");
}
void demand_amount(double value, const char* name) {
  demand(value >= 0 && value <= largest, std::string(name) + " must lie in 0 to 1e30, but is " + number_text(value));
}
void demand_motion(const Motion& motion) {
  demand_numbers(motion.position, "position of a body");
  demand_number(motion.angle, "angle of a body");
  demand_numbers(motion.velocity, "velocity of a body");
  demand_number(motion.spin, "spin of a body");
}

void demand_settings(const WorldSettings& settings) {
  demand_numbers(settings.gravity, "gravity");
  if (settings.sub_steps)
    demand(*settings.sub_steps >= 1 && *settings.sub_steps <= 64,
           "sub_steps must lie in 1 to 64, but is " + std::to_string(*settings.sub_steps));
  demand_amount(settings.sleep_speed, "sleep_speed");
  demand(settings.sleep_after >= 0, "sleep_after must not be negative, but is " + number_text(settings.sleep_after));
  demand_amount(settings.push_out_speed, "push_out_speed");
}

void demand_body(const BodySettings& body) {
  validate(body.shape);
  const bool immovable = body.fixed || body.drive.owner() == Owner::keyed;
  demand(immovable || !std::holds_alternative<HalfPlane>(body.shape.outline),
         "a half-plane has no mass: only fixed and keyed bodies can be one");
  demand_amount(body.friction, "friction");
  demand(body.restitution >= 0 && body.restitution <= 1,
         "restitution must lie in 0 to 1, but is " + number_text(body.restitution));
  demand_amount(body.rolling_friction, "rolling friction");
  demand_amount(body.linear_damping, "linear damping");
  demand_amount(body.angular_damping, "angular damping");
  if (body.mass)
    demand(*body.mass > 0 && *body.mass <= largest,
           "mass must be positive and at most 1e30 kg, but is " + number_text(*body.mass));
  demand(body.density > 0 && body.density <= largest,
         "density must be positive and at most 1e30 kg/m^2, but is " + number_text(body.density));
  if (body.center) demand_numbers(*body.center, "center of mass of a body");
  state::validate(body.drive);
  demand_motion(body.motion);
}

MassProperties mass_of(const BodySettings& body) {
  if (std::holds_alternative<HalfPlane>(body.shape.outline)) return {};
  MassProperties properties =
      mass_properties(body.shape, body.mass ? *body.mass : body.density * area(body.shape.outline));
  if (body.moment) properties.moment = *body.moment;
  if (body.center) properties.center = *body.center;
  demand(properties.moment > 0 && std::isnormal(1 / properties.mass) && std::isnormal(1 / properties.moment),
         "the body is too small, too large, too light or too heavy: its mass would be " + number_text(properties.mass) +
             " kg and its moment of inertia " + number_text(properties.moment) + " kg m^2");
  return properties;
}

}  // namespace inner

}  // namespace tweenfall::planar
