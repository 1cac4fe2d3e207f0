#pragma once

// The building blocks of shapes that re-time a span; each shape has a file of its own.

#include <tweenfall/curves/span.h>

#include <array>
#include <vector>

namespace tweenfall::eases {

using Pieces = std::vector<Span<double>>;

/// The end of the span on which a family's shape acts.
enum class Flow { in, out, in_out };

/// The "in" form of a shape over the unit interval: a polynomial, seen through `warp`, and the warp run backwards:
/// reversed(u) = 1 - warp(1 - u).
struct WayIn {
  std::vector<double> coefficients;
  Warp warp = {};
  Warp::Function reversed = nullptr;
};

/// The "in" form itself, its point reflection (out), or one half of each.
[[nodiscard]] Pieces flowing(const WayIn& way_in, Flow flow);
/// The same for shapes of several pieces, without warps, over the unit interval.
[[nodiscard]] Pieces flowing(const Pieces& way_in, Flow flow);

/// 1 - F(1 - u).
template <Warp::Function F>
Warp::Result reversed(double u, const std::array<double, 4>& parameters) noexcept {
  const Warp::Result r = F(1 - u, parameters);
  return {1 - r.s, r.ds, -r.dds};
}

}  // namespace tweenfall::eases
