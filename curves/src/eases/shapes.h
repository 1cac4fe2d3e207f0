#pragma once

// The shapes that re-time a span, each built in a file of its own.

#include <tweenfall/curves/span.h>

#include <array>
#include <string_view>
#include <vector>

namespace tweenfall::shapes {

using Pieces = std::vector<Span<double>>;

/// Which end of the span a family's shape acts on.
enum class Flow { in, out, in_out };

/// A way in over the unit interval, as a polynomial (seen through `warp`), and the warp run backwards:
/// reversed(u) = 1 - warp(1 - u).
struct WayIn {
  std::vector<double> coefficients;
  Warp warp = {};
  Warp::Function reversed = nullptr;
};

/// The way in itself, its point reflection (out), or one half of each.
[[nodiscard]] Pieces flowing(const WayIn& way_in, Flow flow);
/// The same for shapes of several pieces, without warps, over the unit interval.
[[nodiscard]] Pieces flowing(const Pieces& way_in, Flow flow);

/// 1 - F(1 - u).
template <Warp::Function F>
Warp::Result reversed(double u, const std::array<double, 4>& parameters) noexcept {
  const Warp::Result r = F(1 - u, parameters);
  return {1 - r.s, r.ds, -r.dds};
}

[[nodiscard]] Pieces power(int degree, Flow flow);       ///< u^degree; degree 1 to 5
[[nodiscard]] Pieces power(double exponent, Flow flow);  ///< u^exponent; exponent > 0
[[nodiscard]] Pieces sine(Flow flow);
[[nodiscard]] Pieces exponential(Flow flow);
[[nodiscard]] Pieces circular(Flow flow);
[[nodiscard]] Pieces back(double overshoot, Flow flow);
[[nodiscard]] Pieces elastic(double amplitude, double period, Flow flow);
[[nodiscard]] Pieces penner_elastic(double amplitude, double period, Flow flow);
[[nodiscard]] Pieces bounce(Flow flow);
[[nodiscard]] Pieces bezier(double x1, double y1, double x2, double y2);
/// @param jump  "jump-start", "jump-end", "jump-none", "jump-both"
[[nodiscard]] Pieces steps(int count, std::string_view jump);
/// A stop of CSS linear(): an output, and none, one or two inputs in percent at which it stands.
struct LinearStop {
  double output;
  std::vector<double> percents{};
};
/// @param stops  one or more
[[nodiscard]] Pieces linear(const std::vector<LinearStop>& stops);
/// @param parameters  undamped period in seconds, damping ratio
[[nodiscard]] Pieces spring(double duration, const std::array<double, 4>& parameters);

}  // namespace tweenfall::shapes
