#pragma once

// From integrals to mass properties.

#include "mass/pieces.h"

namespace tweenfall::mass {

void require_mass(double mass);

/// A solid to be weighed.
struct Cut {
  Pieces pieces;
  Pose pose;        ///< of their own space in the frame in which the density is given
  Vec3 middle;      ///< in their own space, m
  double size = 1;  ///< about how far it extends from there, m
};
[[nodiscard]] WeighedProperties weigh_pieces(const Cut& cut, const Density& density, const Quadrature& quadrature);

}  // namespace tweenfall::mass
