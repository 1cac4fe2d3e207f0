#include "shapes/mirrored.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::shapes {

namespace {

/// Rounding of a direction, rad: many turns one after another add up to less.
constexpr double turned_off = 1e-11;
/// Rounding of places, as a part of a solid's size, and of the distance from the world's origin.
constexpr double moved_off = 1e-12, far_off = 1e-14;

bool none(double part) {
  return std::abs(part) <= turned_off;
}
bool all_of_it(double part) {
  return std::abs(std::abs(part) - 1) <= turned_off;
}

/// A mirror as a solid sees it.
struct OwnMirror {
  Vec3 normal;   ///< unit, the solid's own axes
  double away;   ///< from its center along the normal, m
  double blur;   ///< rounding of this, m
  double reach;  ///< of what it is seen by, from the mirror, m

  [[nodiscard]] bool halves(double size) const { return std::abs(away) <= blur + moved_off * size; }
};

// What a mirror must be for the solid to be its own image as far as it reaches.

bool mirrors(const Sphere& sphere, const OwnMirror& mirror) {
  return mirror.halves(sphere.radius);
}

/// Across one of its axes, or between two along which it is equally long.
bool mirrors(const Box& box, const OwnMirror& mirror) {
  const Vec3 &normal = mirror.normal, &half = box.half_extents;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    if (none(normal[j]) && none(normal[k]))
      return mirror.halves(half[i]) || std::abs(mirror.away) + mirror.reach < half[i];
    if (none(normal[k]) && !none(normal[i]) && !none(normal[j]))
      return std::abs(std::abs(normal[i]) - std::abs(normal[j])) <= turned_off &&
             std::abs(half[i] - half[j]) <= moved_off * half[i] && mirror.halves(half[i]);
  }
  return false;
}

/// Along the axis of a solid of revolution, in which it is at least as large as `radius`.
bool mirrors_along(double radius, const OwnMirror& mirror) {
  return none(mirror.normal.y()) && mirror.halves(radius);
}
bool mirrors(const Capsule& capsule, const OwnMirror& mirror) {
  return mirrors_along(capsule.radius, mirror) || (all_of_it(mirror.normal.y()) && mirror.halves(capsule.radius));
}
bool mirrors(const Cylinder& cylinder, const OwnMirror& mirror) {
  return mirrors_along(cylinder.radius, mirror) ||
         (all_of_it(mirror.normal.y()) &&
          (mirror.halves(cylinder.half_height) || std::abs(mirror.away) + mirror.reach < cylinder.half_height));
}
bool mirrors(const Cone& cone, const OwnMirror& mirror) {
  return mirrors_along(cone.radius, mirror);
}
bool mirrors(const TaperedCapsule& capsule, const OwnMirror& mirror) {
  return mirrors_along(capsule.top_radius, mirror);
}

bool mirrors(const Plane& plane, const OwnMirror& mirror) {
  return none(plane.normal.dot(mirror.normal));
}

bool mirrors(const Hull& hull, const OwnMirror& mirror) {
  const std::span<const Vec3> vertices = hull.convex.vertices();
  const double near = mirror.blur + moved_off * hull.convex.outer_radius();
  return std::ranges::all_of(vertices, [&](const Vec3& vertex) {
    const Vec3 image = vertex + (2 * (mirror.away - mirror.normal.dot(vertex))) * mirror.normal;
    return std::ranges::any_of(vertices,
                               [&](const Vec3& other) { return (other - image).squaredNorm() <= near * near; });
  });
}

bool mirrors(const TriangleMesh& /*mesh*/, const OwnMirror& /*mirror*/) {
  return false;
}
bool mirrors(const HeightField& /*field*/, const OwnMirror& /*mirror*/) {
  return false;
}

bool mirrors(const Compound& compound, const OwnMirror& mirror);

bool mirrors(const Shape& shape, const OwnMirror& mirror) {
  OwnMirror its = mirror;
  its.normal = shape.offset.rotation.conjugate() * mirror.normal;
  its.away -= mirror.normal.dot(shape.offset.position);
  return std::visit([&](const auto& solid) { return mirrors(solid, its); }, shape.solid);
}

/// Each part by itself.
bool mirrors(const Compound& compound, const OwnMirror& mirror) {
  return std::ranges::all_of(compound.parts(), [&](const Shape& part) { return mirrors(part, mirror); });
}

}  // namespace

bool is_mirrored_near(const Shape& shape, const Pose& node, const Mirror& mirror, double reach) {
  const Vec3 normal = node.rotation.conjugate() * mirror.normal;
  const double blur = far_off * (mirror.point.norm() + node.position.norm());
  return mirrors(shape, {normal, mirror.normal.dot(mirror.point - node.position), blur, reach});
}

}  // namespace tweenfall::shapes
