#include "collision/convex/collide_convex.h"

#include <algorithm>
#include <cmath>

#include "collision/collide_pairs.h"
#include "collision/convex/depth.h"
#include "collision/convex/distance.h"
#include "collision/convex/facet.h"
#include "pairs/contact_candidates.h"

namespace tweenfall::convex {

using collision::add_point;

namespace {

/// By how much a face may be worse than the best direction, in parts of a size, so that rounding does not decide.
constexpr double face_preference = 1e-7;
/// Sine of the angle within which two lines lie along each other.
constexpr double lying_along = 0.05;

/// A flat face of one of them whose normal is as good as the best direction.
struct FaceChoice {
  FlatFace face;
  bool of_a = true;
  double gap = 0;
};

FaceChoice face_along(Core& a, Core& b, const Meeting& meeting) {
  const double preference = face_preference * std::min(a.size, b.size);
  FaceChoice best;
  best.gap = meeting.gap - preference;
  const auto consider = [&](const FlatFace& face, const Vec3& normal, bool of_a) {
    const double gap = -(a.height(normal) + b.height(-normal));
    if (!(gap > best.gap + (best.face.index == FlatFace::none ? 0 : 0.1 * preference))) return;
    best = {face, of_a, gap};
  };
  visit_faces(a, meeting.normal, [&](const FlatFace& face) { consider(face, face.normal, true); });
  visit_faces(b, -meeting.normal, [&](const FlatFace& face) { consider(face, -face.normal, false); });
  return best;
}

/// Adds a few of the corners that are near a plane, as contact points.
/// @param out  the plane's normal, toward the solid with the corners
/// @param shown  another direction in the plane, fixed to a solid
void add_corners(Manifold& manifold, const ClipPolygon& corners, const Vec3& out, double offset, const Vec3& shown,
                 std::uint32_t tag, double reach) {
  std::array<pairs::ContactCandidate, 2 * ConvexHull::most_vertices> candidates;
  std::size_t count = 0;
  for (std::size_t i = 0; i < corners.count; ++i) {
    const ClipCorner& corner = corners.corners[i];
    const Vec3 lowest = corner.position - corner.radius * out;
    const double gap = out.dot(lowest) - offset;
    if (gap <= reach) candidates[count++] = {lowest, gap, corner.feature};
  }
  count = pairs::reduce_to_four(std::span(candidates).first(count), out, shown);
  for (std::size_t i = 0; i < count; ++i)
    add_point(manifold, candidates[i].position - 0.5 * candidates[i].gap * out, -candidates[i].gap,
              candidates[i].feature | tag << 28, reach);
}

/// Adds the lowest point, which the sides of a face given by corners of its rim may have cut off.
void add_lowest(ClipPolygon& corners, Core& incident, const Vec3& out, double offset, double size) {
  const Vec3 lowest = incident.support(-out);
  const double gap = out.dot(lowest) - incident.radius - offset;
  for (std::size_t i = 0; i < corners.count; ++i) {
    const ClipCorner& corner = corners.corners[i];
    if (out.dot(corner.position) - corner.radius - offset <= gap + 1e-6 * size) return;
  }
  corners.add(lowest, 0x3000000u, 0, incident.radius);
}

/// The foremost part of one solid, cut by the sides of the other's face.
void clip_onto_face(Manifold& manifold, Core& reference, const FlatFace& face, Core& incident, std::uint32_t tag,
                    double reach) {
  ClipPolygon sides, polygon, spare;
  corners_of(reference, face, face.normal, sides);
  foremost(incident, -face.normal, polygon);
  ClipPolygon* now = &polygon;
  ClipPolygon* next = &spare;
  const double tolerance = 1e-4 * reference.size;
  for (std::size_t i = 0; i < sides.count; ++i) {
    const Vec3& from = sides.corners[i].position;
    const Vec3& to = sides.corners[i + 1 < sides.count ? i + 1 : 0].position;
    const Vec3 out = (to - from).cross(face.normal).normalized();
    cut_face(*now, out, out.dot(from), static_cast<std::uint32_t>(256 + i), tolerance, *next);
    std::swap(now, next);
  }
  const Vec3& first = sides.corners[0].position;
  const Vec3 along = (sides.corners[1].position - first).normalized();
  add_lowest(*now, incident, face.normal, face.normal.dot(first), std::min(reference.size, incident.size));
  add_corners(manifold, *now, face.normal, face.normal.dot(first), along + 0.37 * face.normal.cross(along), tag, reach);
}

/// Two lines that lie along each other: the ends of the stretch that both share.
void lie_along(Manifold& manifold, Core& a, Core& b, double reach) {
  const Vec3& normal = manifold.normal;
  const SurfaceLine of_a = foremost_line(a, normal);
  if (!of_a.there) return;
  const SurfaceLine of_b = foremost_line(b, -normal);
  if (!of_b.there) return;
  const double length_a = (of_a.to - of_a.from).norm();
  const Vec3 along = (of_a.to - of_a.from) / length_a, span_b = of_b.to - of_b.from;
  if (along.cross(span_b).norm() > lying_along * span_b.norm()) return;
  const double b_from = along.dot(of_b.from - of_a.from), b_to = along.dot(of_b.to - of_a.from);
  const double low = std::max(0.0, std::min(b_from, b_to)), high = std::min(length_a, std::max(b_from, b_to));
  if (!(high - low > 1e-3 * (a.size + b.size))) return;
  std::uint32_t feature = 0x3000001u;
  for (const double place : {low, high}) {
    const Vec3 on_a = of_a.from + place * along;
    const Vec3 on_b = of_b.from + (place - b_from) / (b_to - b_from) * span_b;
    const double gap = normal.dot(on_b - on_a);
    add_point(manifold, on_a + 0.5 * gap * normal, -gap, feature++, reach);
  }
}

}  // namespace

Meeting meeting_of(Core& a, Core& b, double margin) {
  Meeting meeting;
  const double around = a.radius + b.radius;
  const Nearness nearness = nearness_of(a, b, margin + around);
  if (nearness.distance > 0) {
    meeting.gap = nearness.distance - around;
    meeting.normal = nearness.normal;
    meeting.middle = 0.5 * (nearness.on_a + nearness.on_b + (a.radius - b.radius) * nearness.normal);
    return meeting;
  }
  const Depth depth = depth_of(a, b);
  meeting.gap = -depth.depth - around;
  meeting.normal = depth.normal;
  meeting.middle = 0.5 * (depth.on_a + depth.on_b + (a.radius - b.radius) * depth.normal);
  return meeting;
}

Manifold contact_along(Core& a, Core& b, const Meeting& meeting, double reach) {
  Manifold manifold;
  manifold.normal = meeting.normal;
  double gap = meeting.gap;
  const FaceChoice choice = face_along(a, b, meeting);
  if (choice.face.index != FlatFace::none) {
    manifold.normal = choice.of_a ? choice.face.normal : Vec3(-choice.face.normal);
    gap = choice.gap;
    clip_onto_face(manifold, choice.of_a ? a : b, choice.face, choice.of_a ? b : a, choice.of_a ? 0 : 1, reach);
  } else {
    lie_along(manifold, a, b, reach);
  }
  if (manifold.count == 0) add_point(manifold, meeting.middle, -gap, 0x3000000u, reach);
  return manifold;
}

Manifold collide_convex(Core& a, Core& b, double margin, double reach) {
  Manifold manifold;
  const Meeting meeting = meeting_of(a, b, margin);
  if (!(meeting.normal.squaredNorm() > 0.5)) return manifold;
  manifold.normal = meeting.normal;
  if (!(meeting.gap <= margin)) return manifold;
  const bool only_distance = meeting.gap > 0 && std::isinf(margin);
  if (!only_distance) return contact_along(a, b, meeting, reach);
  add_point(manifold, meeting.middle, -meeting.gap, 0x3000000u, reach);
  return manifold;
}

Manifold collide_with_plane(Core& a, const Vec3& normal, double offset, double margin, double reach) {
  Manifold manifold;
  manifold.normal = -normal;
  if (a.height(-normal) + offset < -margin) return manifold;
  ClipPolygon corners;
  foremost(a, -normal, corners);
  add_corners(manifold, corners, normal, offset, a.turn * Vec3(1, 0.61, 0.37), 0, reach);
  return manifold;
}

}  // namespace tweenfall::convex
