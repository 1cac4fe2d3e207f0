#include "strategies/solvers/solvers.h"

namespace tweenfall::strategies {

/// One collision after the other, each once, as if it were the only one: this is the lecture's algorithm, and why it
/// "cannot handle stacks of bodies". The second of two that share a body undoes what the first did.
void sequential(Gathering& island) {
  for (Touch& touch : island.touches) {
    island.press(touch);
    island.rub(touch);
  }
}

}  // namespace tweenfall::strategies
