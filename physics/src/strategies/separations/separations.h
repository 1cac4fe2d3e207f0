#pragma once

#include <tweenfall/physics/strategies.h>

#include <array>

namespace tweenfall::strategies {

/// A body in an overlap.
struct Place {
  bool movable = false;
  double inverse_mass = 0;
  Mat3 inverse_inertia = Mat3::Zero();  ///< world axes
  Vec3 center{0, 0, 0};
  Quat rotation{1, 0, 0, 0};
};

/// Two bodies that overlap; one of them can move.
struct Overlap {
  Place a, b;
  Vec3 normal{0, 1, 0};  ///< from a toward b
  struct Point {
    Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};  ///< from the centers of mass, m
    double depth = 0;                     ///< m; not positive if they are apart
  };
  std::array<Point, 4> points{};
  int count = 0;

  [[nodiscard]] double depth() const;  ///< of the deepest point; 0 if there is none
  /// Moves b along the normal, and a against it.
  void part(double by_a, double by_b);
};

/// Moves two bodies apart.
using Separates = void(Overlap& overlap);

// One file each
Separates half, by_mass, positional_impulse, closest_point;

/// The function for a separation; for the default, positional impulses; null for one that does not exist.
[[nodiscard]] Separates* separation_of(Parting separation);

}  // namespace tweenfall::strategies
