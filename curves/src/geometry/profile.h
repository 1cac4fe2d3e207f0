#pragma once

// A curve cut into straight sides, for meshes.

#include <tweenfall/curves/curve.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tweenfall::geometry {

/// The knots, and times between them so that there are about `steps` stretches of equal duration; straight spans are
/// not cut if `keep_straight`.
/// @throws std::invalid_argument naming `what` for an endless curve or one that is a single point, or steps < 1.
template <class T>
[[nodiscard]] std::vector<double> step_times(const Curve<T>& curve, int steps, bool keep_straight,
                                             const std::string& what);

struct Profile {
  /// A line of vertices along the surface; two stand at one point where the profile kinks, and where it closes.
  struct Column {
    Vec2 position;
    Vec2 tangent;  // unit
    double share;  // of the length, 0 to 1
  };
  std::vector<Column> columns;
  std::vector<std::uint32_t> sides;    // column at which each side begins; it ends at the next
  std::vector<std::uint32_t> corners;  // one column for each distinct point, in order
  bool closed = false;
  double area = 0;  // enclosed, > 0 where counter-clockwise; an open profile is closed through the origin

  Profile(const Curve<Vec2>& curve, int steps, bool keep_straight);

  /// The same points from last to first.
  void reverse();
};

/// Corners of triangles that fill a polygon without holes, three each, wound as the polygon is; indices into `points`.
/// Source: ear clipping, Meisters, "Polygons have ears", 1975.
[[nodiscard]] std::vector<std::uint32_t> polygon_triangles(const std::vector<Vec2>& points);

}  // namespace tweenfall::geometry
