#include "collision/collide_polyhedra.h"

#include <algorithm>
#include <cmath>

#include "collision/collide_pairs.h"
#include "collision/convex/clip.h"
#include "collision/polyhedra_separation.h"
#include "pairs/contact_candidates.h"

namespace tweenfall::collision {

using convex::ClipCorner;
using convex::ClipPolygon;
using convex::cut_face;
using shapes::Placed;

namespace {

/// The face at a vertex that faces most against a direction.
std::uint32_t face_toward(const Polyhedron& polyhedron, std::uint32_t vertex, const Vec3& direction) {
  std::uint32_t best = 0;
  double least = 2;
  for (std::uint32_t i = 0; i < polyhedron.faces.size(); ++i) {
    const double along = polyhedron.faces[i].normal.dot(direction);
    if (along >= least - 1e-6) continue;
    const std::span<const std::uint32_t> corners = polyhedron.corners(i);
    if (std::find(corners.begin(), corners.end(), vertex) == corners.end()) continue;
    least = along;
    best = i;
  }
  return best;
}

/// A face of one polyhedron against the other: the opposite face, cut by the sides of the first.
void clip_onto_face(Manifold& manifold, const Polyhedron& reference, std::uint32_t face, const Polyhedron& incident,
                    std::uint32_t nearest, double margin, std::uint32_t tag) {
  const Vec3& normal = reference.faces[face].normal;
  const std::uint32_t opposite = face_toward(incident, nearest, normal);
  ClipPolygon polygon, spare;
  ClipPolygon* now = &polygon;
  ClipPolygon* next = &spare;
  std::uint32_t side = 0;
  for (const std::uint32_t corner : incident.corners(opposite)) {
    polygon.add(incident.vertices[corner], side, side);
    ++side;
  }
  const double tolerance = 1e-4 * reference.size;
  const std::span<const std::uint32_t> corners = reference.corners(face);
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = reference.vertices[corners[i]];
    const Vec3& to = reference.vertices[corners[i + 1 < corners.size() ? i + 1 : 0]];
    const Vec3 out = (to - from).cross(normal).normalized();
    cut_face(*now, out, out.dot(from), 256 + i, tolerance, *next);
    std::swap(now, next);
  }
  std::array<pairs::ContactCandidate, 2 * ConvexHull::most_vertices> candidates;
  std::size_t count = 0;
  for (std::size_t i = 0; i < now->count; ++i) {
    const ClipCorner& corner = now->corners[i];
    const double gap = normal.dot(corner.position) - reference.faces[face].offset;
    if (gap <= margin) candidates[count++] = {corner.position, gap, corner.feature};
  }
  const Vec3 first = (reference.vertices[corners[1]] - reference.vertices[corners[0]]).normalized();
  count = pairs::reduce_to_four(std::span(candidates).first(count), normal, first + 0.37 * normal.cross(first));
  for (std::size_t i = 0; i < count; ++i)
    add_point(manifold, candidates[i].position - 0.5 * candidates[i].gap * normal, -candidates[i].gap,
              candidates[i].feature | tag << 28, margin);
}

/// Two edges that cross: their nearest points.
void cross_two_edges(Manifold& manifold, const PolyhedraSeparation& separation, const Polyhedron& a,
                     const Polyhedron& b, double margin) {
  const ConvexHull::Edge& edge_a = a.hull->edges()[separation.first];
  const ConvexHull::Edge& edge_b = b.hull->edges()[separation.second];
  const Vec3& on_a = a.vertices[edge_a.from];
  const Vec3& on_b = b.vertices[edge_b.from];
  Vec3 along_a = a.vertices[edge_a.to] - on_a;
  Vec3 along_b = b.vertices[edge_b.to] - on_b;
  const double length_a = along_a.norm(), length_b = along_b.norm();
  along_a /= length_a;
  along_b /= length_b;
  const Vec3 between = on_b - on_a;
  const double cosine = along_a.dot(along_b);
  const double square_sine = 1 - cosine * cosine;
  const double s = (along_a.dot(between) - cosine * along_b.dot(between)) / square_sine;
  const double t = (cosine * along_a.dot(between) - along_b.dot(between)) / square_sine;
  const Vec3 middle =
      0.5 * (on_a + std::clamp(s, 0.0, length_a) * along_a + on_b + std::clamp(t, 0.0, length_b) * along_b);
  add_point(manifold, middle, -separation.gap, 0x2000000u | separation.first << 10 | separation.second, margin);
}

}  // namespace

Manifold collide_polyhedra(const Polyhedron& a, const Polyhedron& b, double margin, double reach) {
  using Kind = PolyhedraSeparation::Kind;
  Manifold manifold;
  const PolyhedraSeparation separation = separation_of(a, b, margin, reach);
  manifold.normal = separation.normal;
  if (separation.gap > margin) return manifold;
  const bool only_distance = separation.gap > 0 && std::isinf(margin);
  if (separation.kind == Kind::edges) {
    cross_two_edges(manifold, separation, a, b, reach);
  } else if (!only_distance) {
    const bool of_a = separation.kind == Kind::face_a;
    clip_onto_face(manifold, of_a ? a : b, separation.first, of_a ? b : a, separation.second, reach, of_a ? 0 : 1);
  }
  if (manifold.count == 0) {
    // Corners past each other: the face's sides leave nothing, yet no direction separates the polyhedra by more.
    const bool of_a = separation.kind == Kind::face_a;
    const Vec3& corner = of_a ? b.vertices[separation.second] : a.vertices[separation.second];
    const double half = of_a ? -0.5 : 0.5;
    add_point(manifold, corner + half * separation.gap * separation.normal, -separation.gap, 0x3000000u, reach);
  }
  return manifold;
}

Manifold collide(const Hull& a, const Placed& at_a, const Hull& b, const Placed& at_b, double margin, double reach) {
  const Mat3 into = at_a.axes.transpose();
  PolyhedronRoom room;
  const Polyhedron other = polyhedron(b, into * at_b.axes, into * (at_b.center - at_a.center), room);
  return to_world(collide_polyhedra(polyhedron(a), other, margin, reach), at_a);
}

Manifold collide(const Hull& a, const Placed& at_a, const Box& b, const Placed& at_b, double margin, double reach) {
  const Mat3 into = at_a.axes.transpose();
  PolyhedronRoom room;
  const Polyhedron other = polyhedron(b, into * at_b.axes, into * (at_b.center - at_a.center), room);
  return to_world(collide_polyhedra(polyhedron(a), other, margin, reach), at_a);
}

}  // namespace tweenfall::collision
