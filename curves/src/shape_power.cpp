#include "shapes.h"

namespace tweenfall::shapes {

// Source: Penner, "Robert Penner's Programming Macromedia Flash MX", 2002, chapter 7.
Pieces power(int degree, Flow flow) {
  std::vector<double> c(static_cast<std::size_t>(degree) + 1, 0.0);
  c.back() = 1;
  return flowing(WayIn{c}, flow);
}

// u^2 ((overshoot + 1) u - overshoot).
Pieces back(double overshoot, Flow flow) {
  return flowing(WayIn{{0, 0, -overshoot, overshoot + 1}}, flow);
}

}  // namespace tweenfall::shapes
