#include <tweenfall/physics/vehicle.h>

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/query.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "forces/integrators/elimination.h"
#include "state/countable.h"

namespace tweenfall {

namespace vehicles {
namespace {

/// Below this rolling speed, slip is relative to it, m/s.
constexpr double slow = 1e-3;
/// From this share of a strut's speed on that its force would take in a step, forces are those at the step's end.
constexpr double firm = 0.5;
constexpr double most = 1e30;

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}
void require_positive(double value, const char* name) {
  require(value > 0 && value <= most,
          std::string(name) + " of a wheel must be positive and at most 1e30, but is " + number_text(value));
}
void require_amount(double value, const char* name) {
  require(value >= 0 && value <= most,
          std::string(name) + " of a wheel must lie in 0 to 1e30, but is " + number_text(value));
}
bool is_place(const Vec3& v) {
  return v.cwiseAbs().maxCoeff() <= most;
}

Vec3 velocity_at(const Motion& motion, const Vec3& point) {
  return motion.twist.linear + motion.twist.angular.cross(point - motion.pose.position);
}

/// A unit direction at a point.
struct Line {
  Vec3 point, direction;
};

/// By how much a unit impulse along one line changes the velocity along another, 1/kg.
double give_of(const World& world, BodyId body, const Line& impulse, const Line& velocity) {
  if (world.is_fixed(body) || world.owner(body) == Owner::keyed) return 0;
  const MassProperties& mass = world.mass(body);
  const Pose pose = world.motion(body).pose;
  const auto lever = [&](const Line& line) -> Vec3 {
    const Vec3 arm = pose.rotation.conjugate() * (line.point - pose.position) - mass.center;
    return arm.cross(pose.rotation.conjugate() * line.direction);
  };
  return impulse.direction.dot(velocity.direction) / mass.mass +
         lever(velocity).dot(mass.inertia.inverse() * lever(impulse));
}

/// Moves a value toward 0 by at most `by`.
double slowed(double value, double by) {
  return value > 0 ? std::max(0.0, value - by) : std::min(0.0, value + by);
}

}  // namespace
}  // namespace vehicles

struct Vehicle::Stand {
  bool touches = false;
  BodyId ground;
  Vec3 point{0, 0, 0}, normal{0, 1, 0};
  double length = 0, load = 0;
  Vec3 along{1, 0, 0}, across{0, 0, 1};    ///< the wheel's heading in the ground, and to its left
  double rising = 0;                       ///< speed of the chassis against the ground along the normal, m/s
  double speed = 0, drift = 0;             ///< relative to the ground, along and across, m/s
  double give_along = 0, give_across = 0;  ///< by how much a unit impulse there changes them, 1/kg
};

Vehicle::Vehicle(VehicleSettings settings) : settings_(std::move(settings)) {
  using vehicles::require;
  require(std::abs(settings_.forward.norm() - 1) < 1e-9 && std::abs(settings_.up.norm() - 1) < 1e-9 &&
              std::abs(settings_.forward.dot(settings_.up)) < 1e-9,
          "forward and up of a vehicle must be perpendicular unit vectors");
  require(vehicles::is_place(settings_.gravity), "gravity of a vehicle must be finite and at most 1e30 m/s^2");
  require(!settings_.wheels.empty(), "a vehicle needs a wheel");
  for (const WheelSettings& wheel : settings_.wheels) {
    require(vehicles::is_place(wheel.mount), "the mount of a wheel must be finite and at most 1e30 m");
    vehicles::require_positive(wheel.radius, "radius");
    vehicles::require_positive(wheel.rest_length, "rest length");
    vehicles::require_positive(wheel.stiffness, "stiffness");
    vehicles::require_amount(wheel.damping, "damping");
    vehicles::require_positive(wheel.moment, "moment");
    vehicles::require_amount(wheel.grip, "grip");
    vehicles::require_amount(wheel.side_grip, "side grip");
    vehicles::require_positive(wheel.sharpness, "sharpness");
  }
  controls_.resize(settings_.wheels.size());
  readings_.resize(settings_.wheels.size());
  for (std::size_t i = 0; i < readings_.size(); ++i) readings_[i].length = settings_.wheels[i].rest_length;
}

void Vehicle::control(std::size_t wheel, const WheelControl& control) {
  vehicles::require(wheel < controls_.size(), "there is no wheel number " + std::to_string(wheel));
  vehicles::require(std::abs(control.torque) <= vehicles::most && std::abs(control.steer) <= vehicles::most,
                    "torque and steer of a wheel must be finite and at most 1e30");
  vehicles::require_amount(control.brake, "brake");
  controls_[wheel] = control;
}

void Vehicle::restore(std::vector<WheelReading> readings) {
  vehicles::require(readings.size() == readings_.size(), "a vehicle needs one reading per wheel");
  for (const WheelReading& reading : readings)
    for (const double number : {reading.length, reading.spin, reading.angle, reading.load, reading.slip, reading.steer})
      vehicles::require(std::isfinite(number), "readings of a wheel must be finite");
  readings_ = std::move(readings);
}

