#include <algorithm>

#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

/// First order: velocities use the rates at the start, positions the resulting velocities. A swing keeps
/// its energy up to a ripple. Known as the symplectic Euler method.
/// Source: Hairer, Lubich and Wanner, Geometric Numerical Integration, 2006, I.1.2.
void semi_implicit_euler(const Flow& flow, double dt, Room& room, std::span<double> means) {
  room.resize(2);
  for (std::vector<double>& list : room) list.resize(means.size());
  std::vector<double>&since = room[0], &later = room[1];
  std::fill(since.begin(), since.end(), 0.0);
  flow.rates(0, since, means);
  const auto is_place = [&](std::size_t i) { return flow.places[i % flow.block] != 0; };
  for (std::size_t i = 0; i < since.size(); ++i)
    if (!is_place(i)) since[i] = dt * means[i];
  flow.rates(0, since, later);
  for (std::size_t i = 0; i < since.size(); ++i)
    if (is_place(i)) means[i] = later[i];
}

}  // namespace tweenfall::forces
