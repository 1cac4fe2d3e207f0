#include <algorithm>
#include <cmath>

#include "collision/collide_pairs.h"

namespace tweenfall::collision {

namespace {

/// Sine of the angle below which two axes count as parallel, so that two points carry the contact.
constexpr double parallel_sine = 0.05;

}  // namespace

Manifold collide(const Capsule& a, const shapes::Placed& at_a, const Capsule& b, const shapes::Placed& at_b,
                 double margin) {
  const Vec3 axis_a = at_a.axes.col(1);
  const Vec3 axis_b = at_b.axes.col(1);
  const Vec3 between = at_b.center - at_a.center;
  const double cosine = axis_a.dot(axis_b);
  const double along_a = axis_a.dot(between);
  const double along_b = axis_b.dot(between);
  const double square_sine = std::max(0.0, 1 - cosine * cosine);

  // Nearest points of the two segments. Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9.
  double s = 0;
  if (square_sine > 1e-12)
    s = std::clamp((along_a - cosine * along_b) / square_sine, -a.half_height, a.half_height);
  else
    s = std::clamp(along_a, -a.half_height, a.half_height);
  double t = cosine * s - along_b;
  if (t < -b.half_height || t > b.half_height) {
    t = std::clamp(t, -b.half_height, b.half_height);
    s = std::clamp(along_a + cosine * t, -a.half_height, a.half_height);
  }
  // Crossed axes that meet: the normal is their common perpendicular.
  Vec3 fallback = axis_a.cross(axis_b);
  fallback = fallback.norm() > 1e-6 ? Vec3(fallback / fallback.norm()) : Vec3(at_a.axes.col(0));
  Manifold manifold =
      collide_balls(at_a.center + s * axis_a, a.radius, at_b.center + t * axis_b, b.radius, fallback, 0, margin);
  if (square_sine > parallel_sine * parallel_sine || a.half_height == 0 || b.half_height == 0) return manifold;

  // Side by side: the ends of the stretch that both share, along a.
  const double reach = b.half_height * std::abs(cosine);
  const double low = std::max(-a.half_height, along_a - reach);
  const double high = std::min(a.half_height, along_a + reach);
  if (high - low <= 1e-3 * (a.radius + b.radius)) return manifold;
  const Vec3 normal = manifold.normal;
  // A normal that leans along the axes belongs to two ends that meet, not to two sides.
  if (std::abs(normal.dot(axis_a)) > 0.2) return manifold;
  Manifold both;
  both.normal = normal;
  std::uint32_t feature = 1;
  for (const double place_on_a : {low, high}) {
    const double place_on_b = std::clamp((place_on_a - along_a) / cosine, -b.half_height, b.half_height);
    const Vec3 on_a = at_a.center + place_on_a * axis_a;
    const Vec3 on_b = at_b.center + place_on_b * axis_b;
    const double penetration = a.radius + b.radius - normal.dot(on_b - on_a);
    add_point(both, on_a + normal * (a.radius - 0.5 * penetration), penetration, feature++, margin);
  }
  return both.count > 0 ? both : manifold;
}

}  // namespace tweenfall::collision
