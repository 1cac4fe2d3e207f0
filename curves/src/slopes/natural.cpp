#include "slopes/c2_slopes.h"

namespace tweenfall {

// Source: de Boor, "A Practical Guide to Splines", chapter IV.
void slopes_natural(const SlopeProblem& p) {
  solve_c2_automatic(p, C2End::Kind::second);
}

void slopes_natural_given(const SlopeProblem& p) {
  const double start = p.eases[p.first]->parameters()[0], end = p.eases[p.last - 1]->parameters()[1];
  solve_c2(p, {C2End::Kind::second, std::vector<double>(p.dimensions, start)},
           {C2End::Kind::second, std::vector<double>(p.dimensions, end)});
}

}  // namespace tweenfall
