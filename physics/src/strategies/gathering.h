#pragma once

#include <cstdint>
#include <vector>

#include "contacts/contact_constraint.h"
#include "state/body.h"

namespace tweenfall::strategies {

/// A body of an island while a strategy works on it.
struct Party {
  std::uint32_t index = 0;  ///< in the world
  bool movable = false;
  double inverse_mass = 0;
  Mat3 inverse_inertia = Mat3::Zero();  ///< world axes
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};
  bool touched = false;  ///< an impulse reached it
};

/// A point where two of them touch.
struct Touch {
  std::uint32_t a = 0, b = 0;           ///< places among the parties
  Vec3 normal{0, 1, 0};                 ///< from a toward b
  Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};  ///< from the centers of mass, m
  double wanted = 0;                    ///< least speed at which the surfaces must part, m/s
  double friction = 0;
  double impulse = 0;                    ///< along the normal, on b, N s
  Vec3 rubbing{0, 0, 0};                 ///< across it, on b, N s
  double kept = 0;                       ///< impulse along the normal in the step before, N s
  std::uint32_t contact = 0, point = 0;  ///< index of the island's contact, and of its point
};

/// An island: what touches what. Strategies change the parties' velocities by impulses, and record these here.
struct Gathering {
  std::vector<Party> parties;
  std::vector<Touch> touches;
  int passes = 20;             ///< greatest number of passes over all touches
  double complementarity = 0;  ///< written by solvers of the complementarity problem: its residual, m/s

  /// How fast the surfaces part at a touch, m/s: the velocity of a point is v + w x r.
  [[nodiscard]] double parting(const Touch& touch) const;
  /// How fast b slips over a there, m/s.
  [[nodiscard]] Vec3 slip(const Touch& touch) const;
  /// By how much a unit of impulse along a direction changes the speed along it, 1/kg.
  [[nodiscard]] double ease(const Touch& touch, const Vec3& direction) const;
  /// Applies an impulse to b, and its opposite to a.
  void push(const Touch& touch, const Vec3& impulse);

  /// Applies the impulses of the step before again.
  void begin_where_it_ended();
  /// Changes the impulse along the normal so that the surfaces part as wanted, without ever pulling.
  void press(Touch& touch);
  /// Changes the impulse across it so that nothing slips, up to the limit of friction.
  void rub(Touch& touch);
};

}  // namespace tweenfall::strategies
