#include "state/checks.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/mass_properties.h>
#include <tweenfall/physics/strategies.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "collision/surfaces/surface.h"
#include "flat/flat.h"
#include "forces/integrators/integrators.h"
#include "forces/kinds/kinds.h"
#include "shapes/compound.h"
#include "shapes/turned.h"
#include "state/countable.h"

namespace tweenfall::state {

namespace {

/// Farthest point of the solid from its center of mass.
double radius_of(const Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&solid)) return sphere->radius;
  if (const auto* box = std::get_if<Box>(&solid)) return box->half_extents.norm();
  if (const auto* capsule = std::get_if<Capsule>(&solid)) return capsule->radius + capsule->half_height;
  if (const auto* hull = std::get_if<Hull>(&solid)) return hull->convex.outer_radius();
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) return shapes::radius_of(*cylinder);
  if (const auto* cone = std::get_if<Cone>(&solid)) return shapes::radius_of(*cone);
  if (const auto* tapered = std::get_if<TaperedCapsule>(&solid)) return shapes::radius_of(*tapered);
  if (const auto* compound = std::get_if<Compound>(&solid)) {
    const Vec3 center = shapes::mass_of(*compound, 1).center;
    double most = 0;
    for (const Shape& part : compound->parts())
      most = std::max(most, (mass_properties(part, 1).center - center).norm() + radius_of(part.solid));
    return most;
  }
  if (const surfaces::Surface* surface = surfaces::surface_of(solid)) return surface->reach();
  return std::numeric_limits<double>::infinity();
}

/// What a body can have: moments about all axes, none so small beside another that dividing by it fails.
void require_solid(const MassProperties& weighed) {
  tweenfall::validate(weighed);
  require_finite(weighed.center, "center of mass");
  const Vec3 moments = principal_axes(weighed).moments;
  require(moments[0] > 1e-9 * moments[2] && moments[0] >= smallest && moments[2] <= largest,
          "a body needs a moment of inertia about every axis, but its principal ones are " + number_text(moments[0]) +
              ", " + number_text(moments[1]) + " and " + number_text(moments[2]) + " kg m^2");
}

/// More passes than this would only take their time.
constexpr int most_iterations = 10'000;

/// Of a body's principal moments of inertia, the least is taken to be at least this part of the greatest.
constexpr double least_moment = 1e-4;

/// A needle turns about itself so easily that any touch of its side spins it thousands of times a second, which no step
/// follows, and which costs next to no energy: its least moment is raised until steps do. That of a rod 1 m long and
/// less than 8 mm thick is.
void raise_least_moment(MassProperties& properties) {
  constexpr double rounding = 1e-6;  // what has been raised stays as it is
  const PrincipalAxes axes = principal_axes(properties);
  const double least = least_moment * axes.moments[2];
  if (axes.moments[0] >= (1 - rounding) * least) return;
  const Vec3 thin = axes.orientation * Vec3::UnitX();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) properties.inertia(i, k) += (least - axes.moments[0]) * (thin[i] * thin[k]);
}

/// Whether small errors of where it points change the energy of its spin much. A long thin rod has one small moment;
/// the product of all three tells, whatever the axes.
bool is_slender(const Mat3& inertia) {
  constexpr double like_a_rod = 0.0025;  // a rod ten times as long as thick
  const double sum = inertia.trace();
  return inertia.determinant() < like_a_rod * (sum * sum * sum);
}

}  // namespace

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

void require_finite(const Vec3& value, const char* name) {
  // The words are put together when they are needed: this is asked of all that is led, in every step.
  if (countable(value)) return;
  require(false, std::string(name) + " must be finite and at most 1e30, but is (" + number_text(value.x()) + ", " +
                     number_text(value.y()) + ", " + number_text(value.z()) + ")");
}

void require_amount(double value, const char* name) {
  require(value >= 0 && countable(value), std::string(name) + " must lie in 0 to 1e30, but is " + number_text(value));
}

void validate(const Force& force) {
  std::visit([](const auto& kind) { forces::validate(kind); }, force);
}

void validate(const Drive& drive) {
  require(drive.hz >= 0, "frequency of a drive must be 0 (free), positive, or infinite (keyed), but is " +
                             number_text(drive.hz) + " Hz");
  require(drive.zeta >= 0 && std::isfinite(drive.zeta),
          "damping ratio of a drive must not be negative and must be finite, but is " + number_text(drive.zeta));
  require(drive.max_force >= 0,
          "greatest force of a drive must not be negative, but is " + number_text(drive.max_force));
  require(drive.max_torque >= 0,
          "greatest torque of a drive must not be negative, but is " + number_text(drive.max_torque));
  require(drive.gravity_compensation >= 0 && drive.gravity_compensation <= 1,
          "gravity compensation of a drive must lie in 0 to 1, but is " + number_text(drive.gravity_compensation));
  require(drive.frame >= Drive::Frame::world && drive.frame <= Drive::Frame::anchor,
          "frame of a drive must be the world, the parent or the anchor");
}

Motion checked(Motion motion) {
  require_finite(motion.pose.position, "position");
  require_finite(motion.pose.scale, "scale");
  require_finite(motion.twist.linear, "linear velocity");
  require_finite(motion.twist.angular, "angular velocity");
  require_finite(motion.scale_rate, "rate of the scale");
  const double length = motion.pose.rotation.norm();
  require(std::isfinite(length) && length > 0, "rotation must be a quaternion that can be normalized");
  // A unit quaternion stays as it was given, to the bit.
  if (std::abs(length - 1) > 1e-12) motion.pose.rotation = normalized(motion.pose.rotation);
  return motion;
}

