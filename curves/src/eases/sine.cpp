#include <tweenfall/curves/elementary.h>

#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

// 1 - cos(u pi/2), from the half angle so that small values keep their digits.
Warp::Result sine_in(double u, const std::array<double, 4>&) noexcept {
  constexpr double quarter_turn = 0x1.921fb54442d18p+0;
  if (u >= 1) return {1, quarter_turn, 0};
  const elementary::SinCos half = elementary::sin_cos(u * (quarter_turn / 2));
  return {2 * half.sin * half.sin, quarter_turn * 2 * half.sin * half.cos,
          quarter_turn * quarter_turn * (half.cos * half.cos - half.sin * half.sin)};
}

}  // namespace

static Pieces sine(Flow flow) {
  return flowing(WayIn{{0, 1}, {&sine_in, {}}, &reversed<&sine_in>}, flow);
}

extern const FamilyRow sine_family{"sine", [](const Numbers&, Flow flow) { return sine(flow); }};

}  // namespace tweenfall::eases
