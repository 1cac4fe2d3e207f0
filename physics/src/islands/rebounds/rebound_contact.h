#pragma once

#include <array>

#include "islands/blocks/contact_blocks.h"
#include "islands/blocks/island_body.h"

namespace tweenfall::blocks {

/// A contact that a rebound reaches, taken out of its lane while the rebound is being solved: only few are reached, and
/// each is visited several times.
class ReboundContact {
 public:
  /// @param lane  8 * block + lane
  void take(const ContactBlocks& contacts, std::uint32_t lane, const std::vector<IslandBody>& bodies);
  /// Sets the speed with which point `i` should leave.
  void want(std::size_t i, double speed) { points_[i].wanted = speed; }
  /// One pass over its points. @return the change of velocity, m/s
  double solve(std::vector<BodyLanes>& velocities);
  /// Lets only a share of the change through.
  void take_back(double share);
  /// Adds what it gave to the totals. A blow says nothing about the forces after it: the next sub-step starts with the
  /// impulses from before the rebound.
  void put_back(ContactBlocks& contacts) const;

  [[nodiscard]] std::uint32_t a() const { return a_; }
  [[nodiscard]] std::uint32_t b() const { return b_; }
  [[nodiscard]] double tremble() const { return tremble_; }
  [[nodiscard]] const Vec3& normal() const { return normal_; }
  [[nodiscard]] const Vec3& turn_a(std::size_t i) const { return points_[i].turn_a; }
  [[nodiscard]] const Vec3& turn_b(std::size_t i) const { return points_[i].turn_b; }
  [[nodiscard]] double mass(std::size_t i) const { return points_[i].mass; }
  /// Impulse that the rebound gave along the normal, N s.
  [[nodiscard]] double given(std::size_t i) const { return points_[i].impulse - points_[i].before; }
  /// How fast a point opens, m/s.
  [[nodiscard]] double speed(std::size_t i, const std::vector<BodyLanes>& velocities) const;
  /// Work that the impulse of the rebound does on a body, by the velocity of the other, which nothing else changes, J.
  [[nodiscard]] double work(const BodyLanes& will, bool a_moves) const;

 private:
  struct Point {
    double mass, gap, impulse, before, wanted;
    Vec3 turn_a, turn_b;
  };
  struct Friction {
    double inverse11, inverse12, inverse22, firm;
    double first, second, first_before, second_before;
    Vec3 first_a, first_b, second_a, second_b;
    double drift1 = 0, drift2 = 0;  ///< of the surfaces, m/s
  };
  double solve_friction(Friction& row, double limit, BodyLanes& a, BodyLanes& b) const;
  // Other threads may read an immovable body meanwhile: it is not written.
  void turn(BodyLanes& a, BodyLanes& b, const Vec3& turn_a, const Vec3& turn_b) const;
  void push(BodyLanes& a, BodyLanes& b, const Vec3& impulse) const;

  std::uint32_t lane_ = 0, a_ = 0, b_ = 0;
  std::size_t count_ = 0, frictions_ = 0;
  bool central_ = false, grips_ = false, isotropic_ = true;
  double tremble_ = 0, coefficient_ = 0;
  double inverse_mass_a_ = 0, inverse_mass_b_ = 0, inverse_moment_a_ = 0, inverse_moment_b_ = 0;
  const IslandBody *body_a_ = nullptr, *body_b_ = nullptr;
  Vec3 normal_;
  std::array<Point, 4> points_;
  Vec3 tangent1_, tangent2_;
  std::array<Friction, 4> rows_;
};

}  // namespace tweenfall::blocks
