#include <tweenfall/physics/contact.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/collide_pairs.h"
#include "collision/convex/capsule_on_box.h"
#include "collision/convex/collide_convex.h"
#include "collision/convex/distance.h"
#include "collision/surfaces/touch.h"

namespace tweenfall {

namespace collision {

using shapes::Placed;

namespace {

template <class A, class B>
concept Collides = requires(const A& a, const B& b, const Placed& at) {
  {collide(a, at, b, at, 0.0)};
};

template <class A, class B>
concept CollidesWithin = requires(const A& a, const B& b, const Placed& at) {
  {collide(a, at, b, at, 0.0, 0.0)};
};

template <class A>
concept HasCore = requires(const A& a, const Placed& at) {
  {convex::core_of(a, at)};
};

/// Solids without an algorithm of their own, by the general one, relative to the first.
template <class A, class B>
Manifold collide_cores(const A& a, const Placed& at_a, const B& b, const Placed& at_b, double margin, double reach) {
  const Mat3 into = at_a.axes.transpose();
  convex::Core core_a = convex::core_of(a, {Vec3(0, 0, 0), Mat3::Identity()});
  convex::Core core_b = convex::core_of(b, {into * (at_b.center - at_a.center), into * at_b.axes});
  return to_world(convex::collide_convex(core_a, core_b, margin, reach), at_a);
}

template <class A>
Manifold collide_core_with_plane(const A& a, const Placed& at_a, const Plane& plane, const Placed& at_plane,
                                 double margin, double reach) {
  const Vec3 normal = at_plane.axes * plane.normal;
  const double offset = normal.dot(at_plane.center) + plane.offset;
  convex::Core core = convex::core_of(a, at_a);
  return convex::collide_with_plane(core, normal, offset, margin, reach);
}

/// Empty for a pair that only exists in the other order, and for two planes, neither of which moves by itself.
template <class A, class B>
Manifold collide_solids(const A& a, const Placed& at_a, const B& b, const Placed& at_b, double margin, double reach) {
  if constexpr (CollidesWithin<A, B>) {
    // Their own algorithm says whether they touch, but only roughly how far apart they are.
    if (std::isinf(margin)) return collide_cores(a, at_a, b, at_b, margin, reach);
    return collide(a, at_a, b, at_b, margin, reach);
  } else if constexpr (Collides<A, B>) {
    const Manifold manifold = collide(a, at_a, b, at_b, margin);
    return manifold.count > 0 && reach > margin ? collide(a, at_a, b, at_b, reach) : manifold;
  } else if constexpr (HasCore<A> && HasCore<B>) {
    if constexpr (std::is_same_v<A, Box> && std::is_same_v<B, Capsule>)
      if (const std::optional<Manifold> lying = convex::capsule_on_box(b, at_b, a, at_a, margin, reach)) return *lying;
    if constexpr (std::is_same_v<A, Capsule> && std::is_same_v<B, Box>)
      if (std::optional<Manifold> lying = convex::capsule_on_box(a, at_a, b, at_b, margin, reach)) {
        lying->normal = -lying->normal;
        return *lying;
      }
    return collide_cores(a, at_a, b, at_b, margin, reach);
  } else if constexpr (HasCore<A> && std::is_same_v<B, Plane>) {
    return collide_core_with_plane(a, at_a, b, at_b, margin, reach);
  } else {
    return {};
  }
}

/// The deepest contact of a compound's parts, or the nearest.
Manifold collide_parts(const Shape& a, const Placed& at_a, const Shape& b, const Placed& at_b, double margin,
                       double reach) {
  Manifold best;
  double most = -std::numeric_limits<double>::infinity();
  for (const Shape& part : std::get<Compound>(a.solid).parts()) {
    const Placed at{at_a.center + at_a.axes * part.offset.position,
                    at_a.axes * part.offset.rotation.toRotationMatrix()};
    const Manifold manifold = collide(part, at, b, at_b, margin, reach);
    for (int i = 0; i < manifold.count; ++i) {
      const double depth = manifold.points[static_cast<std::size_t>(i)].penetration;
      if (!(depth > most)) continue;
      most = depth;
      best = manifold;
    }
  }
  return best;
}

/// For solids that the general algorithm handles best.
template <class A, class B>
Gap gap_between_cores(const A& a, const Placed& at_a, const B& b, const Placed& at_b, double enough) {
  const Mat3 into = at_a.axes.transpose();
  convex::Core core_a = convex::core_of(a, {Vec3(0, 0, 0), Mat3::Identity()});
  convex::Core core_b = convex::core_of(b, {into * (at_b.center - at_a.center), into * at_b.axes});
  const double around = core_a.radius + core_b.radius;
  const convex::Nearness nearness = convex::nearness_of(core_a, core_b, enough + around);
  return {nearness.distance - around, at_a.axes * nearness.normal};
}

/// Whether the products that follow stay finite.
bool is_near(const Pose& pose) noexcept {
  bool near = true;
  for (int i = 0; i < 3; ++i) near = near && std::abs(pose.position[i]) <= 1e60;
  for (int i = 0; i < 4; ++i) near = near && std::abs(pose.rotation.coeffs()[i]) <= 1e3;
  return near;
}

}  // namespace

Manifold collide(const Shape& a, const Placed& at_a, const Shape& b, const Placed& at_b, double margin,
                 double reach) noexcept {
  if (std::holds_alternative<Compound>(a.solid)) return collide_parts(a, at_a, b, at_b, margin, reach);
  if (std::holds_alternative<Compound>(b.solid)) {
    Manifold manifold = collide_parts(b, at_b, a, at_a, margin, reach);
    manifold.normal = -manifold.normal;
    return manifold;
  }
  if (const surfaces::Surface* surface = surfaces::surface_of(a.solid))
    return surfaces::deepest_touch(*surface, at_a, b.solid, at_b, margin, reach);
  if (const surfaces::Surface* surface = surfaces::surface_of(b.solid)) {
    Manifold manifold = surfaces::deepest_touch(*surface, at_b, a.solid, at_a, margin, reach);
    manifold.normal = -manifold.normal;
    return manifold;
  }
  return std::visit(
      [&](const auto& solid_a, const auto& solid_b) -> Manifold {
        using A = std::decay_t<decltype(solid_a)>;
        using B = std::decay_t<decltype(solid_b)>;
        constexpr bool known = Collides<A, B> || CollidesWithin<A, B>;
        constexpr bool known_turned = Collides<B, A> || CollidesWithin<B, A>;
        constexpr bool turned = known_turned || std::is_same_v<A, Plane>;
        if constexpr (known || !turned) {
          return collide_solids(solid_a, at_a, solid_b, at_b, margin, reach);
        } else {
          Manifold manifold = collide_solids(solid_b, at_b, solid_a, at_a, margin, reach);
          manifold.normal = -manifold.normal;
          return manifold;
        }
      },
      a.solid, b.solid);
}

Gap gap_between(const Shape& a, const Placed& at_a, const Shape& b, const Placed& at_b, double enough) noexcept {
  const auto by_points = [&]() -> Gap {
    constexpr double anywhere = std::numeric_limits<double>::infinity();
    const Manifold manifold = collide(a, at_a, b, at_b, anywhere, anywhere);
    Gap gap{anywhere, manifold.normal};
    for (int i = 0; i < manifold.count; ++i)
      gap.width = std::min(gap.width, -manifold.points[static_cast<std::size_t>(i)].penetration);
    return gap;
  };
  return std::visit(
      [&](const auto& solid_a, const auto& solid_b) -> Gap {
        using A = std::decay_t<decltype(solid_a)>;
        using B = std::decay_t<decltype(solid_b)>;
        if constexpr (HasCore<A> && HasCore<B> && !Collides<A, B> && !Collides<B, A>)
          return gap_between_cores(solid_a, at_a, solid_b, at_b, enough);
        else
          return by_points();
      },
      a.solid, b.solid);
}

}  // namespace collision

Manifold collide(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin) noexcept {
  if (!collision::is_near(pose_a) || !collision::is_near(pose_b)) return {};
  return collision::collide(a, shapes::place(a, pose_a), b, shapes::place(b, pose_b), margin, margin);
}

}  // namespace tweenfall
