#include "forces/integrators/runge_kutta.h"

namespace tweenfall::forces {

/// First order: on by what there was at the start. What swings gains energy.
void explicit_euler(const Rates& rates, double dt, Room& room, std::span<Change> means) {
  constexpr Tableau<1> tableau{{{{0}}}, {1}};
  runge_kutta(tableau, rates, dt, room, means);
}

}  // namespace tweenfall::forces
