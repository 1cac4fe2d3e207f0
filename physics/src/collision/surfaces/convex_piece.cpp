#include "collision/surfaces/convex_piece.h"

namespace tweenfall::surfaces {

std::optional<convex::Core> convex_piece(const Solid& solid, const shapes::Placed& at) noexcept {
  return std::visit(
      [&at](const auto& kind) -> std::optional<convex::Core> {
        if constexpr (requires { convex::core_of(kind, at); })
          return convex::core_of(kind, at);
        else
          return std::nullopt;
      },
      solid);
}

Bounds bounds_of(convex::Core& core) {
  Bounds result{core.shift, core.shift};
  for (int i = 0; i < 3; ++i) {
    result.high[i] = core.support(Vec3::Unit(i))[i] + core.radius;
    result.low[i] = core.support(-Vec3::Unit(i))[i] - core.radius;
  }
  return result;
}

}  // namespace tweenfall::surfaces
