#include "actors/soft/resolved.h"

#include <algorithm>
#include <cmath>

#include "actors/soft/chains.h"

namespace tweenfall::soft {

namespace {

/// How much a push between the ends of an edge moves them apart, or a push on a bend unbends it, 1/kg.
double give(const SoftSettings& made, const SoftEdge& edge) {
  return 1 / made.masses[edge.a] + 1 / made.masses[edge.b];
}
double give(const SoftSettings& made, const SoftBend& bend) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += bend.weights[k] * bend.weights[k] / made.masses[bend.nodes[k]];
  return sum;
}

bool is_chained(const SoftSettings& made) {
  std::vector<int> edges(made.masses.size(), 0);
  for (const SoftEdge& edge : made.edges)
    if (++edges[edge.a] > 2 || ++edges[edge.b] > 2) return false;
  return true;
}

}  // namespace

bool passes_over_edges(const SoftBody& body) {
  return body.made->solver == SoftSolver::positions && chains_of(body).empty();
}

double resolved_stiffness(const SoftSettings& made, const SoftEdge& edge, double h) {
  return std::min(edge.stiffness, *made.iterations / (give(made, edge) * h * h));
}

Resolved resolved(const SoftBody& body, const SoftEdge& edge) {
  const SoftSettings& made = *body.made;
  return {resolved_stiffness(made, edge, body.pace),
          std::min(edge.damping, *made.iterations / (give(made, edge) * body.pace))};
}

double resolved_stiffness(const SoftBody& body, const SoftBend& bend) {
  if (body.made->solver == SoftSolver::springs) return bend.stiffness;
  return std::min(bend.stiffness, *body.made->iterations / (give(*body.made, bend) * body.pace * body.pace));
}

int enough_iterations(const SoftSettings& made) {
  if (made.solver == SoftSolver::springs) return 1;
  const double h = *made.sub_step;
  double stiffest = 0;
  if (!is_chained(made))
    for (const SoftEdge& edge : made.edges)
      stiffest = std::max(stiffest, (edge.stiffness * h + edge.damping) * h * give(made, edge));
  for (const SoftBend& bend : made.bends) stiffest = std::max(stiffest, bend.stiffness * h * h * give(made, bend));
  // One alone leaves more of what is half as stiff than two of what is twice as stiff.
  return stiffest <= 0.5 ? 1 : static_cast<int>(std::clamp(std::ceil(stiffest), 2.0, 4.0));
}

}  // namespace tweenfall::soft
