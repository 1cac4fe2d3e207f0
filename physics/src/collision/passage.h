#pragma once

#include "collision/impact_time.h"
#include "shapes/placed.h"

namespace tweenfall::collision {

/// A body on its way through the step, as all pairs with it look at it.
struct Passage {
  const state::Body* body = nullptr;
  shapes::Placed placed;  ///< at the start
  Course course;
  double spin = 0;         ///< rad/s
  double swing = 0;        ///< how fast its spin moves a point of its surface, m/s
  bool simple = false;     ///< neither a surface nor of several parts
  bool boundless = false;  ///< a plane
};

[[nodiscard]] Passage passage_of(const state::Body& body, const forces::Load& load, double dt);

/// The same, for a part of the body's compound.
[[nodiscard]] Passage passage_of_part(const Passage& whole, const Shape& part);

/// Whether it has flat faces and corners, and a direction that tells it apart is a face's normal.
[[nodiscard]] inline bool is_polyhedron(const Solid& solid) {
  return std::holds_alternative<Box>(solid) || std::holds_alternative<Hull>(solid);
}

/// What told two bodies apart: a direction that turns with one of them. Of two polyhedra it is a face's normal, so that
/// bodies which it tells apart are apart for `collide` too.
struct Apart {
  enum class Frame : std::uint8_t { none, a, b };
  Frame frame = Frame::none;
  Vec3 direction{0, 0, 0};  ///< unit, from a toward b, in the axes of that one's solid

  [[nodiscard]] Vec3 in_world(const Passage& a, const Passage& b) const {
    return frame == Frame::a ? a.placed.axes * direction : b.placed.axes * direction;
  }
};

/// Of the direction in which `collide` found them apart; of no frame when it is of no use.
[[nodiscard]] Apart apart_along(const Passage& a, const Passage& b, const Vec3& normal);

/// How far b lies beyond a along a unit direction, m; never more than their distance.
[[nodiscard]] double gap_along(const Passage& a, const Passage& b, const Vec3& direction);

/// How many corners of a polyhedron lie no farther than `depth` behind its foremost along a unit direction; of anything
/// else more than can be counted.
[[nodiscard]] int corners_within(const Passage& passage, const Vec3& direction, double depth);

/// Whether bodies with such a gap along a direction neither are nearer than `near_enough` nor can meet within `dt`.
[[nodiscard]] bool stay_apart(const Passage& a, const Passage& b, const Vec3& direction, double gap, double near_enough,
                              double dt);

}  // namespace tweenfall::collision
