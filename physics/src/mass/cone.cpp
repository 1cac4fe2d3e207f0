#include "mass/revolved.h"

namespace tweenfall::mass {

Pieces pieces_of(const Cone& cone) {
  Pieces pieces;
  add_frustum(pieces, -cone.half_height, cone.half_height, cone.radius, 0);
  return pieces;
}

}  // namespace tweenfall::mass
