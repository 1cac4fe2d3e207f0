#pragma once

#include <tweenfall/physics/shape.h>

#include <optional>
#include <span>

namespace tweenfall::shapes {

struct FittedCapsule {
  Capsule capsule;
  Vec3 center{0, 0, 0};
  Vec3 axis{0, 1, 0};  ///< unit
};

/// The capsule of least volume around nearly all points, along `along` or one of the points' principal axes. A
/// few stray points stay outside. Empty for points without extent.
[[nodiscard]] std::optional<FittedCapsule> fitted_capsule(std::span<const Vec3> points,
                                                          const std::optional<Vec3>& along);

}  // namespace tweenfall::shapes
