#include "slopes/c2_slopes.h"

namespace tweenfall {

void slopes_periodic(const SlopeProblem& p) {
  solve_c2_periodic(p);
}

}  // namespace tweenfall
