#include "strategies/solvers/solvers.h"

namespace tweenfall::strategies {

/// One collision after the other, over and over: what each has given so far may be taken back, down to zero. It
/// starts where the step before ended.
/// Source: Catto, Iterative Dynamics with Temporal Coherence, GDC 2005.
void iterative(Gathering& island) {
  island.begin_where_it_ended();
  for (int pass = 0; pass < island.passes; ++pass)
    for (Touch& touch : island.touches) {
      island.press(touch);
      island.rub(touch);
    }
}

}  // namespace tweenfall::strategies
