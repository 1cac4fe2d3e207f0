#include <algorithm>
#include <cmath>

#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

// 1 - sqrt(1 - u^2), written so that small values keep their digits; the slope at 1 is limited to a million.
Warp::Result circular_in(double u, const std::array<double, 4>&) noexcept {
  const double height = std::sqrt((1 - u) * (1 + u));
  const double limited = std::max(height, 1e-6);
  return {u * u / (1 + height), u / limited, height > 1e-6 ? 1 / (height * height * height) : 0};
}

}  // namespace

static Pieces circular(Flow flow) {
  return flowing(WayIn{{0, 1}, {&circular_in, {}}, &reversed<&circular_in>}, flow);
}

extern const FamilyRow circular_family{"circ", [](const Numbers&, Flow flow) { return circular(flow); }};

}  // namespace tweenfall::eases
