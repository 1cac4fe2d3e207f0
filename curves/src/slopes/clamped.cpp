#include "slopes/c2_slopes.h"

namespace tweenfall {

// The ends are stated, so that neither a loop nor the curve's options change them.
void slopes_clamped(const SlopeProblem& p) {
  const double start = p.eases[p.first]->parameters()[0], end = p.eases[p.last - 1]->parameters()[1];
  solve_c2(p, {C2End::Kind::slope, std::vector<double>(p.dimensions, start)},
           {C2End::Kind::slope, std::vector<double>(p.dimensions, end)});
}

}  // namespace tweenfall
