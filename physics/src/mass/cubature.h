#pragma once

// Integrals over images of cubes, cut where necessary.

#include <array>

#include "mass/pieces.h"

namespace tweenfall::mass {

/// Integrals of density times products of coordinates: 1; x, y, z; xx, yy, zz, xy, yz, zx.
using Moments = std::array<double, 10>;

struct Summed {
  Moments moments{}, errors{};
  std::size_t evaluations = 0;
};

/// @param from   the point that positions are relative to, m
/// @param size   of the solid, m: errors of the moments are weighted by it
/// @param at     density at a point, in the pieces' own space
[[nodiscard]] Summed sum_up(const Pieces& pieces, const Vec3& from, double size,
                            const std::function<double(const Vec3&)>& at, const Quadrature& quadrature);

}  // namespace tweenfall::mass
