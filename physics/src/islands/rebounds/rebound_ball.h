#pragma once

#include "islands/blocks/contact_blocks.h"
#include "islands/blocks/island_body.h"

namespace tweenfall::blocks {

/// The counterpart of `ReboundContact` for contacts of a BallBlock: without friction it fits into two cache lines, and
/// memory is what takes the time in a heap.
class alignas(64) ReboundBall {
 public:
  /// @param lane  8 * block + lane; balls come after all blocks
  void take(const ContactBlocks& contacts, std::uint32_t lane);
  /// Sets the speed with which it should leave.
  void want(std::size_t, double speed) { wanted_ = speed; }
  /// @return the change of velocity, m/s
  double solve(std::vector<BodyLanes>& velocities);
  /// Lets only a share of the change through.
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
  // An impulse along the line of centers turns nothing.
  [[nodiscard]] Vec3 turn_a(std::size_t) const { return {0, 0, 0}; }
  [[nodiscard]] Vec3 turn_b(std::size_t) const { return {0, 0, 0}; }

 private:
  double solve_friction(BodyLanes& a, BodyLanes& b);
  /// Other threads may read an immovable body meanwhile: it is not written.
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
