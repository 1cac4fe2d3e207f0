#pragma once

#include "contacts/contact_constraint.h"

namespace tweenfall::step {

/// A point while its contact is being solved alone.
struct SolvedPoint : contacts::PointConstraint {
  Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};  ///< in the current sub-step
  double gap = 0;
  double normal_impulse = 0;        ///< of one sub-step, N s
  Vec3 friction_impulse{0, 0, 0};   ///< of one sub-step, world, N s
  double wanted = 0;                ///< normal speed that the last pass aimed at, m/s
  double firm = 0;                  ///< share of its error that the last pass removed: 0 if it left the point out
  double rebound = 0;               ///< normal speed wanted at the end of the sub-step, m/s
  double rebound_time = 0;          ///< how long the rebound moves the bodies in this sub-step, s
  double speed_before_rebound = 0;  ///< m/s
  double normal_before_rebound = 0;
  Vec3 friction_before_rebound{0, 0, 0};
};

/// A contact while it is being solved alone.
struct SolvedContact : state::KeptImpulses {
  explicit SolvedContact(contacts::ContactConstraint& contact)
      : state::KeptImpulses(contact),
        origin(&contact),
        a(contact.a),
        b(contact.b),
        normal(contact.manifold.normal),
        count(contact.count),
        friction(contact.friction),
        restitution(contact.restitution),
        rolling_friction(contact.rolling_friction),
        spinning_friction(contact.spinning_friction),
        impact(contact.impact) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      SolvedPoint& point = points[i];
      static_cast<contacts::PointConstraint&>(point) = contact.points[i];
      point.arm_a = point.start_arm_a;
      point.arm_b = point.start_arm_b;
      point.gap = point.start_gap;
    }
  }
  /// Returns the impulses to their origin.
  void store() const {
    static_cast<state::KeptImpulses&>(*origin) = *this;
    origin->total_rolling = total_rolling;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) origin->points[i] = points[i];
  }

  contacts::ContactConstraint* origin;
  std::uint32_t a, b;
  Vec3 normal;
  std::array<SolvedPoint, 4> points{};
  int count;
  double friction, restitution, rolling_friction, spinning_friction;
  Vec3 rolling_impulse{0, 0, 0};
  Vec3 total_rolling{0, 0, 0};
  double spin_impulse = 0;
  bool impact;
  bool rebounds = false;  ///< this sub-step is one in which its island rebounds
};

}  // namespace tweenfall::step