Pose wheel_pose(const VehicleSettings& settings, std::size_t wheel, const WheelReading& reading, const Pose& chassis) {
  const Vec3 left = settings.up.cross(settings.forward);
  Mat3 axes;
  axes.col(0) = settings.forward;
  axes.col(1) = left;
  axes.col(2) = settings.forward.cross(left);
  const auto turned = [](const Vec3& axis, double angle) { return exp_map(axis * angle); };
  const Quat rotation =
      chassis.rotation * turned(settings.up, reading.steer) * turned(left, reading.angle) * Quat(axes);
  const Vec3 hub = settings.wheels.at(wheel).mount - reading.length * settings.up;
  return {chassis.position + chassis.rotation * hub, rotation.normalized(), Vec3(1, 1, 1)};
}

Vehicle::Stand Vehicle::find_stand(const World& world, const Motion& chassis, std::size_t wheel) const {
  const WheelSettings& its = settings_.wheels[wheel];
  const Quat& rotation = chassis.pose.rotation;
  const Vec3 up = rotation * settings_.up, mount = chassis.pose.position + rotation * its.mount;
  Stand stand;
  QueryFilter filter;
  filter.groups = world.collides_with(settings_.chassis);
  filter.accept = [&](BodyId body) { return body != settings_.chassis; };
  const auto hit = cast_ray(world, mount, -up, its.rest_length + its.radius, filter);
  stand.length = its.rest_length;
  // Ground that the strut would be inside of, or that faces the other way, holds nothing.
  if (!hit || hit->inside || !(hit->normal.dot(up) > 0.1)) return stand;
  stand.ground = hit->body;
  stand.point = hit->point;
  stand.normal = hit->normal;
  stand.length = std::max(0.0, hit->distance - its.radius);
  const Vec3 velocity =
      vehicles::velocity_at(chassis, stand.point) - vehicles::velocity_at(world.motion(stand.ground), stand.point);
  stand.load = its.stiffness * (its.rest_length - stand.length) - its.damping * velocity.dot(stand.normal);
  if (!(stand.load > 0)) return stand;
  stand.touches = true;
  const elementary::SinCos steer = elementary::sin_cos(controls_[wheel].steer);
  const Vec3 left = settings_.up.cross(settings_.forward);
  const Vec3 heading = rotation * (steer.cos * settings_.forward + steer.sin * left);
  stand.along = (heading - heading.dot(stand.normal) * stand.normal).normalized();
  stand.across = stand.normal.cross(stand.along);
  stand.speed = velocity.dot(stand.along);
  stand.drift = velocity.dot(stand.across);
  const auto give = [&](const Vec3& direction) {
    const vehicles::Line line{stand.point, direction};
    return vehicles::give_of(world, settings_.chassis, line, line) + vehicles::give_of(world, stand.ground, line, line);
  };
  stand.rising = velocity.dot(stand.normal);
  stand.give_along = give(stand.along);
  stand.give_across = give(stand.across);
  return stand;
}

/// The forces of struts so stiff for the step, or damped so little, that those of its start would throw the chassis
/// off: k x - c v with the compression and the speed that they all leave at its end. At rest that changes nothing.
/// Source: backward Euler, Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.3.
void Vehicle::press_at_end(const World& world, std::vector<Stand>& stands, double dt) const {
  const auto line_of = [&](std::size_t i) { return vehicles::Line{stands[i].point, stands[i].normal}; };
  const auto give = [&](std::size_t from, std::size_t to) {
    const double own = vehicles::give_of(world, settings_.chassis, line_of(from), line_of(to));
    return from == to ? own + vehicles::give_of(world, stands[to].ground, line_of(to), line_of(to)) : own;
  };
  const auto firmness = [&](std::size_t i) { return settings_.wheels[i].damping + dt * settings_.wheels[i].stiffness; };
  thread_local std::vector<std::size_t> pressing;
  pressing.clear();
  for (std::size_t i = 0; i < stands.size(); ++i)
    if (stands[i].touches) pressing.push_back(i);
  // A force that is held for the step pushes as if the strut were damped by k dt / 2 less than it is.
  const auto gains = [&](std::size_t i) {
    return settings_.wheels[i].damping < 0.5 * dt * settings_.wheels[i].stiffness ||
           dt * firmness(i) * give(i, i) > vehicles::firm;
  };
  if (std::ranges::none_of(pressing, gains)) return;
  const bool falls = !world.is_fixed(settings_.chassis) && world.owner(settings_.chassis) != Owner::keyed;
  while (!pressing.empty()) {
    thread_local forces::Elimination effects;
    thread_local std::vector<double> loads;
    effects.entries.clear();
    loads.clear();
    for (const std::size_t i : pressing) {
      const WheelSettings& its = settings_.wheels[i];
      const double fallen = falls ? dt * settings_.gravity.dot(stands[i].normal) : 0;
      loads.push_back(its.stiffness * (its.rest_length - stands[i].length) - firmness(i) * (stands[i].rising + fallen));
      for (const std::size_t from : pressing)
        effects.entries.push_back((from == i ? 1 : 0) + dt * firmness(i) * give(from, i));
    }
    effects.factor(pressing.size());
    effects.solve(loads);
    const auto least = std::ranges::min_element(loads) - loads.begin();
    if (loads[static_cast<std::size_t>(least)] > 0) {
      for (std::size_t k = 0; k < pressing.size(); ++k) stands[pressing[k]].load = loads[k];
      return;
    }
    // A strut does not pull.
    stands[pressing[static_cast<std::size_t>(least)]].touches = false;
    pressing.erase(pressing.begin() + least);
  }
}

