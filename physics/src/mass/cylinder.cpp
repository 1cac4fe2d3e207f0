#include "mass/revolved.h"

namespace tweenfall::mass {

Pieces pieces_of(const Cylinder& cylinder) {
  Pieces pieces;
  add_frustum(pieces, -cylinder.half_height, cylinder.half_height, cylinder.radius, cylinder.radius);
  return pieces;
}

}  // namespace tweenfall::mass
