#include "forces/free_flight.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "shapes/turn_onto.h"

namespace tweenfall::forces {

using state::Body;

namespace {

/// Inverse of the derivative of the exponential, for rotation vectors in the body's axes, cut after the second bracket.
/// Beyond a radian the series is useless: then the plain midpoint remains, which turns by no more than the spin can.
Vec3 inverse_derivative(const Vec3& turn, const Vec3& angular) {
  if (turn.squaredNorm() > 1) return angular;
  const Vec3 bracket = turn.cross(angular);
  return angular + 0.5 * bracket + turn.cross(bracket) / 12;
}

/// A turning body in its own axes: there, the momentum about the axis of a needle changes by the difference of its
/// other moments, and not by errors of where the needle points.
struct Tumble {
  Vec3 momentum;
  Vec3 turn;  ///< since the start of a piece
};

class Tumbling {
 public:
  Tumbling(const Body& body, const Vec3& torque) : body_(body), torque_(torque), steady_(torque == Vec3::Zero()) {}

  [[nodiscard]] Vec3 angular(const Vec3& momentum) const { return body_.inverse_inertia() * momentum; }

  /// Through `h` seconds, starting from a rotation.
  [[nodiscard]] Tumble through(double h, const Quat& rotation, const Vec3& momentum) const {
    const Tumble start{momentum, Vec3::Zero()};
    const Vec3 even = h * angular(momentum);
    // Beyond a radian no series gives the path: the body keeps turning at the same rate, which makes nothing longer.
    if (!(even.squaredNorm() < 1)) return {exp_map(-even) * momentum + h * pushed(rotation), even};
    const Tumble k1 = rate(rotation, start), k2 = rate(rotation, after(start, 0.5 * h, k1));
    const Tumble k3 = rate(rotation, after(start, 0.5 * h, k2)), k4 = rate(rotation, after(start, h, k3));
    return {momentum + h / 6 * (k1.momentum + 2 * (k2.momentum + k3.momentum) + k4.momentum),
            h / 6 * (k1.turn + 2 * (k2.turn + k3.turn) + k4.turn)};
  }

 private:
  [[nodiscard]] Tumble rate(const Quat& rotation, const Tumble& at) const {
    const Vec3 w = angular(at.momentum), turning = at.momentum.cross(w);
    return {steady_ ? turning : Vec3(turning + pushed(rotation * exp_map(at.turn))), inverse_derivative(at.turn, w)};
  }
  [[nodiscard]] Vec3 pushed(const Quat& rotation) const { return rotation.conjugate() * torque_; }
  [[nodiscard]] static Tumble after(const Tumble& start, double h, const Tumble& rate) {
    return {start.momentum + h * rate.momentum, start.turn + h * rate.turn};
  }

  const Body& body_;
  const Vec3& torque_;
  bool steady_;
};

/// Greatest number of pieces of a turn that is followed.
constexpr double most_pieces = 64;

/// Square of the sine of the angle between a spin and its momentum that is mere rounding: the body spins about a
/// principal axis, and keeps it even if it is the middle one, about which rounding would grow into a tumble.
constexpr double aligned = 1e-26;

/// A momentum, reduced so that its energy is at most `energy`.
Vec3 within_energy(const Tumbling& tumbling, double energy, const Vec3& momentum) {
  const double now = 0.5 * tumbling.angular(momentum).dot(momentum);
  return now > energy * (1 + 1e-9) ? Vec3(momentum * std::sqrt(energy / now)) : momentum;
}

/// Turns a momentum in the body's axes by the small angle that restores its energy. The gradient of the energy
/// over such turns is L x w.
Vec3 with_energy(const Tumbling& tumbling, double energy, const Vec3& momentum) {
  const Vec3 angular = tumbling.angular(momentum);
  const Vec3 gradient = momentum.cross(angular);
  const double off = energy - 0.5 * angular.dot(momentum);
  if (std::abs(off) < 1e-3 * gradient.norm()) return exp_map(gradient * (off / gradient.squaredNorm())) * momentum;
  // About a principal axis no turn changes the energy, and none is needed. A body that turns too fast to be followed
  // must not gain energy: it slows down instead.
  return within_energy(tumbling, energy, momentum);
}

/// A top without torque: it spins about its axis, which goes around the momentum evenly.
/// Source: Goldstein, Poole, Safko, Classical Mechanics, 2002, section 5.6.
Spin turned_top(const Body& body, int axis, const Quat& rotation, const Vec3& momentum, double dt) {
  const Mat3& inertia = body.mass().inertia;
  const double along = inertia(axis, axis), across = inertia((axis + 1) % 3, (axis + 1) % 3);
  const Vec3 kept = rotation * momentum;  // in the world's axes
  const double spin = momentum[axis] / along - momentum[axis] / across;
  Spin result;
  result.rotation = exp_map(kept * (dt / across)) * rotation * exp_map(Vec3::Unit(axis) * (spin * dt));
  result.rotation.normalize();
  result.angular = result.rotation * Vec3(body.inverse_inertia() * (result.rotation.conjugate() * kept));
  return result;
}

}  // namespace

std::optional<int> axis_of_top(const Mat3& inertia) {
  if (inertia(0, 1) != 0 || inertia(0, 2) != 0 || inertia(1, 2) != 0) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis)
    if (inertia((axis + 1) % 3, (axis + 1) % 3) == inertia((axis + 2) % 3, (axis + 2) % 3)) return axis;
  return std::nullopt;
}

