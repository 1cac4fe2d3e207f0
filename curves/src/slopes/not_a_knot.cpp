#include "slopes/c2_slopes.h"

namespace tweenfall {

void slopes_not_a_knot(const SlopeProblem& p) {
  solve_c2_automatic(p, C2End::Kind::not_a_knot);
}

}  // namespace tweenfall
