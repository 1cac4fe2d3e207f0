#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "collision/collide_pairs.h"
#include "pairs/contact_candidates.h"

namespace tweenfall::collision {

using shapes::Placed;

namespace {

struct Separation {
  double gap = -1e300;
  Vec3 normal{0, 0, 0};  ///< from a toward b, world
  enum { face_a, face_b, edges } kind = face_a;
  int first = 0, second = 0;  ///< axes of a and of b that are meant
};

Vec3 support(const Box& box, const Placed& at, const Vec3& direction) {
  Vec3 point = at.center;
  for (int i = 0; i < 3; ++i) {
    const double side = at.axes.col(i).dot(direction) < 0 ? -1 : 1;
    point += side * box.half_extents[i] * at.axes.col(i);
  }
  return point;
}

/// Whether the gap at one face is the answer, so that no other direction need be tried: if apart, the other's nearest
/// corner lies over the face, and nothing is nearer; if overlapping, no other face is a shorter way out for that
/// corner.
/// @param out  the face's normal
bool is_all(const Box& one, const Placed& at_one, int axis, double gap, const Box& other, const Placed& at_other,
            const Vec3& out) {
  const Vec3 corner = at_one.axes.transpose() * (support(other, at_other, -out) - at_one.center);
  const double most = std::min(0.0, gap);
  if (one.half_extents[axis] < -gap) return false;
  for (int i = 0; i < 3; ++i)
    if (i != axis && std::abs(corner[i]) - one.half_extents[i] > most) return false;
  return true;
}

/// The axis along which the boxes are farthest apart, or overlap least. Near ties go to a's faces, then b's, then to
/// edges, so that the choice does not change from step to step; but an axis that separates them by more than the margin
/// is taken anyway. Source: Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996.
Separation widest(const Box& a, const Placed& at_a, const Box& b, const Placed& at_b, double margin) {
  const Mat3 turn = at_a.axes.transpose() * at_b.axes;
  const Mat3 reach = turn.cwiseAbs();
  const Vec3 between = at_b.center - at_a.center;
  const Vec3 in_a = at_a.axes.transpose() * between;
  const Vec3 in_b = at_b.axes.transpose() * between;
  const double size = std::min(a.half_extents.minCoeff(), b.half_extents.minCoeff());
  const double preference = 2e-3 * size;
  Separation best;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::abs(in_a[i]) - a.half_extents[i] - reach.row(i).dot(b.half_extents);
    if (gap > best.gap + (i == 0 ? 0 : 0.1 * preference) || (gap > margin && gap > best.gap))
      best = {gap, at_a.axes.col(i) * (in_a[i] < 0 ? -1.0 : 1.0), Separation::face_a, i, 0};
  }
  const Separation first = best;
  Separation other;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::abs(in_b[i]) - b.half_extents[i] - reach.col(i).dot(a.half_extents);
    if (gap > other.gap + (i == 0 ? 0 : 0.1 * preference) || (gap > margin && gap > other.gap))
      other = {gap, at_b.axes.col(i) * (in_b[i] < 0 ? -1.0 : 1.0), Separation::face_b, 0, i};
  }
  if (other.gap > best.gap + preference || (other.gap > margin && other.gap > best.gap)) best = other;
  if (best.gap > margin) return best;
  // Usually a corner of one lies over a face of the other, and then no edge gives a wider gap.
  if (is_all(a, at_a, first.first, first.gap, b, at_b, first.normal) ||
      is_all(b, at_b, other.second, other.gap, a, at_a, -other.normal))
    return best;
  Separation edge;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      Vec3 axis = at_a.axes.col(i).cross(at_b.axes.col(k));
      const double length = axis.norm();
      if (length < 1e-3) continue;  // parallel edges: a face covers this
      axis /= length;
      if (axis.dot(between) < 0) axis = -axis;
      const double gap = axis.dot(between) - (at_a.axes.transpose() * axis).cwiseAbs().dot(a.half_extents) -
                         (at_b.axes.transpose() * axis).cwiseAbs().dot(b.half_extents);
      if (gap > edge.gap + (edge.gap < -1e299 ? 0 : 0.1 * preference)) edge = {gap, axis, Separation::edges, i, k};
    }
  if (edge.gap > best.gap + 2 * preference) best = edge;
  return best;
}

