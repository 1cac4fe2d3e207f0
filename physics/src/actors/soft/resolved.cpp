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

/// The same for a push that makes a volume larger, m^4/kg.
double give(const SoftSettings& made, const SoftTetrahedron& solid) {
  const auto& n = solid.nodes;
  const std::vector<Vec3>& x = made.positions;
  const Vec3 b = x[n[1]] - x[n[0]], c = x[n[2]] - x[n[0]], d = x[n[3]] - x[n[0]];
  const Vec3 by_b = c.cross(d) / 6, by_c = d.cross(b) / 6, by_d = b.cross(c) / 6;
  return (by_b + by_c + by_d).squaredNorm() / made.masses[n[0]] + by_b.squaredNorm() / made.masses[n[1]] +
         by_c.squaredNorm() / made.masses[n[2]] + by_d.squaredNorm() / made.masses[n[3]];
}
double give(const SoftSettings& made, const SoftEnclosure& enclosure) {
  thread_local std::vector<Vec3> gradients;
  gradients.assign(made.positions.size(), Vec3(0, 0, 0));
  const Vec3 origin = made.positions[enclosure.triangles[0][0]];
  for (const auto& triangle : enclosure.triangles) {
    const auto at = [&](std::size_t corner) -> Vec3 { return made.positions[triangle[corner % 3]] - origin; };
    for (std::size_t corner = 0; corner < 3; ++corner)
      gradients[triangle[corner]] += at(corner + 1).cross(at(corner + 2)) / 6;
  }
  double sum = 0;
  for (std::size_t k = 0; k < gradients.size(); ++k) sum += gradients[k].squaredNorm() / made.masses[k];
  return sum;
}

/// How much of each constraint one of several passes resolves. A node of a volume has twice as many edges as one of a
/// cloth, and tetrahedra besides: that is less, and less still of the damping of its edges. More than these numbers let
/// a cantilevered bar gain energy.
constexpr double share_in_volume = 0.25, damping_in_volume = 0.0625;
/// What the pass of a volume resolves if there is no other that takes back what it did too much.
constexpr double share_alone = 0.05;

/// How much of each constraint all passes resolve.
double resolved_share(const SoftSettings& made, double of_one = share_in_volume) {
  if (made.tetrahedra.empty()) return *made.iterations;
  return *made.iterations == 1 ? share_alone : of_one * *made.iterations;
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
  return std::min(edge.stiffness, resolved_share(made) / (give(made, edge) * h * h));
}

Resolved resolved(const SoftBody& body, const SoftEdge& edge) {
  const SoftSettings& made = *body.made;
  const double stiffness = resolved_stiffness(made, edge, body.pace);
  if (made.tetrahedra.empty()) return {stiffness, edge.damping};
  return {stiffness, std::min(edge.damping, resolved_share(made, damping_in_volume) / (give(made, edge) * body.pace))};
}

double resolved_stiffness(const SoftBody& body, const SoftBend& bend) {
  if (body.made->solver == SoftSolver::springs) return bend.stiffness;
  return std::min(bend.stiffness, *body.made->iterations / (give(*body.made, bend) * body.pace * body.pace));
}

double resolved_stiffness(const SoftSettings& made, const SoftTetrahedron& solid, double h) {
  const double stiffness = solid.stiffness / *solid.volume;
  if (made.solver == SoftSolver::springs) return stiffness;
  return std::min(stiffness, resolved_share(made) / (give(made, solid) * h * h));
}

double resolved_stiffness(const SoftSettings& made, const SoftEnclosure& enclosure, double h) {
  const double stiffness = enclosure.stiffness / *enclosure.volume;
  if (made.solver == SoftSolver::springs) return stiffness;
  return std::min(stiffness, *made.iterations / (give(made, enclosure) * h * h));
}

int enough_iterations(const SoftSettings& made) {
  if (made.solver == SoftSolver::springs) return 1;
  const double h = *made.sub_step;
  const bool is_volume = !made.tetrahedra.empty();
  const double share = is_volume ? share_in_volume : 1, damping_share = is_volume ? damping_in_volume : 1;
  double stiffest = 0;
  if (!is_chained(made))
    for (const SoftEdge& edge : made.edges)
      stiffest = std::max(stiffest, (edge.stiffness * h / share + edge.damping / damping_share) * h * give(made, edge));
  for (const SoftBend& bend : made.bends) stiffest = std::max(stiffest, bend.stiffness * h * h * give(made, bend));
  for (const SoftTetrahedron& solid : made.tetrahedra)
    stiffest = std::max(stiffest, solid.stiffness / *solid.volume * h * h * give(made, solid) / share);
  for (const SoftEnclosure& enclosure : made.enclosures)
    stiffest = std::max(stiffest, enclosure.stiffness / *enclosure.volume * h * h * give(made, enclosure));
  // One alone leaves more of what is half as stiff than two of what is twice as stiff.
  const double enough_for_one = is_volume ? share_alone / share_in_volume : 0.5;
  return stiffest <= enough_for_one ? 1 : static_cast<int>(std::clamp(std::ceil(stiffest), 2.0, 4.0));
}

}  // namespace tweenfall::soft
