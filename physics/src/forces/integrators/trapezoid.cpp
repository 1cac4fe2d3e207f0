#include "forces/integrators/runge_kutta.h"

namespace tweenfall::forces {

/// Second order: uses the mean of the rates at the start and those predicted for the end. Known as Heun's method.
void trapezoid(const Flow& flow, double dt, Room& room, std::span<double> means) {
  constexpr Tableau<2> tableau{{{{0, 0}, {1, 0}}}, {1, 1}, 2};
  runge_kutta(tableau, flow, dt, room, means);
}

}  // namespace tweenfall::forces
