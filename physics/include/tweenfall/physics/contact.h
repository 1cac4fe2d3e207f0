#pragma once

/// Where two shapes touch: a manifold of up to four points with one normal.

#include <tweenfall/physics/shape.h>

#include <array>
#include <cstdint>

namespace tweenfall {

struct ContactPoint {
  Vec3 position{0, 0, 0};     ///< midway between the two surfaces, world, m
  double penetration = 0;     ///< m; negative for a gap
  std::uint32_t feature = 0;  ///< which features touch; the same contact keeps its number from step to step
};

struct Manifold {
  Vec3 normal{0, 1, 0};  ///< unit, world, out of the first shape toward the second
  std::array<ContactPoint, 4> points{};
  int count = 0;  ///< 0 when the shapes are farther apart than the margin
};

/// Contact of two placed shapes.
/// @param margin  points with a gap up to this are reported too, m; >= 0
[[nodiscard]] Manifold collide(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                               double margin = 0) noexcept;

}  // namespace tweenfall
