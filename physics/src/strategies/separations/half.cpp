#include "strategies/separations/separations.h"

namespace tweenfall::strategies {

/// Each goes back by half the overlap, whatever its mass; if one cannot move, the other goes back by all of it.
void half(Overlap& overlap) {
  const double depth = overlap.depth();
  overlap.part(!overlap.a.movable  ? 0
               : overlap.b.movable ? 0.5 * depth
                                   : depth,
               !overlap.b.movable  ? 0
               : overlap.a.movable ? 0.5 * depth
                                   : depth);
}

}  // namespace tweenfall::strategies
