#include "strategies/separations/separations.h"

namespace tweenfall::strategies {

/// The fast method: one of the two stays where it is, and the other is put at the closest place where it touches from
/// outside. If both can move, the second one is put there.
void closest_point(Overlap& overlap) {
  const double depth = overlap.depth();
  overlap.part(overlap.b.movable ? 0 : depth, overlap.b.movable ? depth : 0);
}

}  // namespace tweenfall::strategies
