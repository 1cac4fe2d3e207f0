#include "mass/revolved.h"

namespace tweenfall::mass {

Pieces pieces_of(const Capsule& capsule) {
  constexpr double right = std::numbers::pi / 2;
  Pieces pieces;
  add_ball_slices(pieces, -capsule.half_height, capsule.radius, 0, right);
  if (capsule.half_height > 0)
    add_frustum(pieces, -capsule.half_height, capsule.half_height, capsule.radius, capsule.radius);
  add_ball_slices(pieces, capsule.half_height, capsule.radius, right, 2 * right);
  return pieces;
}

}  // namespace tweenfall::mass
