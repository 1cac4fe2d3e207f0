#include "mass/pieces.h"

namespace tweenfall::mass {

Pieces pieces_of(const Hull& hull) {
  return pieces_of(hull.convex.surface(), hull.convex.measures().center);
}

}  // namespace tweenfall::mass
