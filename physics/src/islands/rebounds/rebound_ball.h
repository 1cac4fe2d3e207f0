#pragma once

#include "islands/blocks/contact_blocks.h"
#include "islands/blocks/island_body.h"

namespace tweenfall::blocks {

/// What `ReboundContact` is to other contacts, for those of a BallBlock: without friction it is looked at in two lines
/// of a processor's memory, and of a heap that is what the time goes for.
class alignas(64) ReboundBall {
 public:
  /// @param lane  8 * block + lane; balls come after all blocks
  void take(const ContactBlocks& contacts, std::uint32_t lane);
  /// It shall leave with this speed.
  void want(std::size_t, double speed) { wanted_ = speed; }
  /// @return the change of velocity, m/s
  double solve(std::vector<BodyLanes>& velocities);
  /// Lets only a share of what changed through.
  void take_back(double share);
  /// See ReboundContact::put_back.
  void put_back(ContactBlocks& contacts) const;

  [[nodiscard]] std::uint32_t a() const { return a_; }
  [[nodiscard]] std::uint32_t b() const { return b_; }
  [[nodiscard]] double tremble() const { return tremble_; }
  [[nodiscard]] const Vec3& normal() const { return normal_; }
  [[nodiscard]] double mass(std::size_t) const { return mass_; }
  /// Impulse that the rebound gave along the normal, N s.
  [[nodiscard]] double given(std::size_t) const { return impulse_ - before_; }
  /// How fast it opens, m/s.
  [[nodiscard]] double speed(std::size_t, const std::vector<BodyLanes>& velocities) const {
    return normal_.dot(linear_of(velocities[b_]) - linear_of(velocities[a_]));
  }
  // Along the line to the middle nothing is turned.
  [[nodiscard]] Vec3 turn_a(std::size_t) const { return {0, 0, 0}; }
  [[nodiscard]] Vec3 turn_b(std::size_t) const { return {0, 0, 0}; }

 private:
  double solve_friction(BodyLanes& a, BodyLanes& b);
  /// What nothing moves others may look at meanwhile: it is left alone.
  void push(BodyLanes& a, BodyLanes& b, const Vec3& impulse) const {
    if (inverse_mass_a_ > 0) add(a.linear, -inverse_mass_a_ * impulse);
    if (inverse_mass_b_ > 0) add(b.linear, inverse_mass_b_ * impulse);
  }

  std::uint32_t lane_ = 0, a_ = 0, b_ = 0;
  bool grips_ = false;
  double inverse_mass_a_ = 0, inverse_mass_b_ = 0;
  Vec3 normal_;
  double impulse_ = 0;
  double mass_ = 0, gap_ = 0, wanted_ = 0, before_ = 0, tremble_ = 0;
  double coefficient_ = 0, arm_a_ = 0, arm_b_ = 0, spin_a_ = 0, spin_b_ = 0, slip_mass_ = 0;
  Vec3 friction_, friction_before_;
};

}  // namespace tweenfall::blocks
