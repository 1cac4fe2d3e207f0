#pragma once

#include "collision/polyhedron.h"

namespace tweenfall::collision {

/// The direction along which two polyhedra are farthest apart, or overlap least.
struct PolyhedraSeparation {
  enum class Kind { face_a, face_b, edges };
  Kind kind = Kind::face_a;
  double gap = 0;                       ///< m; negative for an overlap
  Vec3 normal{0, 0, 0};                 ///< unit, from a toward b
  std::uint32_t first = 0, second = 0;  ///< face: its index, and the other's nearest vertex; edges: of a and of b
};

/// Near ties go to a's faces, then b's, then to pairs of edges, so that the choice does not change from step to step.
/// For polyhedra farther apart than `margin`, the first such direction.
/// @param reach  how far apart corners may be to matter to the caller, m; >= margin
/// Source: Gregorius, The Separating Axis Test between Convex Polyhedra, GDC 2013.
[[nodiscard]] PolyhedraSeparation separation_of(const Polyhedron& a, const Polyhedron& b, double margin, double reach);

}  // namespace tweenfall::collision
