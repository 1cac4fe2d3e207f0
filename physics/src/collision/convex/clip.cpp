#include "collision/convex/clip.h"

namespace tweenfall::convex {

void cut_face(const ClipPolygon& polygon, const Vec3& normal, double offset, std::uint32_t plane, double tolerance,
              ClipPolygon& result) {
  result.count = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipCorner& from = polygon.corners[i];
    const ClipCorner& to = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double at_from = normal.dot(from.position) - offset;
    const double at_to = normal.dot(to.position) - offset;
    const bool leaves = at_from < -tolerance && at_to > tolerance;
    const bool enters = at_from > tolerance && at_to < -tolerance;
    // A corner on the plane stays the same corner on whichever side rounding puts it.
    if (at_from <= tolerance)
      result.add(from.position, from.feature, at_from >= -tolerance && at_to > tolerance ? plane : from.edge,
                 from.radius);
    // The way back along an edge finds no more than the way there.
    if ((!leaves && !enters) || (polygon.count == 2 && i == 1)) continue;
    const double share = at_from / (at_from - at_to);
    const Vec3 position = from.position + (to.position - from.position) * share;
    const double radius = from.radius + (to.radius - from.radius) * share;
    if (leaves)
      result.add(position, 0x1000000u | from.edge << 9 | plane, plane, radius);
    else
      result.add(position, 0x1000000u | plane << 9 | from.edge, from.edge, radius);
  }
}

}  // namespace tweenfall::convex
