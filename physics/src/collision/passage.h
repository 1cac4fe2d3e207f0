#pragma once

#include "collision/impact_time.h"
#include "shapes/placed.h"

namespace tweenfall::collision {

/// A body on its path through the step, for use by all pairs with it.
struct Passage {
  const state::Body* body = nullptr;
  shapes::Placed placed;  ///< at the start
  Course course;
  double spin = 0;         ///< rad/s
  double swing = 0;        ///< greatest speed of a surface point due to its spin, m/s
  double radius = 0;       ///< the body's, m
  bool simple = false;     ///< neither a surface nor a compound
  bool boundless = false;  ///< a plane
};

[[nodiscard]] Passage passage_of(const state::Body& body, const forces::Load& load, double dt);

/// The same, for a part of the body's compound.
[[nodiscard]] Passage passage_of_part(const Passage& whole, const Shape& part);

/// Whether it has flat faces and corners, so that a separating direction is the normal of a face.
[[nodiscard]] inline bool is_polyhedron(const Solid& solid) {
  return std::holds_alternative<Box>(solid) || std::holds_alternative<Hull>(solid);
}

/// A direction that separated two bodies; it turns with one of them. For two polyhedra it is a face's normal, so that
/// `collide` finds bodies apart that it separates.
struct Apart {
  enum class Frame : std::uint8_t { none, a, b };
  Frame frame = Frame::none;
  Vec3 direction{0, 0, 0};  ///< unit, from a toward b, in the axes of that body's solid

  [[nodiscard]] Vec3 in_world(const Passage& a, const Passage& b) const {
    return frame == Frame::a ? a.placed.axes * direction : b.placed.axes * direction;
  }
};

/// For the direction in which `collide` found them apart; frame `none` if that direction is of no use.
[[nodiscard]] Apart apart_along(const Passage& a, const Passage& b, const Vec3& normal);

/// How far b lies beyond a along a unit direction, m; never more than their distance.
[[nodiscard]] double gap_along(const Passage& a, const Passage& b, const Vec3& direction);

/// How many corners of a polyhedron lie at most `depth` behind its foremost one along a unit direction; for anything
/// else, more than can be counted.
[[nodiscard]] int corners_within(const Passage& passage, const Vec3& direction, double depth);

/// Whether bodies with this gap along a direction are no nearer than `near_enough` and cannot meet within `dt`.
[[nodiscard]] bool stay_apart(const Passage& a, const Passage& b, const Vec3& direction, double gap, double near_enough,
                              double dt);

}  // namespace tweenfall::collision
