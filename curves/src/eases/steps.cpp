#include "eases/shapes.h"

namespace tweenfall::shapes {

// Source: W3C, "CSS Easing Functions Level 1", steps().
Pieces steps(int count, std::string_view jump) {
  const bool at_start = jump == "jump-start" || jump == "jump-both";
  const bool at_end = jump == "jump-end" || jump == "jump-both";
  const int jumps = count - 1 + (at_start ? 1 : 0) + (at_end ? 1 : 0);
  Pieces result;
  for (int i = 0; i < count; ++i) {
    Span<double> p{};
    p.start = static_cast<double>(i) / count;
    p.duration = static_cast<double>(i + 1) / count - p.start;
    p.coefficients[0] = static_cast<double>(i + (at_start ? 1 : 0)) / jumps;
    p.end = p.coefficients[0];
    result.push_back(p);
  }
  return result;
}

}  // namespace tweenfall::shapes