/// The tire's force, and the wheel's spin.
/// @param share  this wheel's part of the load of all wheels @param borne  its part of the chassis' mass, kg
Vec3 Vehicle::grip(const Stand& stand, double share, double borne, std::size_t wheel, double dt) {
  const WheelSettings& its = settings_.wheels[wheel];
  const WheelControl& control = controls_[wheel];
  WheelReading& reading = readings_[wheel];
  const double turn = dt / its.moment;
  double spin = reading.spin + turn * control.torque;
  const double braked = vehicles::slowed(spin, turn * control.brake);
  // What is left of the brake's torque also holds against the ground's torque.
  const double left = turn * control.brake - std::abs(spin - braked);
  spin = braked;
  Vec3 force = Vec3::Zero();
  if (stand.touches) {
    // The slip that gravity would add meanwhile has to be held, too.
    const double fall = dt * settings_.gravity.dot(stand.along), side_fall = dt * settings_.gravity.dot(stand.across);
    const double own_slip = stand.speed - spin * its.radius, slip = own_slip + fall, drift = stand.drift + side_fall;
    const double size = std::hypot(slip, drift), rolling = std::max(vehicles::slow, std::abs(spin) * its.radius);
    reading.slip = size / rolling;
    const double rise = its.sharpness * reading.slip;
    // sin(atan(x))
    const double part = std::isfinite(rise * rise) ? rise / std::sqrt(1 + rise * rise) : 1;
    const bool locked = left > 0 && spin == 0;
    // Gravity pulls at the whole mass; a push so far below the center of mass tilts it, and moves it less.
    const double turns = locked ? 0 : its.radius * its.radius / its.moment;
    const auto mass = [turns](double give) { return 1 / (give + turns); };
    // A chassis led by scripts over led ground does not yield; if it does not slip, it needs no force.
    const auto ending = [](double slip_of_it, double by_mass) { return slip_of_it == 0 ? 0 : by_mass * slip_of_it; };
    double along = -(ending(own_slip, mass(stand.give_along / share)) + mass(1 / borne) * fall) / dt;
    double across = -(ending(stand.drift, share / stand.give_across) + borne * side_fall) / dt;
    // Within the ellipse of its grip.
    const double most_along = its.grip * stand.load * part, most_across = its.side_grip * stand.load * part;
    const double beyond =
        std::hypot(most_along > 0 ? along / most_along : 0, most_across > 0 ? across / most_across : 0);
    if (most_along == 0) along = 0;
    if (most_across == 0) across = 0;
    if (beyond > 1 && size > 0) {
      along = -most_along * slip / size;
      across = -most_across * drift / size;
    }
    force = along * stand.along + across * stand.across;
    const double before = spin;
    spin -= turn * its.radius * along;
    spin = locked && before == 0 ? vehicles::slowed(spin, left) : spin;
  }
  reading.spin = spin;
  reading.angle += spin * dt;
  return force;
}

void Vehicle::act(World& world, double dt) {
  // Put together only for those who read it: it takes memory.
  if (!(dt > 0 && dt <= vehicles::most))
    throw std::invalid_argument("the length of a step must be positive and finite, but is " + number_text(dt) + " s");
  const Motion chassis = world.motion(settings_.chassis);
  thread_local std::vector<Stand> stands;
  stands.clear();
  for (std::size_t i = 0; i < readings_.size(); ++i) stands.push_back(find_stand(world, chassis, i));
  press_at_end(world, stands, dt);
  double loads = 0;
  for (const Stand& stand : stands) loads += stand.touches ? stand.load : 0;
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    const Stand& stand = stands[i];
    WheelReading& reading = readings_[i];
    reading.touches = stand.touches;
    reading.length = stand.length;
    reading.steer = controls_[i].steer;
    const double share = stand.touches ? stand.load / loads : 0;
    const Vec3 tyre = grip(stand, share, share * world.mass(settings_.chassis).mass, i, dt);
    if (!stand.touches) {
      reading.load = 0;
      reading.force = Vec3::Zero();
      continue;
    }
    reading.load = stand.load;
    reading.point = stand.point;
    reading.force = stand.load * stand.normal + tyre;
    if (!state::countable(reading.force))
      throw NotFinite(
          settings_.chassis, world.time() + dt,
          "one of its wheels is pressed with " + number_text(stand.load) + " N; a body bears at most 1e30 N");
    world.apply_force(settings_.chassis, reading.force, stand.point);
    if (!world.is_fixed(stand.ground)) world.apply_force(stand.ground, -reading.force, stand.point);
  }
}

}  // namespace tweenfall