void validate(const WorldSettings& settings) {
  require_finite(settings.gravity, "gravity");
  require(settings.iterations >= 1 && settings.iterations <= most_iterations,
          "iterations must be 1 to " + std::to_string(most_iterations) + ", but are " +
              std::to_string(settings.iterations));
  require(settings.sleep_speed >= 0, "sleep speed must not be negative, but is " + number_text(settings.sleep_speed));
  require(settings.sleep_after >= 0, "sleep_after must not be negative, but is " + number_text(settings.sleep_after));
  require(settings.threads >= 0 && settings.threads <= 256,
          "threads must be 0 to 256, but are " + std::to_string(settings.threads));
  require(settings.push_out_speed >= 0,
          "push-out speed must not be negative, but is " + number_text(settings.push_out_speed));
  require(forces::exists(settings.integrator), "there is no such integrator");
  require(settings.solver <= ContactSolver::lcp, "there is no such solver");
  require(settings.separation <= Parting::closest_point, "there is no such separation");
  require(settings.collision <= Detection::time_of_impact, "there is no such collision detection");
  require(settings.broad_phase <= PairSearch::bvh, "there is no such broad phase");
  flat::validate(settings);
}

void validate_surface(const Makeup& body) {
  require_amount(body.friction, "friction");
  require(body.restitution >= 0 && body.restitution <= 1,
          "restitution must lie in 0 to 1, but is " + number_text(body.restitution));
  require_amount(body.rolling_friction, "rolling friction");
  require_amount(body.spinning_friction, "spinning friction");
  require(body.friction_combine <= Combine::maximum && body.restitution_combine <= Combine::maximum,
          "there is no such rule to combine frictions or restitutions");
  require(!body.collision || *body.collision <= Detection::time_of_impact, "there is no such collision detection");
  require(!body.collision || !body.sensor,
          "a sensor takes no collision of its own: it notices what overlaps it at the end of a step");
  require_amount(body.linear_damping, "linear damping");
  require_amount(body.angular_damping, "angular damping");
}

bool asks_for_other_detection(const Makeup& body) {
  return body.collision.value_or(Detection{}) != Detection{};
}

void validate_surface(const Twist& velocity) {
  require_finite(velocity.linear, "velocity of a surface");
  require_finite(velocity.angular, "angular velocity of a surface");
}

void give_mass(Makeup& body, bool immovable, const std::optional<double>& given, double density,
               const std::optional<MassProperties>& weighed) {
  tweenfall::validate(body.shape.solid);
  Pose& offset = body.shape.offset;
  const double turn = offset.rotation.norm();
  require_finite(offset.position, "offset of a shape");
  require(std::isfinite(turn) && turn > 0, "rotation of a shape must be a quaternion that can be normalized");
  if (std::abs(turn - 1) > 1e-12) offset.rotation = normalized(offset.rotation);
  body.shape = shapes::without_offset(body.shape);
  const Solid& solid = body.shape.solid;
  const bool endless = std::holds_alternative<Plane>(solid);
  if (is_scenery(solid)) {
    require(immovable, std::string("a body with ") + kind_name(solid) + " must be fixed or keyed: it has no mass");
    require(!weighed, std::string(kind_name(solid)) + " has no mass, so it takes no mass properties");
    body.mass.center = offset.position;
  } else {
    require(!given || !weighed, "a body takes a mass or mass properties, not both");
    if (weighed) require_solid(*weighed);
    const double mass = weighed ? weighed->mass : given ? *given : density * volume(solid);
    require(mass >= smallest && mass <= largest,
            "mass must lie in 1e-30 kg to 1e30 kg, but is " + number_text(mass) + " kg");
    body.mass = mass_properties(body.shape, mass);
    if (weighed) {
      body.radius = (weighed->center - body.mass.center).norm();
      body.mass = *weighed;
      body.weighed = true;
    }
    raise_least_moment(body.mass);
    body.slender = is_slender(body.mass.inertia);
    body.inverse_inertia = body.mass.inertia.inverse();
    const double first = body.mass.inertia(0, 0);
    body.spherical = (std::holds_alternative<Sphere>(solid) && !weighed) ||
                     (body.mass.inertia - first * Mat3::Identity()).cwiseAbs().maxCoeff() <= 1e-14 * first;
    if (body.spherical) {
      body.mass.inertia = first * Mat3::Identity();
      body.inverse_inertia = 1 / first * Mat3::Identity();
    }
    body.aligned = body.mass.inertia == Mat3(body.mass.inertia.diagonal().asDiagonal()) &&
                   body.inverse_inertia == Mat3(body.inverse_inertia.diagonal().asDiagonal());
  }
  if (const auto* sphere = std::get_if<Sphere>(&solid)) body.roundness = sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&solid)) body.roundness = capsule->radius;
  body.turned = std::holds_alternative<Cylinder>(solid) || std::holds_alternative<Cone>(solid) ||
                std::holds_alternative<TaperedCapsule>(solid) || std::holds_alternative<Compound>(solid);
  body.radius = radius_of(solid) + (weighed ? body.radius : 0);
  require(body.radius >= smallest && (endless || body.radius <= largest),
          "a shape must measure 1e-30 m to 1e30 m, but this one reaches " + number_text(body.radius) +
              " m from its center");
}

}  // namespace tweenfall::state
