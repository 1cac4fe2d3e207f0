#include <algorithm>

#include "forces/integrators/implicit.h"

namespace tweenfall::forces {

/// Second order: uses the mean of the rates at the start and at the end. A swing on a linear spring keeps
/// its energy, and nothing is too stiff.
void implicit_trapezoid(const Flow& flow, double dt, Room& room, std::span<double> means) {
  room.resize(2);
  room[0].assign(means.size(), 0.0);
  room[1].resize(means.size());
  flow.rates(0, room[0], room[1]);
  for (double& rate : room[1]) rate *= 0.5;
  meet_the_end(flow, dt, 0.5, room[1], means);
}

}  // namespace tweenfall::forces
