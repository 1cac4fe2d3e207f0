#include "forces/integrators/runge_kutta.h"

namespace tweenfall::forces {

/// Second order: uses the rates in the middle of the step.
void midpoint(const Flow& flow, double dt, Room& room, std::span<double> means) {
  constexpr Tableau<2> tableau{{{{0, 0}, {0.5, 0}}}, {0, 1}};
  runge_kutta(tableau, flow, dt, room, means);
}

}  // namespace tweenfall::forces
