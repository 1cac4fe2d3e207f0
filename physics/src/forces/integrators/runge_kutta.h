#pragma once

#include <algorithm>
#include <array>

#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

/// An explicit method: row i of `parts` has the coefficients of the rates 0..i-1 that lead to stage i.
template <std::size_t Stages>
struct Tableau {
  std::array<std::array<double, Stages>, Stages> parts{};
  std::array<double, Stages> weights{};
  double sum = 1;  ///< of the weights
};

/// Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.1; on turns after Munthe-Kaas,
/// High order Runge-Kutta methods on manifolds, Applied Numerical Mathematics 29, 1999.
template <std::size_t Stages>
void runge_kutta(const Tableau<Stages>& tableau, const Flow& flow, double dt, Room& room, std::span<double> means) {
  room.resize(Stages + 1);
  for (std::vector<double>& list : room) list.resize(means.size());
  std::vector<double>& since = room[Stages];
  for (std::size_t stage = 0; stage < Stages; ++stage) {
    double after = 0;
    std::fill(since.begin(), since.end(), 0.0);
    for (std::size_t known = 0; known < stage; ++known) {
      const double part = tableau.parts[stage][known];
      if (part == 0) continue;
      after += part * dt;
      advance(since, part * dt, room[known]);
    }
    flow.rates(after, since, room[stage]);
  }
  std::fill(means.begin(), means.end(), 0.0);
  for (std::size_t stage = 0; stage < Stages; ++stage) advance(means, tableau.weights[stage], room[stage]);
  for (double& mean : means) mean *= 1 / tableau.sum;
}

}  // namespace tweenfall::forces
