#include "strategies/separations/separations.h"

namespace tweenfall::strategies {

/// The lighter goes back by more: the first one by m2 / (m1 + m2) of the overlap, so that their center of mass stays
/// where it is.
void by_mass(Overlap& overlap) {
  const double depth = overlap.depth(), ease = overlap.a.inverse_mass + overlap.b.inverse_mass;
  overlap.part(overlap.a.inverse_mass / ease * depth, overlap.b.inverse_mass / ease * depth);
}

}  // namespace tweenfall::strategies
