#include <tweenfall/physics/contact.h>
#include <cmath>

#include "collision/collide_pairs.h"

namespace tweenfall {

namespace {

template <class A, class B>
concept Collides = requires(const A& a, const B& b, const Placed& at) {
  {collide(a, at, b, at, 0.0)};
};

}  // namespace

/// Whether the products that follow stay numbers.
static bool is_near(const Pose& pose) noexcept {
  bool near = true;
  for (int i = 0; i < 3; ++i) near = near && std::abs(pose.position[i]) <= 1e60;
  for (int i = 0; i < 4; ++i) near = near && std::abs(pose.rotation.coeffs()[i]) <= 1e3;
  return near;
}

Manifold collide(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin) noexcept {
  if (!is_near(pose_a) || !is_near(pose_b)) return {};
  return collide(a, place(a, pose_a), b, place(b, pose_b), margin);
}

Manifold collide(const Shape& a, const Placed& at_a, const Shape& b, const Placed& at_b, double margin) noexcept {
  return std::visit(
      [&](const auto& solid_a, const auto& solid_b) -> Manifold {
        using A = std::decay_t<decltype(solid_a)>;
        using B = std::decay_t<decltype(solid_b)>;
        if constexpr (Collides<A, B>) {
          return collide(solid_a, at_a, solid_b, at_b, margin);
        } else if constexpr (Collides<B, A>) {
          Manifold manifold = collide(solid_b, at_b, solid_a, at_a, margin);
          manifold.normal = -manifold.normal;
          return manifold;
        } else {
          return {};  // two planes never meet: neither moves by itself
        }
      },
      a.solid, b.solid);
}

}  // namespace tweenfall
