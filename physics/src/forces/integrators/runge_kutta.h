#pragma once

#include <array>

#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

/// Of an explicit method: row i of `parts` has the parts of the rates 0..i-1 that lead to stage i.
template <std::size_t Stages>
struct Tableau {
  std::array<std::array<double, Stages>, Stages> parts{};
  std::array<double, Stages> weights{};
  double sum = 1;  ///< of the weights
};

/// Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.1; on turns after Munthe-Kaas,
/// High order Runge-Kutta methods on manifolds, Applied Numerical Mathematics 29, 1999.
template <std::size_t Stages>
void runge_kutta(const Tableau<Stages>& tableau, const Rates& rates, double dt, Room& room, std::span<Change> means) {
  room.resize(Stages + 1);
  for (std::vector<Change>& list : room) list.resize(means.size());
  std::vector<Change>& since = room[Stages];
  for (std::size_t stage = 0; stage < Stages; ++stage) {
    double after = 0;
    for (Change& change : since) change = {};
    for (std::size_t known = 0; known < stage; ++known) {
      const double part = tableau.parts[stage][known];
      if (part == 0) continue;
      after += part * dt;
      for (std::size_t i = 0; i < since.size(); ++i) since[i].add(part * dt, room[known][i]);
    }
    rates(after, since, room[stage]);
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    means[i] = {};
    for (std::size_t stage = 0; stage < Stages; ++stage) means[i].add(tableau.weights[stage], room[stage][i]);
    Change mean;
    mean.add(1 / tableau.sum, means[i]);
    means[i] = mean;
  }
}

}  // namespace tweenfall::forces
