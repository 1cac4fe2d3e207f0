#pragma once

/// The touching parts of a convex solid: faces, edges and rims.

#include "collision/convex/clip.h"
#include "collision/convex/core.h"

namespace tweenfall::convex {

/// A flat face of a core.
struct FlatFace {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t index = none;
  Vec3 normal{0, 0, 0};  ///< unit, outwards
};

/// Calls `visit` with every flat face whose normal points roughly along a unit direction.
template <class Visit>
void visit_faces(const Core& core, const Vec3& direction, const Visit& visit) {
  constexpr double roughly = 0.9;  // cosine of the angle
  const Vec3 local = core.turn.transpose() * direction;
  if (core.kind == Core::Kind::box) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double along = local[static_cast<int>(i)];
      if (std::abs(along) >= roughly)
        visit(FlatFace{2 * i + (along > 0 ? 1 : 0), core.turn.col(static_cast<int>(i)) * (along > 0 ? 1.0 : -1.0)});
    }
  } else if (core.kind == Core::Kind::hull) {
    const std::span<const ConvexHull::Face> faces = core.hull->faces();
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      if (faces[i].normal.dot(local) >= roughly) visit(FlatFace{i, core.turn * faces[i].normal});
  } else if (core.kind == Core::Kind::cylinder) {
    if (std::abs(local.y()) >= roughly)
      visit(FlatFace{local.y() > 0 ? 1u : 0u, core.turn.col(1) * (local.y() > 0 ? 1.0 : -1.0)});
  } else if (core.kind == Core::Kind::cone) {
    if (local.y() <= -roughly) visit(FlatFace{0, -core.turn.col(1)});
  } else if (core.kind == Core::Kind::triangle) {
    const Vec3 normal = core.turn.col(1);
    if (normal.dot(direction) >= roughly) visit(FlatFace{0, normal});
  }
}

/// Corners of a flat face, counter-clockwise as seen from outside. A round face is given as sixteen corners of its rim,
/// one of them the lowest along `direction`.
void corners_of(const Core& core, const FlatFace& face, const Vec3& direction, ClipPolygon& corners);

/// The part of the surface that is foremost along a direction: a face, an edge, or a corner, however much it leans.
void foremost(Core& core, const Vec3& direction, ClipPolygon& corners);

/// An edge of the surface that is nearly perpendicular to a direction, and is farthest along it.
struct SurfaceLine {
  bool there = false;
  Vec3 from{0, 0, 0}, to{0, 0, 0};
};
[[nodiscard]] SurfaceLine foremost_line(Core& core, const Vec3& direction);

}  // namespace tweenfall::convex
