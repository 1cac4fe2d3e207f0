#include "forces/integrators/runge_kutta.h"

namespace tweenfall::forces {

/// First order: on by what there was at the start. What swings gains energy.
void explicit_euler(const Flow& flow, double dt, Room& room, std::span<double> means) {
  constexpr Tableau<1> tableau{{{{0}}}, {1}};
  runge_kutta(tableau, flow, dt, room, means);
}

}  // namespace tweenfall::forces
