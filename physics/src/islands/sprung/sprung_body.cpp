#include "islands/sprung/sprung_body.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/mass_properties.h>

#include <cmath>

namespace tweenfall::sprung {

namespace {

/// A turn by a small angle about an axis of the body, right to its fifth power.
Quat small_turn(int axis, double angle) {
  const double half = 0.5 * angle;
  const double tangent = half * (1 + half * half / 3);
  const double cosine = 1 / std::sqrt(1 + tangent * tangent);
  Quat turn(cosine, 0, 0, 0);
  turn.vec()[axis] = cosine * tangent;
  return turn;
}

/// The momentum in the axes of a body that has turned about one of them.
void turn_back(int axis, const Quat& turn, Vec3& momentum) {
  const double sine = 2 * turn.w() * turn.vec()[axis], cosine = 1 - 2 * turn.vec()[axis] * turn.vec()[axis];
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  const double along = momentum[next];
  momentum[next] = cosine * along + sine * momentum[last];
  momentum[last] = cosine * momentum[last] - sine * along;
}

}  // namespace

SprungBody SprungBody::of(const state::Body& body, std::uint32_t index, double dt) {
  SprungBody result;
  result.index = index;
  result.movable = !body.immovable() && !body.asleep;
  result.center = body.center;
  result.rotation = body.motion.pose.rotation;
  if (!result.movable) {
    if (body.immovable()) result.course = step::keyed_course(body, dt);
    result.led = !result.course.still();
    return result;
  }
  result.spherical = body.spherical();
  result.moments = body.mass().inertia.diagonal();
  if (!body.aligned() && !body.spherical()) {
    const PrincipalAxes principal = principal_axes(body.mass());
    result.moments = principal.moments;
    result.axes = principal.orientation;
    result.rotation = result.rotation * result.axes;
  }
  result.inverse_mass = 1 / body.mass().mass;
  for (int i = 0; i < 3; ++i) result.inverse_moments[i] = result.moments[i] > 0 ? 1 / result.moments[i] : 0;
  result.linear = body.twist.linear;
  const Vec3 own = result.rotation.conjugate() * body.twist.angular;
  result.momentum = result.rotation * Vec3(result.moments.cwiseProduct(own));
  return result;
}

Vec3 SprungBody::spin() const {
  return movable ? turned_by(momentum) : angular;
}

Vec3 SprungBody::turned_by(const Vec3& angular_impulse) const {
  if (spherical) return inverse_moments[0] * angular_impulse;
  return rotation * Vec3(inverse_moments.cwiseProduct(rotation.conjugate() * angular_impulse));
}

void SprungBody::push(const Vec3& impulse, const Vec3& arm) {
  if (!movable) return;
  linear += inverse_mass * impulse;
  momentum += arm.cross(impulse);
}

void SprungBody::load(double h) {
  if (!movable) return;
  linear = (linear + h * acceleration) / (1 + h * drag);
  if (torque != Vec3::Zero()) momentum += h * torque;
  if (!(angular_drag > 0 || angular_damping > 0)) return;
  Vec3 own = rotation.conjugate() * momentum;
  for (int i = 0; i < 3; ++i)
    if (moments[i] > 0) own[i] *= moments[i] / ((1 + h * angular_damping) * moments[i] + h * angular_drag);
  momentum = rotation * own;
}

void SprungBody::fly(double h) {
  if (!movable) return;
  center += h * linear;
  if (momentum == Vec3::Zero()) return;
  if (spherical) {
    rotation = exp_map(h * inverse_moments[0] * momentum) * rotation;
    rotation.normalize();
    return;
  }
  Vec3 own = rotation.conjugate() * momentum;
  constexpr int order[] = {0, 1, 2, 1, 0};
  for (int i = 0; i < 5; ++i) {
    const int axis = order[i];
    const Quat turn = small_turn(axis, (i == 2 ? h : 0.5 * h) * own[axis] * inverse_moments[axis]);
    turn_back(axis, turn, own);
    rotation = rotation * turn;
  }
  rotation.normalize();
}

void SprungBody::put_back(state::Body& body) const {
  body.center = center + Vec3::Zero();
  body.twist = {linear + Vec3::Zero(), spin() + Vec3::Zero()};
  Quat node = rotation * axes.conjugate();
  node.normalize();
  node.coeffs() = node.coeffs() + Vec4::Zero();
  body.follow_center(node);
}

}  // namespace tweenfall::sprung
