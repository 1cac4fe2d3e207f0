#include <tweenfall/curves/handles.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/components.h"

namespace tweenfall::keying {
namespace {

// With widths a and b, time never runs backwards inside the unit square, nor inside the ellipse
//     a^2 + a b + b^2 - 2 (a + b) + 1 = 0,
// which touches the axes at 1 and leaves the square at its upper right corner.
double ellipse(double a, double b) noexcept {
  return a * a + a * b + b * b - 2 * (a + b) + 1;
}

HandleWidths keep_ratio(double a, double b) noexcept {
  const double out_of_ellipse = (a + b + std::sqrt(a * b)) / (a * a + a * b + b * b);
  const double out_of_square = 1 / std::max(a, b);
  const double factor = std::max(out_of_ellipse, out_of_square);
  return {factor * a, factor * b};
}

HandleWidths keep_start(double a, double b) noexcept {
  constexpr double longest = 4.0 / 3;
  a = std::min(a, longest);
  const double spread = std::sqrt(std::max(0.0, a * (4 - 3 * a)));
  const double high = 0.5 * (2 - a + spread), low = 0.5 * (2 - a - spread);
  return {a, a > 1 ? std::clamp(b, low, high) : std::min(b, high)};
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

bool runs_backwards(const HandleWidths& w) noexcept {
  // Beyond the edge by no more than rounding does not count.
  return (w.start > 1 || w.end > 1) && keying::ellipse(w.start, w.end) > 1e-15;
}

HandleWidths resolved(const HandleWidths& w, Overlong rule) {
  for (const double width : {w.start, w.end})
    if (!(width >= 0) || !std::isfinite(width))
      throw std::invalid_argument("a handle's share of its span must be >= 0; it is " + spans::text_of(width));
  if (rule == Overlong::contain) return {std::min(w.start, 1.0), std::min(w.end, 1.0)};
  if (!runs_backwards(w)) return w;
  return rule == Overlong::keep_ratio ? keying::keep_ratio(w.start, w.end) : keying::keep_start(w.start, w.end);
}

}  // namespace tweenfall
