#include "collision/passage.h"

#include <tweenfall/physics/contact.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "collision/surfaces/surface.h"
#include "shapes/placed.h"

namespace tweenfall::collision {

namespace {

double support_along(const Passage& passage, const Vec3& direction) {
  return shapes::support_along(passage.course.shape->solid, passage.placed.axes, direction);
}

/// The face with this normal, up to rounding; empty if there is none.
std::optional<Vec3> face_along(const Passage& passage, const Vec3& normal) {
  const Vec3 local = passage.placed.axes.transpose() * normal;
  const auto is = [&](const Vec3& face) { return (face - local).squaredNorm() < 1e-24; };
  if (const auto* hull = std::get_if<Hull>(&passage.course.shape->solid)) {
    for (const ConvexHull::Face& face : hull->convex.faces())
      if (is(face.normal)) return face.normal;
    return std::nullopt;
  }
  for (int i = 0; i < 3; ++i) {
    const Vec3 face = Vec3::Unit(i) * (local[i] < 0 ? -1.0 : 1.0);
    if (is(face)) return face;
  }
  return std::nullopt;
}

}  // namespace

Passage passage_of(const state::Body& body, const forces::Load& load, double dt) {
  Passage passage{&body, shapes::place(body.shape(), body.motion.pose), course_of(body, load, dt)};
  passage.spin = passage.course.angular.norm();
  passage.swing = passage.course.swing;
  passage.radius = body.radius();
  const Solid& solid = body.shape().solid;
  passage.simple = !surfaces::surface_of(solid) && !std::holds_alternative<Compound>(solid);
  passage.boundless = std::isinf(passage.radius);
  return passage;
}

Passage passage_of_part(const Passage& whole, const Shape& part) {
  Passage passage = whole;
  passage.course.shape = &part;
  passage.placed = shapes::place(part, whole.body->motion.pose);
  return passage;
}

Apart apart_along(const Passage& a, const Passage& b, const Vec3& normal) {
  if (!is_polyhedron(a.course.shape->solid) || !is_polyhedron(b.course.shape->solid))
    return {Apart::Frame::a, a.placed.axes.transpose() * normal};
  if (const std::optional<Vec3> face = face_along(a, normal)) return {Apart::Frame::a, *face};
  if (const std::optional<Vec3> face = face_along(b, -normal)) return {Apart::Frame::b, -*face};
  return {};
}

double gap_along(const Passage& a, const Passage& b, const Vec3& direction) {
  return direction.dot(b.placed.center - a.placed.center) - support_along(a, direction) - support_along(b, -direction);
}

int corners_within(const Passage& passage, const Vec3& direction, double depth) {
  const Vec3 local = passage.placed.axes.transpose() * direction;
  if (const auto* box = std::get_if<Box>(&passage.course.shape->solid)) {
    const Vec3 deep = 2 * local.cwiseAbs().cwiseProduct(box->half_extents);
    int count = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      double below = 0;
      for (int i = 0; i < 3; ++i)
        if ((corner >> static_cast<unsigned>(i) & 1u) != 0) below += deep[i];
      if (below <= depth) ++count;
    }
    return count;
  }
  const auto* hull = std::get_if<Hull>(&passage.course.shape->solid);
  if (!hull) return std::numeric_limits<int>::max();
  const std::span<const Vec3> vertices = hull->convex.vertices();
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : vertices) most = std::max(most, local.dot(vertex));
  return static_cast<int>(std::count_if(vertices.begin(), vertices.end(),
                                        [&](const Vec3& vertex) { return local.dot(vertex) >= most - depth; }));
}

bool stay_apart(const Passage& a, const Passage& b, const Vec3& direction, double gap, double near_enough, double dt) {
  const double rounding = 1e-14 * (a.placed.center.norm() + b.placed.center.norm());
  if (!(gap > 1.000001 * near_enough + rounding)) return false;
  if ((a.boundless && a.spin > 0) || (b.boundless && b.spin > 0)) return false;
  return stay_apart(a.course, b.course, direction, gap - rounding, 0, dt);
}

}  // namespace tweenfall::collision
