#include "collision/polyhedra_separation.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::collision {

namespace {

/// Sine of the angle below which two edges count as parallel: a face covers this.
constexpr double parallel_edges = 1e-3;
/// By how much a later kind of direction must be better, in parts of a size.
constexpr double kind_preference = 2e-3;

struct FaceGap {
  double gap = -1e300;
  std::uint32_t face = 0, vertex = 0;
};

/// The face of one polyhedron above which the other lies highest, and the other's nearest vertex; faces with gaps up to
/// `level` may be skipped. Near ties go to the first face, but gaps beyond the margin count exactly.
FaceGap widest_face(const Polyhedron& one, const Polyhedron& other, double tie, double level, double margin) {
  FaceGap best;
  for (std::uint32_t i = 0; i < one.faces.size(); ++i) {
    const ConvexHull::Face& face = one.faces[i];
    // No vertex lies lower than the lowest: a known vertex rules out most faces.
    const double at_most = face.normal.dot(other.vertices[best.vertex]) - face.offset;
    if (at_most <= level || (i > 0 && at_most <= (at_most > margin ? best.gap : best.gap + tie))) continue;
    const std::uint32_t vertex = other.farthest(-face.normal, best.vertex);
    const double gap = face.normal.dot(other.vertices[vertex]) - face.offset;
    if (gap > best.gap + (i == 0 || gap > margin ? 0 : tie)) best = {gap, i, vertex};
  }
  return best;
}

/// Whether the gap between a face and a vertex is the answer, so that no other direction need be tried: if apart, the
/// vertex lies over the face, and nothing is nearer; if overlapping, no other face is a shorter way out for the
/// vertex.
bool is_all(const Polyhedron& one, const Polyhedron& other, const FaceGap& told) {
  const Vec3& normal = one.faces[told.face].normal;
  const Vec3 place = other.vertices[told.vertex] - std::max(0.0, told.gap) * normal;
  const double most = std::min(0.0, told.gap);
  for (std::uint32_t i = 0; i < one.faces.size(); ++i)
    if (i != told.face && one.faces[i].normal.dot(place) - one.faces[i].offset > most) return false;
  return true;
}

/// The gap at the face that faces most against a direction.
FaceGap gap_of_opposite(const Polyhedron& one, const Polyhedron& other, const Vec3& normal) {
  FaceGap told;
  double least = 2;
  for (std::uint32_t i = 0; i < one.faces.size(); ++i) {
    const double along = one.faces[i].normal.dot(normal);
    if (along >= least) continue;
    least = along;
    told.face = i;
  }
  const ConvexHull::Face& face = one.faces[told.face];
  told.vertex = other.farthest(-face.normal, 0);
  told.gap = face.normal.dot(other.vertices[told.vertex]) - face.offset;
  return told;
}

using EdgeList = std::array<std::uint16_t, 3 * ConvexHull::most_vertices>;

/// Edges that reach farther than `level` along a direction.
std::span<const std::uint16_t> edges_beyond(const Polyhedron& polyhedron, const Vec3& direction, double level,
                                            EdgeList& list) {
  std::array<bool, ConvexHull::most_vertices> beyond;
  for (std::size_t i = 0; i < polyhedron.vertices.size(); ++i)
    beyond[i] = direction.dot(polyhedron.vertices[i]) >= level;
  std::size_t count = 0;
  const std::span<const ConvexHull::Edge> edges = polyhedron.hull->edges();
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (beyond[edges[i].from] || beyond[edges[i].to]) list[count++] = static_cast<std::uint16_t>(i);
  return std::span(list).first(count);
}

/// Tries pairs of edges, but only those that touch when the polyhedra are moved together: on the sphere of directions,
/// the arc between the normals beside one edge crosses the arc opposite to the other's.
void try_edges(PolyhedraSeparation& best, const Polyhedron& a, const Polyhedron& b,
               std::span<const std::uint16_t> edges_a, std::span<const std::uint16_t> edges_b, double preference) {
  bool any = false;
  const double needed = best.gap + 2 * preference;
  const std::span<const ConvexHull::Edge> all_a = a.hull->edges(), all_b = b.hull->edges();
  for (const std::uint16_t index_a : edges_a) {
    const ConvexHull::Edge& edge_a = all_a[index_a];
    const Vec3& left_a = a.faces[edge_a.left].normal;
    const Vec3& right_a = a.faces[edge_a.right].normal;
    const Vec3 along_a = a.vertices[edge_a.to] - a.vertices[edge_a.from];
    for (const std::uint16_t index_b : edges_b) {
      const ConvexHull::Edge& edge_b = all_b[index_b];
      const double left_b = b.faces[edge_b.left].normal.dot(along_a);
      const double right_b = b.faces[edge_b.right].normal.dot(along_a);
      if (!(left_b * right_b < 0)) continue;
      const Vec3 along_b = b.vertices[edge_b.to] - b.vertices[edge_b.from];
      const double right = right_a.dot(along_b);
      if (!(left_a.dot(along_b) * right < 0) || !(left_b * right < 0)) continue;
      Vec3 axis = along_a.cross(along_b);
      const double length = axis.norm();
      if (length < parallel_edges * along_a.norm() * along_b.norm()) continue;
      axis /= axis.dot(left_a + right_a) < 0 ? -length : length;
      const double gap = axis.dot(b.vertices[edge_b.from] - a.vertices[edge_a.from]);
      if (gap <= (any ? best.gap + 0.1 * preference : needed)) continue;
      best = {PolyhedraSeparation::Kind::edges, gap, axis, index_a, index_b};
      any = true;
    }
  }
}

}  // namespace

