#pragma once

#include "collision/passage.h"
#include "collision/surfaces/surface.h"

namespace tweenfall::surfaces {

/// When a moving solid first gets nearer than a hair to a triangle.
struct TriangleMeeting {
  double time = 0;       ///< s after the start of the step
  Vec3 normal{0, 1, 0};  ///< of the triangle, in the surface's space
  double offset = 0;     ///< of its plane along the normal, m
};

/// Planes that a solid is already near: their triangles are skipped.
struct KnownPlane {
  Vec3 normal;
  double offset;
};

struct FirstMeetings {
  static constexpr std::size_t most = 4;
  std::array<TriangleMeeting, most> meetings;
  std::size_t count = 0;
};

/// The first meetings of a convex solid with triangles that it is in front of: the very first, and of the later
/// ones those that it still moves toward after the earlier ones have stopped it. One per plane.
/// @param near  triangles nearer than this at the start are skipped, and those this near to a known
/// plane, m
[[nodiscard]] FirstMeetings first_meetings(const Surface& surface, const collision::Passage& way_surface,
                                           const collision::Passage& way, std::span<const KnownPlane> known,
                                           double near, double dt);

}  // namespace tweenfall::surfaces
