#include "contacts/found_manifold.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::contacts {

using state::Body;
using state::ContactMemories;
using state::ContactMemory;
using state::MoreOfContact;
using state::Stand;

namespace {

/// How far the bodies may have moved relative to each other, in parts of the smaller body's radius.
constexpr double hardly = 2e-3;
/// But at most this far, m, so that approaching points are found before they touch.
constexpr double unnoticed = 1e-3;

/// A manifold that was found earlier, carried to where its bodies are now. Calls see(i, arm from a, arm from b, gap)
/// for its points.
/// @param turn_a, turn_b  how they have turned since
template <class See>
Manifold laid(const ContactMemories& memories, const ContactMemory& memory, const Mat3& turn_a, const Mat3& turn_b,
              const Vec3& center_a, const Vec3& center_b, const See& see) {
  const MoreOfContact& then = *memories.more(memory);
  Manifold manifold;
  manifold.normal = turn_a * memory.normal;
  manifold.count = memory.count;
  for (std::size_t i = 0; i < memory.count; ++i) {
    const state::PointMemory& point = memories.point(memory, i);
    const Vec3 arm_a = turn_a * (point.position - then.a.center);
    const Vec3 arm_b = turn_b * (point.position - then.b.center);
    const Vec3 at_a = center_a + arm_a;
    const Vec3 apart = (center_b + arm_b) - at_a;
    const double gap = -point.penetration + manifold.normal.dot(apart);
    manifold.points[i] = {at_a + 0.5 * apart, -gap, memories.feature(memory, i)};
    see(i, arm_a, arm_b, gap);
  }
  return manifold;
}

}  // namespace

bool keeps_manifold(const ContactConstraint& contact) {
  bool flat = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i)
    flat = flat && contact.points[i].skin_a == 0 && contact.points[i].skin_b == 0;
  return flat;
}

bool take_up(const ContactMemories& memories, const ContactMemory& memory, const Body& a, const Body& b, double swing,
             double dt, ContactConstraint& contact) {
  if (!memory.is(ContactMemory::holds) || !memory.is(ContactMemory::touching) || a.placed || b.placed) return false;
  const MoreOfContact& then = *memories.more(memory);
  const double size = std::min(a.radius(), b.radius());
  const Quat turn_a = a.motion.pose.rotation * then.a.rotation.conjugate();
  const Quat turn_b = b.motion.pose.rotation * then.b.rotation.conjugate();
  const Mat3 axes_a = turn_a.toRotationMatrix();
  const double turn = 2 * (turn_a.conjugate() * turn_b).vec().norm();
  const double shift = ((b.center - a.center) - axes_a * (then.b.center - then.a.center)).norm();
  const double moved = shift + turn * size + swing * dt;
  if (moved > std::min(hardly * size, unnoticed)) return false;
  contact.count = memory.count;
  contact.manifold = laid(memories, memory, axes_a, turn_b.toRotationMatrix(), a.center, b.center,
                          [&](std::size_t i, const Vec3& arm_a, const Vec3& arm_b, double gap) {
                            PointConstraint& point = contact.points[i];
                            point = {};
                            point.feature = memories.feature(memory, i);
                            point.start_arm_a = arm_a;
                            point.start_arm_b = arm_b;
                            point.start_gap = gap;
                          });
  return true;
}

Manifold manifold_of(const ContactMemories& memories, const ContactMemory& memory, const Stand& a, const Stand& b) {
  if (memory.is(ContactMemory::taken_up)) {
    const MoreOfContact& then = *memories.more(memory);
    const auto turned = [](const Quat& from, const Quat& to) {
      return Mat3((to * from.conjugate()).toRotationMatrix());
    };
    return laid(memories, memory, turned(then.a.rotation, a.rotation), turned(then.b.rotation, b.rotation), a.center,
                b.center, [](std::size_t, const Vec3&, const Vec3&, double) {});
  }
  Manifold manifold;
  manifold.normal = memory.normal;
  manifold.count = memory.count;
  for (std::size_t i = 0; i < memory.count; ++i) {
    const state::PointMemory& point = memories.point(memory, i);
    manifold.points[i] = {point.position, point.penetration, memories.feature(memory, i)};
  }
  return manifold;
}

std::array<Vec3, 4> arms_of(const ContactMemories& memories, const ContactMemory& memory, const Stand& b) {
  std::array<Vec3, 4> arms;
  const state::RareOfContact* rare = memories.rare(memory);
  if (rare && rare->has_arms) return rare->arms_b;
  const bool taken_up = memory.is(ContactMemory::taken_up);
  const Stand& then = taken_up ? memories.more(memory)->b : b;
  const Mat3 axes = taken_up ? Mat3(b.rotation.toRotationMatrix()) : Mat3(Mat3::Identity());
  for (std::size_t i = 0; i < memory.count; ++i) {
    const Vec3 arm = memories.point(memory, i).position - then.center;
    arms[i] = taken_up ? Vec3(axes * Vec3(then.rotation.conjugate() * arm)) : arm;
  }
  return arms;
}

}  // namespace tweenfall::contacts
