#include "color/color_spaces.h"

namespace tweenfall::color_spaces {

// Source: W3C, "CSS Color Module Level 4", 8.
Triple srgb_to_hwb(const Triple& c) noexcept {
  const Hexcone cone = hexcone(c);
  return {cone.hue, cone.low, (cone.high + -1.0) * -1.0};
}

Triple hwb_to_srgb(const Triple& hwb) noexcept {
  const math::Jet& white = hwb[1];
  const math::Jet sum = white + hwb[2];
  if (sum.v >= 1) {
    const math::Jet gray = white * math::reciprocal(sum);
    return {gray, gray, gray};
  }
  const Triple pure = pure_hue(hwb[0]);
  const math::Jet amount = (sum + -1.0) * -1.0;
  Triple result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = white + amount * pure[i];
  return result;
}

}  // namespace tweenfall::color_spaces