struct ClipVertex {
  Vec3 position;
  std::uint32_t feature;
};

/// A convex polygon being cut; a box's face cut by four planes has at most eight corners.
struct Polygon {
  std::array<ClipVertex, 12> vertices;
  std::size_t count = 0;
  void add(const Vec3& position, std::uint32_t feature) {
    if (count < vertices.size()) vertices[count++] = {position, feature};
  }
};

/// Keeps the part behind the plane. New corners are named by the plane and the edge it cut.
Polygon cut(const Polygon& polygon, const Vec3& normal, double offset, std::uint32_t plane, double tolerance) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipVertex& from = polygon.vertices[i];
    const ClipVertex& to = polygon.vertices[(i + 1) % polygon.count];
    const double at_from = normal.dot(from.position) - offset;
    const double at_to = normal.dot(to.position) - offset;
    // A corner on the plane stays the same corner on whichever side rounding puts it.
    if (at_from <= tolerance) result.add(from.position, from.feature);
    if ((at_from < -tolerance && at_to > tolerance) || (at_from > tolerance && at_to < -tolerance)) {
      const Vec3 position = from.position + (to.position - from.position) * (at_from / (at_from - at_to));
      const std::uint32_t low = std::min(from.feature, to.feature) & 0xffu;
      const std::uint32_t high = std::max(from.feature, to.feature) & 0xffu;
      result.add(position, 0x1000000u | plane << 16 | high << 8 | low);
    }
  }
  return result;
}

/// One box's face against the other box: the incident face cut by the sides of the reference face.
/// `normal` points out of the reference box.
void clip_faces(Manifold& manifold, const Box& reference, const Placed& at_reference, int axis, const Vec3& normal,
                const Box& incident, const Placed& at_incident, double margin, std::uint32_t tag) {
  int facing = 0;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const double along = std::abs(at_incident.axes.col(i).dot(normal));
    if (along > most + 1e-6) {
      most = along;
      facing = i;
    }
  }
  const double side = at_incident.axes.col(facing).dot(normal) > 0 ? -1 : 1;
  const int u = (facing + 1) % 3, v = (facing + 2) % 3;
  const Vec3 middle = at_incident.center + side * incident.half_extents[facing] * at_incident.axes.col(facing);
  const Vec3 along_u = incident.half_extents[u] * at_incident.axes.col(u);
  const Vec3 along_v = incident.half_extents[v] * at_incident.axes.col(v);
  Polygon polygon;
  const std::uint32_t face = static_cast<std::uint32_t>(2 * facing + (side > 0)) << 3;
  polygon.add(middle - along_u - along_v, face | 0u);
  polygon.add(middle + along_u - along_v, face | 1u);
  polygon.add(middle + along_u + along_v, face | 2u);
  polygon.add(middle - along_u + along_v, face | 3u);
  const double tolerance = 1e-4 * reference.half_extents.minCoeff();
  for (int step = 1; step <= 2; ++step) {
    const int i = (axis + step) % 3;
    const Vec3 out = at_reference.axes.col(i);
    const double at = out.dot(at_reference.center);
    polygon = cut(polygon, out, at + reference.half_extents[i], static_cast<std::uint32_t>(2 * i), tolerance);
    polygon = cut(polygon, -out, -at + reference.half_extents[i], static_cast<std::uint32_t>(2 * i + 1), tolerance);
  }
  const double surface = normal.dot(at_reference.center) + reference.half_extents[axis];
  std::array<pairs::ContactCandidate, 12> candidates;
  std::size_t count = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipVertex& vertex = polygon.vertices[i];
    const double gap = normal.dot(vertex.position) - surface;
    if (gap <= margin) candidates[count++] = {vertex.position, gap, vertex.feature};
  }
  const Vec3 leaning = at_reference.axes.col((axis + 1) % 3) + 0.37 * at_reference.axes.col((axis + 2) % 3);
  count = pairs::reduce_to_four(std::span(candidates.data(), count), normal, leaning);
  for (std::size_t i = 0; i < count; ++i)
    add_point(manifold, candidates[i].position - 0.5 * candidates[i].gap * normal, -candidates[i].gap,
              candidates[i].feature | tag << 28, margin);
}

