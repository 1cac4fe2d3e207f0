#pragma once

#include <optional>

#include "collision/convex/core.h"
#include "shapes/placed.h"

namespace tweenfall::surfaces {

/// A convex solid for the search against triangles; empty for planes, compounds and surfaces.
[[nodiscard]] std::optional<convex::Core> convex_piece(const Solid& solid, const shapes::Placed& at) noexcept;

/// A point in the middle of a convex solid, in its own space.
[[nodiscard]] inline Vec3 middle_of(const Solid& solid) noexcept {
  const auto* hull = std::get_if<Hull>(&solid);
  return hull ? hull->convex.measures().center : Vec3(0, 0, 0);
}

/// The box around a core and everything within its radius.
[[nodiscard]] Bounds bounds_of(convex::Core& core);

}  // namespace tweenfall::surfaces
