#include "actors/soft/meetings/partners.h"

#include <tweenfall/curves/hermite.h>
#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>

#include "flat/axes.h"

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

/// A step takes drag as it is at its end, and so has kept only a part of what accelerated the body. The same part of
/// what soft bodies give remains: it is as if the body had that much more mass.
void resist(const forces::Load& load, double dt, Partner& partner) {
  if (load.drag > 0) {
    partner.mass *= 1 + dt * load.drag;
    partner.inverse_mass = 1 / partner.mass;
  }
  if (load.angular_drag > 0 || load.angular_damping > 0) {
    partner.inertia =
        (1 + dt * load.angular_damping) * partner.inertia + Mat3(Vec3::Constant(dt * load.angular_drag).asDiagonal());
    partner.inverse_inertia = partner.inertia.inverse();
  }
}

}  // namespace

std::uint32_t Partners::number_of(std::uint32_t index) {
  numbers_.resize(bodies_.size(), 0);
  if (numbers_[index] != 0) return numbers_[index] - 1;
  const state::Body& body = bodies_[index];
  Partner partner;
  partner.body = index;
  partner.start = starts_[index];
  partner.end = {body.center, body.motion.pose.rotation, body.twist};
  if (!body.immovable() && !body.sensor()) {
    partner.mass = body.mass().mass;
    partner.inverse_mass = 1 / partner.mass;
    partner.inertia = body.world_inertia(body.motion.pose.rotation);
    partner.inverse_inertia = body.world_inverse_inertia(body.motion.pose.rotation);
    if (plane_ != WorldPlane::none) {
      // In a planar world, everything turns it about the normal alone.
      const int normal = flat::Axes::of(plane_).normal;
      const double moment = body.mass().inertia(normal, normal);
      partner.inertia = moment * Mat3::Identity();
      partner.inverse_inertia = (1 / moment) * Mat3::Identity();
    } else {
      resist(loads_[index], dt_, partner);
    }
    const Vec3 mean = 0.5 * (partner.start.twist.linear + partner.end.twist.linear);
    const Vec3 off = partner.end.center - partner.start.center - dt_ * mean;
    const double gained = dt_ * (partner.end.twist.linear - partner.start.twist.linear).norm();
    partner.along_parabola = off.norm() <= 1e-9 + 0.01 * gained;
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

std::vector<Gift> Partners::given() const {
  std::vector<Gift> gifts;
  for (const Partner& partner : all_) gifts.push_back({partner.moved, partner.turned, partner.taken});
  return gifts;
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

void Partners::finish(double h) {
  for (const Partner& partner : all_) {
    if (partner.taken == Vec3::Zero()) continue;
    state::Body& body = bodies_[partner.body];
    if (!partner.moves()) {
      if (body.immovable()) body.extra.own().reaction += partner.taken;
      continue;
    }
    // As for free motion, half of the last sub-step's gain belongs to the time before it.
    body.center = partner.end.center + partner.shift - 0.5 * h * partner.push;
    body.twist.linear += partner.push;
    body.twist.angular += partner.spin;
    Quat rotation = exp_map(partner.turn - 0.5 * h * partner.spin) * partner.end.rotation;
    rotation.normalize();
    body.follow_center(rotation);
    body.asleep = false;
    body.still_for = 0;
  }
}

}  // namespace tweenfall::soft
