#include <algorithm>
#include <cmath>
#include <limits>

#include "strategies/solvers/block_pivots.h"
#include "strategies/solvers/fine_speeds.h"
#include "strategies/solvers/lemke.h"
#include "strategies/solvers/solvers.h"

namespace tweenfall::strategies {

namespace {

/// Up to `few_touches` the problem is solved by Lemke's pivots, above by projected Gauss-Seidel; but up to
/// `most_pivoted` by block pivots if a few passes of that are not enough, as when heavy bodies lie on light ones.
constexpr std::size_t few_touches = 96, most_pivoted = 1536;
/// How far off it may end, m/s, where rounding allows it, and passes that projected Gauss-Seidel may take.
constexpr double near_enough_to_end = 2e-10, near_at_most = 5e-10;
constexpr int few_sweeps = 400, most_sweeps = 20000;
/// If a body stands on more points than it needs, the problem does not determine what each bears. Adding this part of
/// its own inverse mass to each touch makes it unique, near all solutions; solving again about the resulting impulses
/// then removes the effect of the addition, until they stay the same.
/// Source: Rockafellar, Monotone Operators and the Proximal Point Algorithm, SIAM J. Control 14, 1976.
constexpr double softness = 1e-6;
constexpr int most_hardenings = 12;
constexpr double less_and_less[] = {1e-6, 1e-8, 1e-10};
/// Normals are solved with friction as it is, and friction with normals as they are, in turn.
constexpr int most_rounds = 12;
/// Times that impulses are mended by what they leave.
constexpr int most_corrections = 3;

/// How far impulses and parting speeds are from being nonnegative with one of the two zero, m/s.
double residual(const Gathering& island) {
  double most = 0;
  for (const Touch& touch : island.touches) {
    const double give = island.ease(touch, touch.normal);
    if (!(give > 0)) continue;
    most = std::max(most, std::abs(std::min(touch.impulse * give, island.parting(touch) - touch.wanted)));
  }
  return most;
}

/// The residual with which an island may end, m/s: bodies on light ones get speeds that cancel up to their rounding.
double near_enough(const Gathering& island) {
  double momentum = 0, ease = 0;
  for (const Party& party : island.parties)
    if (party.inverse_mass > 0) momentum += party.linear.norm() / party.inverse_mass;
  for (const Touch& touch : island.touches) ease = std::max(ease, island.ease(touch, touch.normal));
  return near_enough_to_end + 8 * std::numeric_limits<double>::epsilon() * momentum * ease;
}

/// The problem of an island, in units in which an impulse of one adds a speed of one by itself.
struct Pivoting {
  std::vector<double> units, matrix, offsets, impulses;
};

/// @return whether each touch can move at all
bool state_problem(Gathering& island, Pivoting& problem) {
  const std::size_t count = island.touches.size();
  problem = {std::vector<double>(count), std::vector<double>(count * count), std::vector<double>(count),
             std::vector<double>(count)};
  auto& [units, matrix, offsets, impulses] = problem;
  for (std::size_t i = 0; i < count; ++i) {
    const double give = island.ease(island.touches[i], island.touches[i].normal);
    if (!(give > 0)) return false;
    units[i] = 1 / std::sqrt(give);
  }
  const std::vector<Party> before = island.parties;
  for (Party& party : island.parties) party.linear = party.angular = Vec3::Zero();
  for (std::size_t column = 0; column < count; ++column) {
    const Touch& pushed = island.touches[column];
    island.push(pushed, units[column] * pushed.normal);
    for (std::size_t row = 0; row < count; ++row)
      matrix[row * count + column] = units[row] * island.parting(island.touches[row]);
    for (const std::uint32_t end : {pushed.a, pushed.b})
      island.parties[end].linear = island.parties[end].angular = Vec3::Zero();
  }
  island.parties = before;
  for (std::size_t row = 0; row < count; ++row) {
    const Touch& touch = island.touches[row];
    impulses[row] = touch.impulse / units[row];
    offsets[row] = units[row] * (island.parting(touch) - touch.wanted);
    for (std::size_t column = 0; column < count; ++column)
      offsets[row] -= matrix[row * count + column] * island.touches[column].impulse / units[column];
  }
  return true;
}

/// Gives the impulses, and mends what rounding left of them, by velocities in more digits.
/// @param pivots  of the problem's matrix
/// @return whether that leaves nothing; else all is as it was
bool accept(Gathering& island, const Pivoting& problem, BlockPivots& pivots, double enough) {
  const Gathering before = island;
  const std::size_t count = island.touches.size();
  std::vector<long double> impulses(count);
  std::vector<double> left(count), change(count);
  FineSpeeds speeds(before);
  for (std::size_t i = 0; i < count; ++i) {
    impulses[i] = static_cast<long double>(problem.units[i]) * problem.impulses[i];
    speeds.push(island.touches[i], impulses[i] - island.touches[i].impulse);
  }
  for (int k = 0; k < most_corrections; ++k) {
    for (std::size_t i = 0; i < count; ++i)
      left[i] = problem.units[i] * static_cast<double>(speeds.parting(island.touches[i]) - island.touches[i].wanted);
    if (!pivots.correct(left, problem.impulses, change)) break;
    for (std::size_t i = 0; i < count; ++i) {
      const long double mended = std::max(0.0L, impulses[i] + problem.units[i] * static_cast<long double>(change[i]));
      speeds.push(island.touches[i], mended - impulses[i]);
      impulses[i] = mended;
    }
  }
  for (std::size_t i = 0; i < count; ++i) island.touches[i].impulse = static_cast<double>(impulses[i]);
  speeds.tell(island);
  if (residual(island) < enough) return true;
  island = before;
  return false;
}

/// @param solve  for the matrix with a softness on its diagonal: given offsets, writes impulses and returns success
/// @return whether the impulses finally stay the same
template <class Solve>
bool hardened(Pivoting& problem, double soft, double enough, const Solve& solve) {
  const std::size_t count = problem.units.size();
  std::vector<double> softened(count);
  for (int k = 0; k < most_hardenings; ++k) {
    for (std::size_t i = 0; i < count; ++i) softened[i] = problem.offsets[i] - soft * problem.impulses[i];
    const std::vector<double> last = problem.impulses;
    if (!solve(softened, problem.impulses)) return false;
    double change = 0;
    for (std::size_t i = 0; i < count; ++i)
      change = std::max(change, std::abs(problem.impulses[i] - last[i]) / problem.units[i]);
    if (soft * change < 0.01 * enough) return true;
  }
  return true;
}

void soften(Pivoting& problem, double by) {
  const std::size_t count = problem.units.size();
  for (std::size_t i = 0; i < count; ++i) problem.matrix[i * count + i] += by;
}

/// By Lemke's pivots. @return whether that solved it; otherwise everything is as before.
bool pivoted(Gathering& island, double enough) {
  Pivoting problem;
  if (!state_problem(island, problem)) return false;
  soften(problem, softness);
  const auto by_lemke = [&](const std::vector<double>& offsets, std::vector<double>& impulses) {
    return solve_by_lemke(problem.matrix, offsets, impulses);
  };
  if (!hardened(problem, softness, enough, by_lemke)) return false;
  BlockPivots pivots(problem.matrix, problem.units);
  return accept(island, problem, pivots, std::min(enough, near_at_most));
}

/// The same by block pivots, which also work when light bodies bear ten thousand times their mass: there
/// a softness of one part in a million is still too much, and less of it is tried.
bool pivoted_by_blocks(Gathering& island, double enough) {
  Pivoting problem;
  if (!state_problem(island, problem)) return false;
  std::vector<double> slack(problem.units);
  for (double& each : slack) each *= 0.05 * enough;
  double soft = 0;
  for (const double next : less_and_less) {
    soften(problem, next - soft);
    soft = next;
    BlockPivots pivots(problem.matrix, slack);
    const auto by_blocks = [&](const std::vector<double>& offsets, std::vector<double>& impulses) {
      return pivots.solve(offsets, impulses);
    };
    if (hardened(problem, soft, enough, by_blocks) && accept(island, problem, pivots, std::min(enough, near_at_most)))
      return true;
  }
  return false;
}

/// @param left  number of passes still allowed; reduced
/// @return whether that solved it
bool swept(Gathering& island, double enough, int most, int& left) {
  for (int sweep = 0; sweep < most && left > 0; ++sweep, --left) {
    // There and back, so that weight passes up as fast as down.
    if (sweep % 2 == 0)
      for (Touch& touch : island.touches) island.press(touch);
    else
      for (std::size_t i = island.touches.size(); i-- > 0;) island.press(island.touches[i]);
    if (sweep % 8 == 7 && residual(island) < enough) return true;
  }
  return false;
}

void solve_normals(Gathering& island, double enough, int& left) {
  const std::size_t count = island.touches.size();
  if (count == 0 || (count <= few_touches && pivoted(island, enough)) ||
      swept(island, std::min(enough, near_at_most), few_sweeps, left))
    return;
  if (count > most_pivoted || !pivoted_by_blocks(island, enough)) swept(island, enough, most_sweeps, left);
}

}  // namespace

/// All collisions at once, as a linear complementarity problem: no impulse pulls, no surfaces close, and where they
/// part there is no impulse. It alternates with friction, which is solved for given impulses along the normals, and
/// these again for the given friction.
/// Sources: Baraff, Fast Contact Force Computation for Nonpenetrating Rigid Bodies, SIGGRAPH 1994; Kaufman and others,
/// Staggered Projections for Frictional Contact in Multibody Systems, SIGGRAPH Asia 2008.
void lcp(Gathering& island) {
  int left = most_sweeps;
  const double enough = near_enough(island);
  island.begin_where_it_ended();
  solve_normals(island, enough, left);
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
    solve_normals(island, enough, left);
    if (change < enough) break;
  }
  island.complementarity = residual(island);
}

}  // namespace tweenfall::strategies