Vec3 spin_of_top(const Mat3& inertia, int axis, const Vec3& angular, double dt) {
  const double along = inertia(axis, axis), across = inertia((axis + 1) % 3, (axis + 1) % 3);
  return exp_map(Vec3::Unit(axis) * ((along / across - 1) * angular[axis] * dt)) * angular;
}

Vec3 bounded_spin(const Mat3& inertia, double most, const Vec3& angular) {
  const double energy = 0.5 * angular.dot(inertia * angular);
  return energy > most * (1 + 1e-9) ? Vec3(angular * std::sqrt(most / energy)) : angular;
}

Spin turned(const Body& body, const Spin& start, const Load& load, double dt) {
  const bool steady = load.torque == Vec3::Zero();
  if (body.spherical() && steady && !(load.angular_drag > 0 || load.angular_damping > 0)) {
    Spin spin{exp_map(start.angular * dt) * start.rotation, start.angular};
    spin.rotation.normalize();
    return spin;
  }
  const Mat3& inertia = body.mass().inertia;
  Vec3 momentum = inertia * (start.rotation.conjugate() * start.angular);  // in the body's axes, as all until its end
  if (load.angular_drag > 0 || load.angular_damping > 0) {
    const Mat3 slowed =
        (1 + dt * load.angular_damping) * inertia + Mat3(Vec3::Constant(dt * load.angular_drag).asDiagonal());
    momentum = (inertia * (slowed.inverse() * momentum)).eval();
  }
  const Tumbling tumbling(body, load.torque);
  const Vec3 first = tumbling.angular(momentum);
  if (body.spherical() && steady) {
    Spin spin{start.rotation, start.rotation * first};
    spin.rotation = exp_map(spin.angular * dt) * start.rotation;
    spin.rotation.normalize();
    return spin;
  }
  if (steady && momentum.cross(first).squaredNorm() <= aligned * momentum.squaredNorm() * first.squaredNorm()) {
    const double size = start.angular.norm();
    Spin spin{start.rotation, size > 0 ? Vec3(first.norm() / size * start.angular) : start.angular};
    spin.rotation = exp_map(spin.angular * dt) * start.rotation;
    spin.rotation.normalize();
    return spin;
  }
  if (steady)
    if (const std::optional<int> axis = axis_of_top(body.mass().inertia))
      return turned_top(body, *axis, start.rotation, momentum, dt);
  const double energy = 0.5 * first.dot(momentum), length = momentum.norm();
  const Vec3 end_momentum = start.rotation * momentum + dt * load.torque;  // in the world's axes
  // A tenth of a radian per piece keeps the energy of a tumbling body to parts in a billion. If even the most pieces
  // would turn by more than a radian each, they are no better than one.
  const double angle =
      (first.norm() + 0.5 * dt * tumbling.angular(start.rotation.conjugate() * load.torque).norm()) * dt;
  const int pieces = angle < most_pieces ? static_cast<int>(std::clamp(std::ceil(angle / 0.1), 1.0, most_pieces)) : 1;
  Quat rotation = start.rotation;
  for (int piece = 0; piece < pieces; ++piece) {
    const Tumble tumble = tumbling.through(dt / pieces, rotation, momentum);
    momentum = tumble.momentum;
    if (steady && length > 0) momentum *= length / momentum.norm();
    rotation = rotation * exp_map(tumble.turn);
    rotation.normalize();
  }
  if (steady) momentum = with_energy(tumbling, energy, momentum);
  // The momentum in the world's axes is known, and the body is turned to match it; but if almost nothing is left of the
  // momentum, or the body turns too fast to be followed, it does not determine how the body is turned.
  const Vec3 reached = rotation * momentum;
  const double reach = reached.norm(), end = end_momentum.norm();
  if (end > 1e-3 * length && reached.dot(end_momentum) > 0.5 * reach * end) {
    rotation = shapes::turn_onto(reached, end_momentum) * rotation;
    rotation.normalize();
  } else {
    momentum = rotation.conjugate() * end_momentum;
    if (steady) momentum = within_energy(tumbling, energy, momentum);
  }
  return {rotation, rotation * tumbling.angular(momentum)};
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
    // Implicit in the drag: the sum of all displacements is then exactly speed over drag. Bodies that drift with a
    // medium drift evenly.
    const Vec3 driven = load.acceleration - load.carried;
    body.center += body.twist.linear * dt - driven * (0.5 * dt * dt / (1 + load.drag * dt));
  } else {
    body.center += before * dt + load.acceleration * (0.5 * dt * dt);
  }
  const Spin spin = turned(body, {body.motion.pose.rotation, body.twist.angular}, load, dt);
  body.twist.angular = spin.angular;
  body.follow_center(spin.rotation);
}

}  // namespace tweenfall::forces
