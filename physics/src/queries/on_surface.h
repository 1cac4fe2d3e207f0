#pragma once

#include <functional>
#include <optional>

#include "collision/surfaces/surface.h"
#include "queries/closest.h"
#include "queries/rays.h"

namespace tweenfall::queries {

// Meshes and height fields, triangle by triangle

/// Where a surface, which is a, and a shape, which is b, are nearest to each other. Both sides of the surface count.
[[nodiscard]] Closest closest_on_surface(const surfaces::Surface& surface, const shapes::Placed& at, const Shape& b,
                                         const Pose& pose_b);
/// The same for a core, which is b.
[[nodiscard]] Closest closest_on_surface(const surfaces::Surface& surface, const shapes::Placed& at, const Core& b);

/// Where a ray first meets the front of a triangle. No ray slips through between two triangles.
[[nodiscard]] std::optional<RayHit> first_on_surface(const surfaces::Surface& surface, const shapes::Placed& at,
                                                     const Ray& ray);

/// The core of a triangle of a surface.
[[nodiscard]] Core triangle_core(const surfaces::SurfaceTriangle& triangle, const shapes::Placed& at);

/// Calls `meet` with the core of each triangle whose front a core can meet on its path; it returns the part of
/// the path after which nothing counts any more.
void visit_on_way(const surfaces::Surface& surface, const shapes::Placed& at, const Core& moving,
                  const Vec3& displacement, const std::function<double(const Core&)>& meet);

}  // namespace tweenfall::queries
