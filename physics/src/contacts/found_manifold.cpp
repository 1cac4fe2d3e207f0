#include "contacts/found_manifold.h"

#include <algorithm>
#include <cmath>

#include "step/workspace.h"

namespace tweenfall::contacts {

using state::Body;
using state::FoundManifold;

namespace {

/// Parts of the smaller body's radius by which the bodies may have moved against each other.
constexpr double hardly = 2e-3;
/// And at most this, m: points that come near are found before they touch.
constexpr double unnoticed = 1e-3;

}  // namespace

bool keeps_manifold(const ContactConstraint& contact) {
  bool flat = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i)
    flat = flat && contact.points[i].skin_a == 0 && contact.points[i].skin_b == 0;
  return flat;
}

FoundManifold found_manifold(const ContactConstraint& contact, const step::Start& a, const step::Start& b) {
  FoundManifold found;
  const Quat back_a = a.rotation.conjugate();
  const Quat back_b = b.rotation.conjugate();
  found.holds = true;
  found.turn = back_a * b.rotation;
  found.between = back_a * Vec3(b.center - a.center);
  found.normal = back_a * contact.manifold.normal;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    const PointConstraint& point = contact.points[i];
    found.points[i] = {back_a * point.start_arm_a, back_b * point.start_arm_b, point.start_gap};
  }
  return found;
}

bool take_up(const state::ContactMemory& memory, const Body& a, const Body& b, double swing, double dt,
             ContactConstraint& contact) {
  const FoundManifold& found = memory.found();
  if (!found.holds || !memory.touching || a.placed || b.placed) return false;
  const double size = std::min(a.radius(), b.radius());
  const Quat& rotation_a = a.motion.pose.rotation;
  const Quat& rotation_b = b.motion.pose.rotation;
  const Vec3 between = rotation_a.conjugate() * Vec3(b.center - a.center);
  const double turn = 2 * (found.turn.conjugate() * (rotation_a.conjugate() * rotation_b)).vec().norm();
  if ((between - found.between).norm() + turn * size + swing * dt > std::min(hardly * size, unnoticed)) return false;
  const Mat3 axes_a = rotation_a.toRotationMatrix(), axes_b = rotation_b.toRotationMatrix();
  contact.manifold = {};
  contact.manifold.normal = axes_a * found.normal;
  contact.manifold.count = contact.count = memory.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(memory.count); ++i) {
    PointConstraint& point = contact.points[i];
    point = {};
    point.feature = memory.point(i).feature;
    point.start_arm_a = axes_a * found.points[i].anchor_a;
    point.start_arm_b = axes_b * found.points[i].anchor_b;
    const Vec3 apart = (b.center + point.start_arm_b) - (a.center + point.start_arm_a);
    point.start_gap = found.points[i].gap + contact.manifold.normal.dot(apart);
    contact.manifold.points[i] = {a.center + point.start_arm_a + 0.5 * apart, -point.start_gap, point.feature};
  }
  return true;
}

}  // namespace tweenfall::contacts
