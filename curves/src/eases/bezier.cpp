#include "curve/time_bezier.h"
#include "eases/shapes.h"

namespace tweenfall::shapes {

// Source: W3C, "CSS Easing Functions Level 1", cubic-bezier.
Pieces bezier(double x1, double y1, double x2, double y2) {
  Span<double> p{};
  p.degree = 3;
  p.coefficients = {0, 3 * y1, 3 * y2 - 6 * y1, 1 + 3 * y1 - 3 * y2, 0, 0};
  p.end = 1;
  p.warp = time_bezier_warp(x1, x2);
  return {p};
}

}  // namespace tweenfall::shapes
