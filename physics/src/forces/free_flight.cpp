#include "forces/free_flight.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tweenfall::forces {

using state::Body;

namespace {

/// Inverse of the derivative of the exponential, for rotation vectors in world axes, cut after the second bracket.
/// Beyond a radian the series says nothing: then the plain midpoint is left, which turns by no more than the spin can.
Vec3 inverse_derivative(const Vec3& turn, const Vec3& angular) {
  if (turn.squaredNorm() > 1) return angular;
  const Vec3 bracket = turn.cross(angular);
  return angular - 0.5 * bracket + turn.cross(bracket) / 12;
}

/// Turns a body with this angular momentum by the little that brings its energy to what it was. The gradient of the
/// energy over turns of the body is w x L.
void keep_energy(const Body& body, const Vec3& momentum, double energy, Spin& spin) {
  const Vec3 gradient = spin.angular.cross(momentum);
  const double off = energy - 0.5 * spin.angular.dot(momentum);
  // About a principal axis no turn changes the energy, and none is needed. What turns too fast to be followed must not
  // grow: it slows down instead.
  if (!(std::abs(off) < 1e-3 * gradient.norm())) {
    spin.angular = bounded_spin(body.world_inertia(spin.rotation), energy, spin.angular);
    return;
  }
  spin.rotation = exp_map(gradient * (off / gradient.squaredNorm())) * spin.rotation;
  spin.rotation.normalize();
  spin.angular = body.world_inverse_inertia(spin.rotation) * momentum;
}

}  // namespace

Vec3 bounded_spin(const Mat3& inertia, double most, const Vec3& angular) {
  const double energy = 0.5 * angular.dot(inertia * angular);
  return energy > most * (1 + 1e-9) ? Vec3(angular * std::sqrt(most / energy)) : angular;
}

Spin turned(const Body& body, const Spin& start, const Load& load, double dt) {
  const bool steady = load.torque == Vec3::Zero();
  if (body.spherical && steady && !(load.angular_drag > 0 || load.angular_damping > 0)) {
    Spin spin{exp_map(start.angular * dt) * start.rotation, start.angular};
    spin.rotation.normalize();
    return spin;
  }
  Vec3 momentum = body.world_inertia(start.rotation) * start.angular;
  if (load.angular_drag > 0 || load.angular_damping > 0) {
    const Mat3 inertia = body.world_inertia(start.rotation);
    const Mat3 slowed =
        (1 + dt * load.angular_damping) * inertia + Mat3(Vec3::Constant(dt * load.angular_drag).asDiagonal());
    momentum = (inertia * (slowed.inverse() * momentum)).eval();
  }
  const Vec3 first = body.world_inverse_inertia(start.rotation) * momentum;
  Spin spin{start.rotation, first};
  if (body.spherical && steady) {
    spin.rotation = exp_map(spin.angular * dt) * start.rotation;
    spin.rotation.normalize();
    return spin;
  }
  // A tenth of a radian a piece keeps the energy of a tumbling body to parts in a billion.
  const double angle =
      (first.norm() + 0.5 * dt * (body.world_inverse_inertia(start.rotation) * load.torque).norm()) * dt;
  const int pieces = static_cast<int>(std::min(64.0, std::max(1.0, std::ceil(angle / 0.1))));  // 1 for no number
  const double h = dt / pieces;
  const auto angular_at = [&](const Vec3& turn, const Vec3& at_momentum) -> Vec3 {
    const Quat rotation = exp_map(turn) * spin.rotation;
    return body.world_inverse_inertia(rotation) * at_momentum;
  };
  for (int piece = 0; piece < pieces; ++piece) {
    const Vec3 middle_momentum = momentum + 0.5 * h * load.torque;
    const Vec3 end_momentum = momentum + h * load.torque;
    const Vec3 k1 = body.world_inverse_inertia(spin.rotation) * momentum;
    const Vec3 turn2 = 0.5 * h * k1;
    const Vec3 k2 = inverse_derivative(turn2, angular_at(turn2, middle_momentum));
    const Vec3 turn3 = 0.5 * h * k2;
    const Vec3 k3 = inverse_derivative(turn3, angular_at(turn3, middle_momentum));
    const Vec3 turn4 = h * k3;
    const Vec3 k4 = inverse_derivative(turn4, angular_at(turn4, end_momentum));
    const Vec3 turn = h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    spin.rotation = exp_map(turn) * spin.rotation;
    spin.rotation.normalize();
    momentum = end_momentum;
  }
  spin.angular = body.world_inverse_inertia(spin.rotation) * momentum;
  if (steady) keep_energy(body, momentum, 0.5 * first.dot(momentum), spin);
  return spin;
}

Vec3 accelerated(const Vec3& velocity, const Load& load, Integrator integrator, double dt) {
  const Vec3 mean = integrator == Integrator::exact_quadratic ? Vec3(0.5 * (load.acceleration + load.end_acceleration))
                                                              : load.acceleration;
  Vec3 result = velocity + mean * dt;
  if (load.drag > 0) result /= 1 + load.drag * dt;
  return result;
}

void fly(Body& body, const Load& load, Integrator integrator, double dt) {
  const Vec3 before = body.twist.linear;
  body.twist.linear = accelerated(before, load, integrator, dt);
  if (integrator == Integrator::semi_implicit_euler) {
    body.center += body.twist.linear * dt;
  } else if (load.drag > 0) {
    // Implicit in the drag: the sum of all displacements is then exactly speed over drag.
    body.center += body.twist.linear * dt - load.acceleration * (0.5 * dt * dt / (1 + load.drag * dt));
  } else {
    body.center += before * dt + load.acceleration * (0.5 * dt * dt);
  }
  const Spin spin = turned(body, {body.motion.pose.rotation, body.twist.angular}, load, dt);
  body.twist.angular = spin.angular;
  body.follow_center(spin.rotation);
}

}  // namespace tweenfall::forces
