#include "queries/core.h"

#include <cmath>

#include "shapes/turned.h"

namespace tweenfall::queries {

namespace {

// Farthest points of the cores along a direction, in the solids' own axes.

Vec3 farthest_of(const Sphere&, const Vec3&) {
  return {0, 0, 0};
}

Vec3 farthest_of(const Box& box, const Vec3& direction) {
  return {std::copysign(box.half_extents.x(), direction.x()), std::copysign(box.half_extents.y(), direction.y()),
          std::copysign(box.half_extents.z(), direction.z())};
}

Vec3 farthest_of(const Capsule& capsule, const Vec3& direction) {
  return {0, std::copysign(capsule.half_height, direction.y()), 0};
}

Vec3 farthest_of(const Hull& hull, const Vec3& direction) {
  const std::span<const Vec3> vertices = hull.convex.vertices();
  std::size_t best = 0;
  double most = direction.dot(vertices[0]);
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const double along = direction.dot(vertices[i]);
    if (!(along > most)) continue;
    most = along;
    best = i;
  }
  return vertices[best];
}

// Their parts and triangles are asked one by one.
Vec3 farthest_of(const Compound&, const Vec3&) {
  return {0, 0, 0};
}
Vec3 farthest_of(const TriangleMesh&, const Vec3&) {
  return {0, 0, 0};
}
Vec3 farthest_of(const HeightField&, const Vec3&) {
  return {0, 0, 0};
}

Vec3 farthest_of(const std::array<Vec3, 3>& triangle, const Vec3& direction) {
  const Vec3& first = direction.dot(triangle[1]) > direction.dot(triangle[0]) ? triangle[1] : triangle[0];
  return direction.dot(triangle[2]) > direction.dot(first) ? triangle[2] : first;
}

template <class Turned>
Vec3 farthest_of(const Turned& solid, const Vec3& direction) {
  return shapes::farthest(solid, direction);
}

Vec3 farthest_of(const Plane&, const Vec3&) {
  return {0, 0, 0};
}

double skin_of(const Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&solid)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&solid)) return capsule->radius;
  return 0;
}

}  // namespace

Vec3 Core::farthest(const Vec3& direction) const {
  const Vec3 local = at.axes.transpose() * direction;
  if (triangle) return at.center + at.axes * farthest_of(*triangle, local);
  return at.center + at.axes * std::visit([&local](const auto& kind) { return farthest_of(kind, local); }, *solid);
}

Core core_of(const Shape& shape, const Pose& pose) {
  return {&shape.solid, shapes::place(shape, pose), skin_of(shape.solid)};
}

}  // namespace tweenfall::queries
