#include <algorithm>

#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

/// Second order: positions use the velocities halfway, velocities the mean of the forces at both ends. If forces depend
/// only on positions, this is velocity Verlet, which keeps the energy of a swing up to a ripple; if they also depend
/// on velocities, they are evaluated at the velocity predicted from the start. Turns use the rates halfway.
/// Source: Swope and others, A computer simulation method for the calculation of equilibrium constants, Journal of
/// Chemical Physics 76, 1982; Hairer, Lubich and Wanner, Geometric Numerical Integration, 2006, I.1.4.
void verlet(const Flow& flow, double dt, Room& room, std::span<double> means) {
  room.resize(3);
  for (std::vector<double>& list : room) list.resize(means.size());
  std::vector<double>&since = room[0], &start = room[1], &later = room[2];
  std::fill(since.begin(), since.end(), 0.0);
  flow.rates(0, since, start);
  advance(since, 0.5 * dt, start);
  flow.rates(0.5 * dt, since, later);
  const auto is_place = [&](std::size_t i) { return flow.places[i % flow.block] != 0; };
  for (std::size_t i = 0; i < since.size(); ++i) {
    means[i] = is_place(i) ? later[i] : 0;
    since[i] = dt * (is_place(i) ? later[i] : start[i]);
  }
  flow.rates(dt, since, later);
  for (std::size_t i = 0; i < since.size(); ++i)
    if (!is_place(i)) means[i] = 0.5 * (start[i] + later[i]);
}

}  // namespace tweenfall::forces
