#include "actors/soft/meetings/partners.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/hermite.h>
#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "flat/axes.h"
#include "forces/integrators/integrators.h"

namespace tweenfall::soft {

namespace {

Vec3 turn_between(const Quat& from, const Quat& to) {
  return log_map(hemisphere_aligned(to * from.conjugate(), Quat(1, 0, 0, 0)));
}

/// Where the course has the body at a time since the start of the step. An immovable body follows the cubic of its
/// path. A movable one moves as sub-steps of backward Euler move what falls evenly: so one that soft bodies hold
/// at rest stays at rest.
Place on_course(const Partner& partner, double time, double h, double dt) {
  const Place &start = partner.start, &end = partner.end;
  const double share = time / dt;
  const Vec3 turn = turn_between(start.rotation, end.rotation);
  Place place;
  if (!partner.moves()) {
    place.center =
        hermite::sample<Vec3>(start.center, start.twist.linear, end.center, end.twist.linear, dt, share).value;
    const Vec3 rate = right_jacobian_inverse(-turn) * end.twist.angular;
    place.rotation = exp_map(hermite::sample<Vec3>(Vec3(0, 0, 0), start.twist.angular, turn, rate, dt, share).value) *
                     start.rotation;
    if (time >= dt) place = end;
    return place;
  }
  if (partner.along_parabola) {
    const Vec3 gain = (end.twist.linear - start.twist.linear) / dt;
    place.center = start.center + time * start.twist.linear + 0.5 * time * (time + h) * gain;
  } else {
    place.center = start.center + share * (end.center - start.center);
  }
  const Vec3 spin_gain = partner.along_parabola ? Vec3((end.twist.angular - start.twist.angular) / dt) : Vec3(0, 0, 0);
  place.rotation = exp_map(share * turn + 0.5 * time * h * spin_gain) * start.rotation;
  return place;
}

/// How many times as much mass a body has, where drag has left a part of what an even force gave it through a step.
/// Of what soft bodies give it drag leaves as much.
/// @param slowed  drag times the length of the step, taken by an integrator: (R(z) - 1) / z with z = -slowed, R being
///                its growth factor. Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 1996, IV.2.
double heavier(Integrator integrator, double slowed) {
  const double z = -slowed;
  double left = 1;
  switch (integrator) {
    case Integrator::explicit_euler:
      break;
    case Integrator::midpoint:
    case Integrator::trapezoid:
    case Integrator::verlet:
      left = 1 + z / 2;
      break;
    case Integrator::rk4:
      left = 1 + z / 2 * (1 + z / 3 * (1 + z / 4));
      break;
    case Integrator::implicit_trapezoid:
      return 1 - z / 2;
    case Integrator::exact_quadratic:
    case Integrator::semi_implicit_euler:
    case Integrator::backward_euler:
      return 1 - z;
  }
  // Beyond that the integrator itself makes what it should slow grow.
  constexpr double least_left = 0.1;
  return 1 / std::max(left, least_left);
}

/// The same of damping in a plane: in each of its sub-steps what there is then, with what came in it, fades.
double heavier_in_plane(double damping, int sub_steps, double dt) {
  if (!(damping > 0)) return 1;
  double left = 0;
  for (int i = 1; i <= sub_steps; ++i) left += elementary::exp(-damping * dt * i / sub_steps) / sub_steps;
  return 1 / std::max(left, 1e-9);
}

void resist(const forces::Load& load, Integrator integrator, double angular_damping, double dt, Partner& partner) {
  const bool asks = forces::asking(integrator) != nullptr;
  if (const double drag = asks ? load.met_drag : load.drag; drag > 0) {
    partner.mass *= heavier(integrator, dt * drag);
    partner.inverse_mass = 1 / partner.mass;
  }
  const double angular_drag = asks ? load.met_angular_drag : load.angular_drag;
  if (!(angular_drag > 0 || angular_damping > 0)) return;
  const double mean = 3 / partner.inverse_inertia.trace(), rate = angular_damping + angular_drag / mean;
  // Of what turns, each axis has a drag of its own: the share of the integrator is that of the mean one.
  const double share = asks ? (heavier(integrator, dt * rate) - 1) / (dt * rate) : 1;
  partner.inertia = (1 + share * dt * angular_damping) * partner.inertia +
                    Mat3(Vec3::Constant(share * dt * angular_drag).asDiagonal());
  partner.inverse_inertia = partner.inertia.inverse();
}

}  // namespace

void Partners::begin(std::vector<state::Body>& bodies, const std::vector<Place>& starts,
                     const std::vector<forces::Load>& loads, const WorldSettings& settings, int sub_steps, double dt) {
  bodies_ = &bodies;
  starts_ = &starts;
  loads_ = &loads;
  plane_ = settings.plane;
  integrator_ = settings.integrator;
  sub_steps_ = sub_steps;
  dt_ = dt;
  all_.clear();
  numbers_.assign(bodies.size(), 0);
}

std::uint32_t Partners::number_of(std::uint32_t index) {
  if (numbers_[index] != 0) return numbers_[index] - 1;
  const state::Body& body = (*bodies_)[index];
  Partner partner;
  partner.body = index;
  partner.start = (*starts_)[index];
  partner.end = {body.center, body.motion.pose.rotation, body.twist};
  if (!body.immovable() && !body.sensor()) {
    partner.mass = body.mass().mass;
    partner.inverse_mass = 1 / partner.mass;
    partner.inertia = body.world_inertia(body.motion.pose.rotation);
    partner.inverse_inertia = body.world_inverse_inertia(body.motion.pose.rotation);
    if (plane_ != WorldPlane::none) {
      // In a planar world, everything turns it about the normal alone.
      const int normal = flat::Axes::of(plane_).normal;
      const double damping = body.makeup->linear_damping;
      const double drag = std::max(0.0, (*loads_)[index].drag - damping);
      partner.mass *= (1 + dt_ * drag) * heavier_in_plane(damping, sub_steps_, dt_);
      partner.inverse_mass = 1 / partner.mass;
      const double moment =
          body.mass().inertia(normal, normal) * heavier_in_plane(body.makeup->angular_damping, sub_steps_, dt_);
      partner.inertia = moment * Mat3::Identity();
      partner.inverse_inertia = (1 / moment) * Mat3::Identity();
    } else {
      resist((*loads_)[index], integrator_, body.makeup->angular_damping, dt_, partner);
    }
    const Vec3 mean = 0.5 * (partner.start.twist.linear + partner.end.twist.linear);
    const Vec3 off = partner.end.center - partner.start.center - dt_ * mean;
    const double gained = dt_ * (partner.end.twist.linear - partner.start.twist.linear).norm();
    partner.along_parabola = off.norm() <= 1e-9 + 0.01 * gained;
    if (!partner.along_parabola && gained > 0 &&
        (plane_ != WorldPlane::none || integrator_ != Integrator::exact_quadratic)) {
      // So much drag may make of it; a blow makes more, or something aside.
      constexpr double little = 0.25;
      const Vec3 gain = partner.end.twist.linear - partner.start.twist.linear;
      const double ahead = off.dot(gain) / gain.squaredNorm();
      partner.along_parabola = std::abs(ahead) <= little * dt_ && (off - ahead * gain).norm() <= 1e-9 + 0.01 * gained;
    }
  }
  partner.now = partner.start;
  all_.push_back(partner);
  numbers_[index] = static_cast<std::uint32_t>(all_.size());
  return numbers_[index] - 1;
}

void Partners::go_to(double time, double h) {
  for (Partner& partner : all_) {
    partner.before = partner.now;
    partner.now = on_course(partner, time, h, dt_);
    partner.moved = partner.turned = Vec3(0, 0, 0);
    partner.givers = 0;
    if (!partner.moves()) continue;
    partner.now.center += partner.shift + h * partner.push;
    partner.now.rotation = exp_map(partner.turn + h * partner.spin) * partner.now.rotation;
  }
}

void Partners::tell_given(std::vector<Gift>& gifts) const {
  gifts.clear();
  for (const Partner& partner : all_) gifts.push_back({partner.moved, partner.turned, partner.taken});
}

void Partners::take_back(const std::vector<Gift>& gifts) {
  for (std::size_t i = 0; i < gifts.size(); ++i) {
    all_[i].moved -= gifts[i].moved;
    all_[i].turned -= gifts[i].turned;
    all_[i].taken -= gifts[i].taken;
  }
}

void Partners::accept(double h) {
  for (Partner& partner : all_) {
    if (!partner.moves()) continue;
    partner.push += partner.moved / h;
    partner.spin += partner.turned / h;
    partner.shift += h * partner.push;
    partner.turn += h * partner.spin;
    partner.now.center += partner.moved;
    partner.now.rotation = exp_map(partner.turned) * partner.now.rotation;
  }
}

void Partners::finish() {
  for (const Partner& partner : all_) {
    if (partner.taken == Vec3::Zero()) continue;
    state::Body& body = (*bodies_)[partner.body];
    if (!partner.moves()) {
      if (body.immovable()) body.extra.own().reaction += partner.taken;
      continue;
    }
    // It stays where the last sub-step left it, beside the nodes that it touched: farther on, it would be in them, and
    // be lifted out.
    body.center = partner.now.center;
    body.twist.linear += partner.push;
    body.twist.angular += partner.spin;
    Quat rotation = partner.now.rotation;
    rotation.normalize();
    body.follow_center(rotation);
    body.asleep = false;
    body.still_for = 0;
  }
}

}  // namespace tweenfall::soft
