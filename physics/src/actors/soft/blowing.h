#pragma once

#include <vector>

#include "actors/soft/soft_state.h"
#include "forces/forces.h"

namespace tweenfall::soft {

/// A wind that presses on faces.
struct Blowing {
  Vec3 velocity{0, 0, 0};  ///< m/s
  double density = 0;      ///< of the air, times the strength of the wind, kg/m^3
};

/// The winds that name no bodies, at a time, in place of what `winds` held.
void find_winds(const std::vector<forces::NumberedForce>& forces, double time, std::vector<Blowing>& winds);

/// Adds to the nodes of each face the velocity that winds give it in h seconds: along the face's normal, and never
/// beyond that of the wind.
void blow(SoftBody& body, const std::vector<Blowing>& winds, double h);

}  // namespace tweenfall::soft
