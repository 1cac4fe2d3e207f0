#include "forces/integrators/runge_kutta.h"

namespace tweenfall::forces {

/// Fourth order, the classic Runge-Kutta method.
void rk4(const Flow& flow, double dt, Room& room, std::span<double> means) {
  constexpr Tableau<4> tableau{{{{0, 0, 0, 0}, {0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 1, 0}}}, {1, 2, 2, 1}, 6};
  runge_kutta(tableau, flow, dt, room, means);
}

}  // namespace tweenfall::forces
