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

/// A manifold that was found earlier, in the bodies' own axes.
class FoundManifold {
 public:
  FoundManifold(const ContactMemories& memories, const ContactMemory& memory)
      : memories_(memories), memory_(memory), then_(*memories.more(memory)), back_a_(then_.a.rotation.conjugate()) {}

  /// Of b, in a's axes.
  [[nodiscard]] Quat turn() const { return back_a_ * then_.b.rotation; }
  /// From a's center of mass to b's, in a's axes, m.
  [[nodiscard]] Vec3 between() const { return back_a_ * Vec3(then_.b.center - then_.a.center); }

  /// The same for the present positions of the bodies. Calls see(i, arm from a, arm from b, gap) for its points.
  template <class See>
  Manifold laid(const Stand& a, const Stand& b, const See& see) const {
    const Mat3 axes_a = a.rotation.toRotationMatrix(), axes_b = b.rotation.toRotationMatrix();
    const Quat back_b = then_.b.rotation.conjugate();
    Manifold manifold;
    manifold.normal = axes_a * Vec3(back_a_ * memory_.normal);
    manifold.count = memory_.count;
    for (std::size_t i = 0; i < memory_.count; ++i) {
      const state::PointMemory& point = memories_.point(memory_, i);
      const Vec3 arm_a = axes_a * Vec3(back_a_ * Vec3(point.position - then_.a.center));
      const Vec3 arm_b = axes_b * Vec3(back_b * Vec3(point.position - then_.b.center));
      const Vec3 apart = (b.center + arm_b) - (a.center + arm_a);
      const double gap = -point.penetration + manifold.normal.dot(apart);
      manifold.points[i] = {a.center + arm_a + 0.5 * apart, -gap, memories_.feature(memory_, i)};
      see(i, arm_a, arm_b, gap);
    }
    return manifold;
  }

 private:
  const ContactMemories& memories_;
  const ContactMemory& memory_;
  const MoreOfContact& then_;
  Quat back_a_;
};

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
  const FoundManifold found(memories, memory);
  const double size = std::min(a.radius(), b.radius());
  const Stand now_a{a.center, a.motion.pose.rotation}, now_b{b.center, b.motion.pose.rotation};
  const Quat back_a = now_a.rotation.conjugate();
  const Vec3 between = back_a * Vec3(b.center - a.center);
  const double turn = 2 * (found.turn().conjugate() * (back_a * now_b.rotation)).vec().norm();
  const double moved = (between - found.between()).norm() + turn * size + swing * dt;
  if (moved > std::min(hardly * size, unnoticed)) return false;
  contact.count = memory.count;
  contact.manifold = found.laid(now_a, now_b, [&](std::size_t i, const Vec3& arm_a, const Vec3& arm_b, double gap) {
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
  if (memory.is(ContactMemory::taken_up))
    return FoundManifold(memories, memory).laid(a, b, [](std::size_t, const Vec3&, const Vec3&, double) {});
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
