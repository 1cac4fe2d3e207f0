#pragma once

#include "state/contact_memories.h"
#include "state/prefetch.h"

namespace tweenfall::contacts {

/// One point of a contact through a step.
struct PointConstraint {
  std::uint32_t feature = 0;
  Vec3 start_arm_a{0, 0, 0}, start_arm_b{0, 0, 0};  ///< from the centers of mass at the start of the step, world, m
  double start_gap = 0;                             ///< along the normal at the start of the step, m
  double skin_a = 0, skin_b = 0;  ///< radii with which the surfaces roll here; 0 if they are flat or sharp, m
  double kept_normal = 0;         ///< of the last sub-step worth keeping, where the next one starts, N s
  Vec3 kept_friction{0, 0, 0};
  double total_normal = 0;  ///< of the whole step
  Vec3 total_friction{0, 0, 0};
  double approach = 0;  ///< closing speed where the two meet, m/s
};

/// Two bodies, or parts of them, that may be in contact.
struct PairInContact {
  std::uint32_t a = 0, b = 0;                              ///< indices of the bodies, a < b
  std::uint32_t part_a = 0, part_b = 0;                    ///< of compounds
  std::uint32_t memory = state::ContactMemories::nowhere;  ///< its memory, if the pair touched before
};

/// All about a pair in contact except its points.
struct ContactHead : PairInContact, state::KeptImpulses {
  int count = 0;
  double friction = 0;
  double restitution = 0;
  double rolling_friction = 0;
  double spinning_friction = 0;
  Vec3 rolling_impulse{0, 0, 0};
  Vec3 total_rolling{0, 0, 0};
  double spin_impulse = 0;  ///< of the sub-step, about the normal, N m s
  bool kept = false;        ///< its manifold was found in an earlier step
  bool began = false;       ///< the pair did not touch in the step before
  bool impact = false;      ///< some point meets fast enough to rebound
  bool within = false;      ///< the two lay in each other when they met, and still do
  double eased = 0;         ///< part of the overlap that no impulse removes, m
  double impact_time = 0;   ///< s after the start of the step
};

/// A pair in contact through a step.
struct ContactConstraint : ContactHead {
  Manifold manifold;
  std::array<PointConstraint, 4> points{};  ///< only the first `count` are used
};

/// The gap of one of its points at the start of the step that impulses see, m.
[[nodiscard]] inline double eased_gap(const ContactConstraint& contact, const PointConstraint& point) {
  return point.start_gap + contact.eased;
}

/// Prefetches it with its first points.
inline void fetch(const ContactConstraint& contact) {
  state::fetch<ContactHead>(&contact);
  state::fetch(&contact.manifold.normal);
  state::fetch(contact.points.data());
  state::fetch(contact.points.data() + 1);
}

}  // namespace tweenfall::contacts
