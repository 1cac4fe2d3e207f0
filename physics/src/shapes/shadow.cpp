#include "shapes/shadow.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::shapes {

namespace {

constexpr double half_turn = std::numbers::pi;

struct Slant {
  double sine, cosine;  ///< of the angle to the y axis, both >= 0
};
Slant slant_of(const Vec3& direction) {
  return {std::sqrt(direction.x() * direction.x() + direction.z() * direction.z()), std::abs(direction.y())};
}

double look(const Sphere& sphere, const Vec3&) {
  return half_turn * sphere.radius * sphere.radius;
}
double look(const Box& box, const Vec3& direction) {
  const Vec3& half = box.half_extents;
  return 4 * (std::abs(direction.x()) * half.y() * half.z() + std::abs(direction.y()) * half.z() * half.x() +
              std::abs(direction.z()) * half.x() * half.y());
}
/// Two circles and the area between them.
double look(const TaperedCapsule& capsule, const Vec3& direction) {
  const double apart = 2 * capsule.half_height * slant_of(direction).sine;
  const double greater = std::max(capsule.bottom_radius, capsule.top_radius);
  const double less = std::min(capsule.bottom_radius, capsule.top_radius), more = greater - less;
  if (apart <= more) return half_turn * greater * greater;
  const double lean = elementary::asin(more / apart);
  return (greater + less) * std::sqrt((apart - more) * (apart + more)) + greater * greater * (half_turn / 2 + lean) +
         less * less * (half_turn / 2 - lean);
}
double look(const Capsule& capsule, const Vec3& direction) {
  return half_turn * capsule.radius * capsule.radius +
         4 * capsule.radius * capsule.half_height * slant_of(direction).sine;
}
double look(const Cylinder& cylinder, const Vec3& direction) {
  const Slant slant = slant_of(direction);
  return half_turn * cylinder.radius * cylinder.radius * slant.cosine +
         4 * cylinder.radius * cylinder.half_height * slant.sine;
}
/// The base, an ellipse, and the tip, from which two lines touch it.
double look(const Cone& cone, const Vec3& direction) {
  const Slant slant = slant_of(direction);
  const double tip = 2 * cone.half_height * slant.sine, near = cone.radius * slant.cosine;
  const double base = half_turn * cone.radius * near;
  if (tip <= near) return base;
  return cone.radius * (near * (half_turn - elementary::acos(near / tip)) + std::sqrt((tip - near) * (tip + near)));
}
double look(const Hull& hull, const Vec3& direction) {
  const std::span<const Vec3> vertices = hull.convex.vertices();
  double twice = 0;
  for (const ConvexHull::Face& face : hull.convex.faces()) {
    const std::span<const std::uint32_t> corners = hull.convex.corners(face);
    Vec3 area(0, 0, 0);
    for (std::size_t i = 2; i < corners.size(); ++i)
      area +=
          0.5 * (vertices[corners[i - 1]] - vertices[corners[0]]).cross(vertices[corners[i]] - vertices[corners[0]]);
    twice += std::abs(area.dot(direction));
  }
  return 0.5 * twice;
}
double look(const Compound& compound, const Vec3& direction) {
  double sum = 0;
  for (const Shape& part : compound.parts()) sum += shadow_of(part, direction);
  return sum;
}
// Scenery does not move.
template <class Scenery>
double look(const Scenery&, const Vec3&) {
  return 0;
}

}  // namespace

double shadow_of(const Shape& shape, const Vec3& direction) {
  const Vec3 own = shape.offset.rotation.conjugate() * direction;
  return std::visit([&](const auto& solid) { return look(solid, own); }, shape.solid);
}

}  // namespace tweenfall::shapes
