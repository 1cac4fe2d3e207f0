#include "collision/convex/core.h"

#include <algorithm>
#include <cmath>

#include "shapes/turned.h"

namespace tweenfall::convex {

using shapes::Placed;

namespace {

Core placed_core(Core::Kind kind, const Vec3& half, double radius, const Placed& at) {
  Core core;
  core.kind = kind;
  core.half = half;
  core.radius = radius;
  core.turn = at.axes;
  core.shift = at.center;
  return core;
}

/// The hull's vertex farthest along a direction, found by climbing from another one.
std::uint32_t climbed(const ConvexHull& hull, const Vec3& direction, std::uint32_t from) {
  const std::span<const Vec3> vertices = hull.vertices();
  double most = direction.dot(vertices[from]);
  for (;;) {
    const std::uint32_t here = from;
    for (const std::uint32_t neighbor : hull.neighbors(here)) {
      const double along = direction.dot(vertices[neighbor]);
      if (along > most) {
        most = along;
        from = neighbor;
      }
    }
    if (from == here) return here;
  }
}

/// A triangle or, if it reaches behind itself, a prism. Its normal is its second axis.
Vec3 farthest_of_triangle(const Core& core, const Vec3& direction) {
  const std::array<Vec3, 3>& corners = *core.corners;
  std::size_t best = 0;
  double most = direction.dot(corners[0]);
  for (std::size_t i = 1; i < 3; ++i) {
    const double along = direction.dot(corners[i]);
    if (!(along > most)) continue;
    most = along;
    best = i;
  }
  const Vec3 normal = core.turn.col(1);
  return core.back > 0 && direction.dot(normal) < 0 ? Vec3(corners[best] - core.back * normal) : corners[best];
}

/// A ball at one end and a point at the other.
Vec3 farthest_of_drop(const Vec3& half, const Vec3& direction) {
  const double length = direction.norm();
  const Vec3 ball(0, half.y(), 0);
  if (!(2 * half.y() * direction.y() + half.x() * length > 0) || !(length > 0)) return -ball;
  return ball + half.x() / length * direction;
}

}  // namespace

Vec3 Core::support(const Vec3& direction) {
  const Vec3 local = turn.transpose() * direction;
  switch (kind) {
    case Kind::point:
      return shift;
    case Kind::segment:
      return place({0, local.y() < 0 ? -half.y() : half.y(), 0});
    case Kind::box:
      return place({local.x() < 0 ? -half.x() : half.x(), local.y() < 0 ? -half.y() : half.y(),
                    local.z() < 0 ? -half.z() : half.z()});
    case Kind::hull:
      vertex = climbed(*hull, local, vertex);
      return place(hull->vertices()[vertex]);
    case Kind::cylinder:
      return place(shapes::farthest(Cylinder{half.x(), half.y()}, local));
    case Kind::cone:
      return place(shapes::farthest(Cone{half.x(), half.y()}, local));
    case Kind::drop:
      return place(farthest_of_drop(half, local));
    case Kind::triangle:
      return farthest_of_triangle(*this, direction);
  }
  return shift;
}

Core core_of(const Sphere& sphere, const Placed& at) {
  Core core = placed_core(Core::Kind::point, {0, 0, 0}, sphere.radius, at);
  core.size = sphere.radius;
  return core;
}

Core core_of(const Box& box, const Placed& at) {
  Core core = placed_core(Core::Kind::box, box.half_extents, 0, at);
  core.size = box.half_extents.minCoeff();
  core.reach = box.half_extents.norm();
  return core;
}

Core core_of(const Capsule& capsule, const Placed& at) {
  Core core = placed_core(Core::Kind::segment, {0, capsule.half_height, 0}, capsule.radius, at);
  core.size = capsule.radius;
  core.reach = capsule.half_height;
  return core;
}

Core core_of(const Hull& hull, const Placed& at) {
  Core core = placed_core(Core::Kind::hull, {0, 0, 0}, 0, at);
  core.hull = &hull.convex;
  core.size = hull.convex.inner_radius();
  core.reach = hull.convex.measures().center.norm() + hull.convex.outer_radius();
  return core;
}

Core core_of(const Cylinder& cylinder, const Placed& at) {
  const Vec3 half(cylinder.radius, cylinder.half_height, cylinder.radius);
  Core core = placed_core(Core::Kind::cylinder, half, 0, at);
  core.size = half.minCoeff();
  core.reach = shapes::radius_of(cylinder);
  return core;
}

Core core_of(const Cone& cone, const Placed& at) {
  const Vec3 half(cone.radius, cone.half_height, cone.radius);
  Core core = placed_core(Core::Kind::cone, half, 0, at);
  core.size = 0.5 * half.minCoeff();
  core.reach = half.norm();
  return core;
}

Core core_of(const TaperedCapsule& capsule, const Placed& at) {
  const double thin = std::min(capsule.bottom_radius, capsule.top_radius);
  const double thick = std::max(capsule.bottom_radius, capsule.top_radius);
  const bool up = capsule.top_radius > capsule.bottom_radius;
  const Vec3 half(thick - thin, up ? capsule.half_height : -capsule.half_height, 0);
  Core core = placed_core(Core::Kind::drop, half, thin, at);
  core.size = thin;
  core.reach = capsule.half_height + half.x();
  return core;
}

Core core_of(const std::array<Vec3, 3>& triangle, const Vec3& normal) {
  Core core;
  core.kind = Core::Kind::triangle;
  core.corners = &triangle;
  core.turn.col(1) = normal;
  core.shift = (triangle[0] + triangle[1] + triangle[2]) / 3;
  for (const Vec3& corner : triangle) core.reach = std::max(core.reach, (corner - core.shift).norm());
  core.size = core.reach;
  return core;
}

}  // namespace tweenfall::convex
