#include "forces/integrators/runge_kutta.h"

namespace tweenfall::forces {

/// First order: uses the rates at the start. A swing gains energy.
void explicit_euler(const Flow& flow, double dt, Room& room, std::span<double> means) {
  constexpr Tableau<1> tableau{{{{0}}}, {1}};
  runge_kutta(tableau, flow, dt, room, means);
}

}  // namespace tweenfall::forces
