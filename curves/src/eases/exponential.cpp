#include "eases/exponential.h"

#include <tweenfall/curves/elementary.h>

#include "eases/ease_row.h"

namespace tweenfall::eases {

Decay decay(double x) noexcept {
  constexpr double rate = 10 * 0x1.62e42fefa39efp-1;
  constexpr double residue = 1.0 / 1024, scale = 1024.0 / 1023;
  if (x == 0) return {1, -rate * scale, rate * rate * scale};
  const double e = x == 1 ? residue : elementary::exp(-rate * x);
  return {(e - residue) * scale, -rate * e * scale, rate * rate * e * scale};
}

namespace {

Warp::Result exponential_in(double u, const std::array<double, 4>&) noexcept {
  const Decay d = decay(1 - u);
  return {d.value, -d.first, d.second};
}

}  // namespace

static Pieces exponential(Flow flow) {
  return flowing(WayIn{{0, 1}, {&exponential_in, {}}, &reversed<&exponential_in>}, flow);
}

extern const FamilyRow exponential_family{"expo", [](const Numbers&, Flow flow) { return exponential(flow); }};

}  // namespace tweenfall::eases
