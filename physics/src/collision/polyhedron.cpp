#include "collision/polyhedron.h"

namespace tweenfall::collision {

namespace {

/// From -1 to 1 along each axis; bit i of a vertex's number gives its side along axis i.
const ConvexHull& cube() {
  static const ConvexHull hull = [] {
    std::array<Vec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i) corners[i] = Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return ConvexHull(corners);
  }();
  return hull;
}

Polyhedron stretched(const ConvexHull& hull, const Vec3& scale, const Mat3& turn, const Vec3& shift,
                     PolyhedronRoom& room) {
  const std::size_t vertices = hull.vertices().size(), faces = hull.faces().size();
  for (std::size_t i = 0; i < vertices; ++i) room.vertices[i] = shift + turn * hull.vertices()[i].cwiseProduct(scale);
  for (std::size_t i = 0; i < faces; ++i) {
    room.faces[i] = hull.faces()[i];
    room.faces[i].normal = turn * hull.faces()[i].normal;
    room.faces[i].offset += room.faces[i].normal.dot(shift);
  }
  return {&hull, std::span(room.vertices).first(vertices), std::span(room.faces).first(faces), hull.inner_radius(),
          nullptr};
}

}  // namespace

std::uint32_t Polyhedron::farthest(const Vec3& direction, std::uint32_t from) const {
  if (axes) {
    std::uint32_t corner = 0;
    for (int i = 0; i < 3; ++i)
      if (axes->col(i).dot(direction) > 0) corner |= 1u << i;
    return corner;
  }
  double most = direction.dot(vertices[from]);
  for (;;) {
    const std::uint32_t here = from;
    for (const std::uint32_t neighbor : hull->neighbors(here)) {
      const double along = direction.dot(vertices[neighbor]);
      if (along > most) {
        most = along;
        from = neighbor;
      }
    }
    if (from == here) return here;
  }
}

Polyhedron polyhedron(const Hull& hull, const Mat3& turn, const Vec3& shift, PolyhedronRoom& room) {
  return stretched(hull.convex, Vec3(1, 1, 1), turn, shift, room);
}

Polyhedron polyhedron(const Box& box, const Mat3& turn, const Vec3& shift, PolyhedronRoom& room) {
  Polyhedron result = stretched(cube(), box.half_extents, turn, shift, room);
  for (std::size_t i = 0; i < result.faces.size(); ++i) {
    ConvexHull::Face& face = room.faces[i];
    face.offset = face.normal.dot(shift) + cube().faces()[i].normal.cwiseAbs().dot(box.half_extents);
  }
  result.size = box.half_extents.minCoeff();
  room.axes = turn;
  result.axes = &room.axes;
  return result;
}

Polyhedron polyhedron(const Hull& hull) {
  return {&hull.convex, hull.convex.vertices(), hull.convex.faces(), hull.convex.inner_radius(), nullptr};
}

}  // namespace tweenfall::collision