PolyhedraSeparation separation_of(const Polyhedron& a, const Polyhedron& b, double margin, double reach) {
  const double size = std::min(a.size, b.size);
  const double preference = kind_preference * size;
  constexpr double any_gap = -1e300;
  // Of a floor, and of any box below a hull, few faces tell all.
  if (b.faces.size() < a.faces.size()) {
    const FaceGap told = widest_face(b, a, 0.1 * preference, any_gap, margin);
    if (is_all(b, a, told))
      return {PolyhedraSeparation::Kind::face_b, told.gap, -b.faces[told.face].normal, told.face, told.vertex};
  }
  const FaceGap face_a = widest_face(a, b, 0.1 * preference, any_gap, margin);
  PolyhedraSeparation best{PolyhedraSeparation::Kind::face_a, face_a.gap, a.faces[face_a.face].normal, face_a.face,
                           face_a.vertex};
  const double level = best.gap > margin ? best.gap : std::min(best.gap + preference, margin);
  const FaceGap face_b = widest_face(b, a, 0.1 * preference, level, margin);
  if (face_b.gap > best.gap + preference || (face_b.gap > margin && face_b.gap > best.gap))
    best = {PolyhedraSeparation::Kind::face_b, face_b.gap, -b.faces[face_b.face].normal, face_b.face, face_b.vertex};
  if (best.gap > margin) return best;

  // Usually a corner of one lies over a face of the other, and then no edge gives a wider gap.
  const bool by_a = best.kind == PolyhedraSeparation::Kind::face_a;
  if (by_a ? is_all(a, b, face_a) || is_all(b, a, gap_of_opposite(b, a, best.normal))
           : is_all(b, a, face_b) || is_all(a, b, gap_of_opposite(a, b, -best.normal)))
    return best;

  // Far apart, the gap at a face is good enough; near, only edges that come near each other can do better.
  if (std::isinf(reach) && best.gap > 0.1 * size) return best;
  const double room = 2 * std::max(0.0, -best.gap) + preference + (std::isinf(reach) ? size : reach);
  const double top_a = by_a ? a.faces[best.first].offset : -b.faces[best.first].offset - best.gap;
  EdgeList list_a, list_b;
  const Vec3 normal = best.normal;
  try_edges(best, a, b, edges_beyond(a, normal, top_a - room, list_a),
            edges_beyond(b, -normal, -(top_a + best.gap) - room, list_b), preference);
  return best;
}

}  // namespace tweenfall::collision
