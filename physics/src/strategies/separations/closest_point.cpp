#include "strategies/separations/separations.h"

namespace tweenfall::strategies {

/// The quick one: one of the two stays where it is, and the other is put at the closest place where it touches from
/// outside. Of two that can move the second is.
void closest_point(Overlap& overlap) {
  const double depth = overlap.depth();
  overlap.part(overlap.b.movable ? 0 : depth, overlap.b.movable ? depth : 0);
}

}  // namespace tweenfall::strategies
