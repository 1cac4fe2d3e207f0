#pragma once

/// Faces cut by the sides of other faces.

#include <tweenfall/physics/convex_hull.h>

#include <array>
#include <cstdint>

namespace tweenfall::convex {

struct ClipCorner {
  Vec3 position;
  std::uint32_t feature;
  std::uint32_t edge;  ///< the polygon's edge after this corner: a side of the face that is cut, or a cutting plane
  double radius;       ///< of a ball around it, m
};

/// A face being cut, or an edge, or a corner alone; each plane adds at most one corner.
struct ClipPolygon {
  std::array<ClipCorner, 2 * ConvexHull::most_vertices> corners;
  std::size_t count = 0;
  void add(const Vec3& position, std::uint32_t feature, std::uint32_t edge, double radius = 0) {
    if (count < corners.size()) corners[count++] = {position, feature, edge, radius};
  }
};

/// Writes the part behind the plane to `result`. New corners are named by the plane and the edge it cut.
void cut_face(const ClipPolygon& polygon, const Vec3& normal, double offset, std::uint32_t plane, double tolerance,
              ClipPolygon& result);

}  // namespace tweenfall::convex
