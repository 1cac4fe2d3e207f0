#pragma once

#include <tweenfall/physics/shape.h>

#include <optional>

namespace tweenfall::queries {

/// Where a ray, in a solid's own axes, first meets it.
struct Entry {
  double distance = 0;
  Vec3 normal{0, 1, 0};
  bool inside = false;
};

// Solids of revolution, in closed form. @param direction  unit
[[nodiscard]] std::optional<Entry> enters(const Cylinder& cylinder, const Vec3& from, const Vec3& direction);
[[nodiscard]] std::optional<Entry> enters(const Cone& cone, const Vec3& from, const Vec3& direction);
[[nodiscard]] std::optional<Entry> enters(const TaperedCapsule& capsule, const Vec3& from, const Vec3& direction);

}  // namespace tweenfall::queries
