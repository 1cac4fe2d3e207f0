#pragma once

#include <algorithm>

#include "collision/passage.h"
#include "contacts/adopt.h"
#include "contacts/found.h"

namespace tweenfall::contacts {

/// Whether two bodies may meet in this step although they stay apart on their present paths. Bodies that hardly move
/// are not examined: in most heaps that is all of them.
[[nodiscard]] inline bool may_follow(const collision::Passage& a, const collision::Passage& b, double dt) {
  const double square = std::max(a.course.linear.squaredNorm(), b.course.linear.squaredNorm()) * dt * dt;
  const double near = near_enough_of(a, b);
  return 16 * square > near * near;
}

/// The same for this gap, if one of the two is stopped, or pushed by a third body.
[[nodiscard]] inline bool follow(const collision::Passage& a, const collision::Passage& b, double gap, double dt) {
  constexpr double faster = 4, close = 0.1;  // of the speed; parts of the smaller one's radius
  const double square = std::max(a.course.linear.squaredNorm(), b.course.linear.squaredNorm()) * dt * dt;
  return gap * gap < square ||
         (gap * gap < faster * faster * square && gap < close * std::min(a.body->radius(), b.body->radius()));
}

/// Whether `collide` finds the exact distance of two bodies, so that no known direction gives a
/// wider gap: with a ball, or for two capsules, their distance; for two polyhedra the widest gap above a face. For
/// other solids it takes the first direction that separates them.
[[nodiscard]] inline bool tell_all(const collision::Passage& a, const collision::Passage& b) {
  enum class Kind { ball, capsule, polyhedron, other };
  const auto kind_of = [](const collision::Passage& way) {
    const Solid& solid = way.course.shape->solid;
    if (std::holds_alternative<Sphere>(solid)) return Kind::ball;
    if (std::holds_alternative<Capsule>(solid)) return Kind::capsule;
    return collision::is_polyhedron(solid) ? Kind::polyhedron : Kind::other;
  };
  const Kind kind_a = kind_of(a), kind_b = kind_of(b);
  if (kind_a == Kind::other || kind_b == Kind::other) return false;
  return kind_a == kind_b || kind_a == Kind::ball || kind_b == Kind::ball;
}
/// Except for rounding: `collide` finds at least this part of a gap along any direction.
constexpr double surely = 0.999;

/// Whether two bodies are so fast that they may meet with a blow.
[[nodiscard]] inline bool may_strike(const collision::Passage& a, const collision::Passage& b, double dt) {
  const auto fast = [dt](const collision::Passage& way) {
    const double speed = way.course.linear.norm() + way.swing;
    return speed > way.course.acceleration.norm() * dt;
  };
  return fast(a) || fast(b);
}

[[nodiscard]] inline Link link_of(std::uint32_t a, const collision::Passage& way_a, std::uint32_t b,
                                  const collision::Passage& way_b, const Vec3& normal, double gap) {
  const auto inverse_mass = [](const collision::Passage& way) {
    return way.body->immovable() ? 0 : 1 / way.body->mass().mass;
  };
  return {a,
          b,
          normal,
          gap,
          normal.dot(way_a.course.linear - way_b.course.linear),
          inverse_mass(way_a),
          inverse_mass(way_b)};
}

/// Adds the blow with which two bodies meet at this contact within the step, if any.
void note_blow(const ContactConstraint& contact, const collision::Passage& a, const collision::Passage& b, double dt,
               std::vector<Blow>& blows);

}  // namespace tweenfall::contacts
