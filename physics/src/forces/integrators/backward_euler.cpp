#include <algorithm>

#include "forces/integrators/implicit.h"

namespace tweenfall::forces {

/// First order: uses the rates at the end. A swing loses energy, and nothing is too stiff.
void backward_euler(const Flow& flow, double dt, Room& room, std::span<double> means) {
  room.resize(1);
  room[0].assign(means.size(), 0.0);
  meet_the_end(flow, dt, 1, room[0], means);
}

}  // namespace tweenfall::forces
