#include <algorithm>
#include <cmath>

#include "strategies/lemke.h"
#include "strategies/solvers.h"

namespace tweenfall::strategies {

namespace {

/// Up to so many touches the problem is solved by Lemke's pivots, beyond by projected Gauss-Seidel.
constexpr std::size_t most_pivoted = 96;
/// How far off projected Gauss-Seidel may end, m/s, and passes that it may take.
constexpr double near_enough_to_end = 2e-10;
constexpr int most_sweeps = 20000;
/// Between these the other half is solved: normals with friction as it is, friction with normals as they are.
constexpr int most_rounds = 12;

/// How far impulses and parting speeds are from none being negative and one of the two being nothing, m/s.
double residual(const Gathering& island) {
  double most = 0;
  for (const Touch& touch : island.touches) {
    const double give = island.ease(touch, touch.normal);
    if (!(give > 0)) continue;
    most = std::max(most, std::abs(std::min(touch.impulse * give, island.parting(touch) - touch.wanted)));
  }
  return most;
}

bool pivoted(Gathering& island) {
  const std::size_t count = island.touches.size();
  // A unit of impulse is such that it adds a unit of speed by itself.
  std::vector<double> units(count), matrix(count * count), offsets(count), impulses(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double give = island.ease(island.touches[i], island.touches[i].normal);
    if (!(give > 0)) return false;
    units[i] = 1 / std::sqrt(give);
  }
  std::vector<Party> parties = island.parties;
  for (Party& party : island.parties) party.linear = party.angular = Vec3::Zero();
  for (std::size_t column = 0; column < count; ++column) {
    const Touch& pushed = island.touches[column];
    island.push(pushed, units[column] * pushed.normal);
    for (std::size_t row = 0; row < count; ++row)
      matrix[row * count + column] = units[row] * island.parting(island.touches[row]);
    for (const std::uint32_t end : {pushed.a, pushed.b})
      island.parties[end].linear = island.parties[end].angular = Vec3::Zero();
  }
  island.parties = std::move(parties);
  for (std::size_t row = 0; row < count; ++row) {
    const Touch& touch = island.touches[row];
    offsets[row] = units[row] * (island.parting(touch) - touch.wanted);
    for (std::size_t column = 0; column < count; ++column)
      offsets[row] -= matrix[row * count + column] * island.touches[column].impulse / units[column];
  }
  if (!solve_by_lemke(matrix, offsets, impulses)) return false;
  for (std::size_t i = 0; i < count; ++i) {
    Touch& touch = island.touches[i];
    const double pressed = units[i] * impulses[i];
    island.push(touch, (pressed - touch.impulse) * touch.normal);
    touch.impulse = pressed;
  }
  return true;
}

void swept(Gathering& island) {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    // There and back, so that what is carried goes up as fast as down.
    if (sweep % 2 == 0)
      for (Touch& touch : island.touches) island.press(touch);
    else
      for (std::size_t i = island.touches.size(); i-- > 0;) island.press(island.touches[i]);
    if (sweep % 8 == 7 && residual(island) < near_enough_to_end) return;
  }
}

void solve_normals(Gathering& island) {
  if (island.touches.empty()) return;
  if (island.touches.size() > most_pivoted || !pivoted(island)) swept(island);
}

}  // namespace

/// All collisions at once, as a linear complementarity problem: no impulse pulls, no surfaces close, and where they
/// part there is no impulse. Friction takes turns with it: it is found for the impulses along the normals, and these
/// again with the friction that there is.
/// Sources: Baraff, Fast Contact Force Computation for Nonpenetrating Rigid Bodies, SIGGRAPH 1994; Kaufman and others,
/// Staggered Projections for Frictional Contact in Multibody Systems, SIGGRAPH Asia 2008.
void lcp(Gathering& island) {
  island.begin_where_it_ended();
  solve_normals(island);
  const bool rubs =
      std::any_of(island.touches.begin(), island.touches.end(), [](const Touch& touch) { return touch.friction > 0; });
  for (int round = 0; rubs && round < most_rounds; ++round) {
    double change = 0;
    for (int pass = 0; pass < island.passes; ++pass)
      for (Touch& touch : island.touches) {
        const Vec3 before = touch.rubbing;
        island.rub(touch);
        if (pass == 0) change = std::max(change, (touch.rubbing - before).norm() * island.ease(touch, touch.normal));
      }
    solve_normals(island);
    if (change < near_enough_to_end) break;
  }
  island.complementarity = residual(island);
}

}  // namespace tweenfall::strategies
