#include "strategies/gathering.h"

#include <algorithm>

namespace tweenfall::strategies {

double Gathering::parting(const Touch& touch) const {
  const Party &a = parties[touch.a], &b = parties[touch.b];
  return touch.normal.dot(b.linear + b.angular.cross(touch.arm_b) - a.linear - a.angular.cross(touch.arm_a));
}

Vec3 Gathering::slip(const Touch& touch) const {
  const Party &a = parties[touch.a], &b = parties[touch.b];
  const Vec3 moving = b.linear + b.angular.cross(touch.arm_b) - a.linear - a.angular.cross(touch.arm_a);
  return moving - touch.normal * touch.normal.dot(moving);
}

double Gathering::ease(const Touch& touch, const Vec3& direction) const {
  const Party &a = parties[touch.a], &b = parties[touch.b];
  const Vec3 turn_a = touch.arm_a.cross(direction), turn_b = touch.arm_b.cross(direction);
  return a.inverse_mass + b.inverse_mass + turn_a.dot(a.inverse_inertia * turn_a) +
         turn_b.dot(b.inverse_inertia * turn_b);
}

void Gathering::push(const Touch& touch, const Vec3& impulse) {
  Party &a = parties[touch.a], &b = parties[touch.b];
  a.linear -= a.inverse_mass * impulse;
  a.angular -= a.inverse_inertia * touch.arm_a.cross(impulse);
  b.linear += b.inverse_mass * impulse;
  b.angular += b.inverse_inertia * touch.arm_b.cross(impulse);
  a.touched = b.touched = true;
}

void Gathering::begin_where_it_ended() {
  for (Touch& touch : touches) {
    if (touch.kept == 0) continue;
    push(touch, (touch.kept - touch.impulse) * touch.normal);
    touch.impulse = touch.kept;
  }
}

void Gathering::press(Touch& touch) {
  const double give = ease(touch, touch.normal);
  if (!(give > 0)) return;
  const double pressed = std::max(0.0, touch.impulse + (touch.wanted - parting(touch)) / give);
  if (pressed == touch.impulse) return;
  push(touch, (pressed - touch.impulse) * touch.normal);
  touch.impulse = pressed;
}

void Gathering::rub(Touch& touch) {
  if (!(touch.friction > 0) || (touch.impulse == 0 && touch.rubbing == Vec3::Zero())) return;
  const Vec3 slipping = slip(touch);
  const double speed = slipping.norm();
  Vec3 rubbed = touch.rubbing;
  if (speed > 0) {
    const double give = ease(touch, slipping / speed);
    if (give > 0) rubbed -= slipping / give;
  }
  const double most = touch.friction * touch.impulse, length = rubbed.norm();
  if (length > most) rubbed *= most / length;
  if (rubbed == touch.rubbing) return;
  push(touch, rubbed - touch.rubbing);
  touch.rubbing = rubbed;
}

}  // namespace tweenfall::strategies
