#include <algorithm>

#include "forces/integrators/implicit.h"

namespace tweenfall::forces {

/// Second order: by the mean of what there is at the start and will be at the end. What swings on a linear spring keeps
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