/// For corners past each other: the sides of the face leave nothing, yet no axis separates the boxes by more. Takes
/// what reaches deepest under the face, a corner or both ends of an edge, moved back to its sides. `normal` points out
/// of the reference box.
void take_deepest(Manifold& manifold, const Box& reference, const Placed& at_reference, int axis, const Vec3& normal,
                  const Box& incident, const Placed& at_incident, double gap, double reach) {
  constexpr double level = 1e-4;  // of a size
  const Vec3 corner = support(incident, at_incident, -normal);
  const auto back_to_face = [&](const Vec3& place) -> Vec3 {
    Vec3 at = at_reference.axes.transpose() * (place - at_reference.center);
    for (int i = 0; i < 3; ++i)
      if (i != axis) at[i] = std::clamp(at[i], -reference.half_extents[i], reference.half_extents[i]);
    return at_reference.center + at_reference.axes * at;
  };
  int lying = -1;
  for (int i = 0; i < 3; ++i)
    if (std::abs(at_incident.axes.col(i).dot(normal)) < level &&
        (lying < 0 || incident.half_extents[i] > incident.half_extents[lying]))
      lying = i;
  if (lying < 0) {
    add_point(manifold, corner - 0.5 * gap * normal, -gap, 0x3000000u, reach);
    return;
  }
  const Vec3 along = at_incident.axes.col(lying);
  const double middle = along.dot(corner - at_incident.center);
  std::uint32_t feature = 0x3000000u;
  for (const double end : {-incident.half_extents[lying], incident.half_extents[lying]}) {
    Vec3 place = back_to_face(corner + (end - middle) * along);
    place -= (normal.dot(place - corner) + 0.5 * gap) * normal;
    if (manifold.count > 0 && (place - manifold.points[0].position).norm() <= level * incident.half_extents[lying])
      return;
    add_point(manifold, place, -gap, ++feature, reach);
  }
}

/// Two edges that cross: their nearest points.
void cross_edges(Manifold& manifold, const Separation& separation, const Box& a, const Placed& at_a, const Box& b,
                 const Placed& at_b, double margin) {
  const Vec3 on_a = support(a, at_a, separation.normal);
  const Vec3 on_b = support(b, at_b, -separation.normal);
  const Vec3 along_a = at_a.axes.col(separation.first);
  const Vec3 along_b = at_b.axes.col(separation.second);
  const Vec3 between = on_b - on_a;
  const double cosine = along_a.dot(along_b);
  const double square_sine = 1 - cosine * cosine;
  const double s = (along_a.dot(between) - cosine * along_b.dot(between)) / square_sine;
  const double t = (cosine * along_a.dot(between) - along_b.dot(between)) / square_sine;
  const Vec3 middle = 0.5 * (on_a + s * along_a + on_b + t * along_b);
  add_point(manifold, middle, -separation.gap,
            0x2000000u | static_cast<std::uint32_t>(separation.first * 3 + separation.second), margin);
}

}  // namespace

Manifold collide(const Box& a, const Placed& at_a, const Box& b, const Placed& at_b, double margin, double reach) {
  Manifold manifold;
  const Separation separation = widest(a, at_a, b, at_b, margin);
  manifold.normal = separation.normal;
  if (separation.gap > margin) return manifold;
  if (separation.kind == Separation::face_a) {
    clip_faces(manifold, a, at_a, separation.first, separation.normal, b, at_b, reach, 0);
  } else if (separation.kind == Separation::face_b) {
    clip_faces(manifold, b, at_b, separation.second, -separation.normal, a, at_a, reach, 1);
  } else {
    cross_edges(manifold, separation, a, at_a, b, at_b, reach);
  }
  if (manifold.count == 0) {
    if (separation.kind == Separation::edges)
      add_point(manifold, support(b, at_b, -separation.normal) - 0.5 * separation.gap * separation.normal,
                -separation.gap, 0x3000000u, reach);
    else if (separation.kind == Separation::face_b)
      take_deepest(manifold, b, at_b, separation.second, -separation.normal, a, at_a, separation.gap, reach);
    else
      take_deepest(manifold, a, at_a, separation.first, separation.normal, b, at_b, separation.gap, reach);
  }
  return manifold;
}

}  // namespace tweenfall::collision
