#pragma once

// Quarters of solids of revolution about y.

#include <tweenfall/curves/elementary.h>

#include <numbers>

#include "mass/pieces.h"

namespace tweenfall::mass {

/// A circle of the solid and how fast its height grows.
struct Slice {
  double radius, height, rise;  ///< m
};

/// Adds the four quarters of the solid between the slices from 0 to 1.
template <class SliceAt>
void add_revolved(Pieces& pieces, const SliceAt& slice_at) {
  constexpr double quarter = std::numbers::pi / 2;
  for (int k = 0; k < 4; ++k)
    pieces.emplace_back([slice_at, k](double u, double v, double w) {
      const Slice slice = slice_at(v);
      const auto [sine, cosine] = elementary::sin_cos(quarter * (k + w));
      const double out = slice.radius * u;
      return Image{Vec3(out * cosine, slice.height, -out * sine), quarter * slice.radius * out * slice.rise};
    });
}

inline void add_frustum(Pieces& pieces, double bottom, double top, double bottom_radius, double top_radius) {
  add_revolved(pieces, [=](double share) {
    return Slice{bottom_radius + (top_radius - bottom_radius) * share, bottom + (top - bottom) * share, top - bottom};
  });
}

/// The part of a ball between two angles from straight down.
inline void add_ball_slices(Pieces& pieces, double middle, double radius, double from, double to) {
  add_revolved(pieces, [=](double share) {
    const auto [sine, cosine] = elementary::sin_cos(from + (to - from) * share);
    return Slice{radius * sine, middle - radius * cosine, (to - from) * radius * sine};
  });
}

}  // namespace tweenfall::mass
