#include "color/color_spaces.h"

namespace tweenfall::color_spaces {

// Source: Smith, "Color gamut transform pairs", 1978.
Triple srgb_to_hsv(const Triple& c) noexcept {
  const Hexcone cone = hexcone(c);
  return {cone.hue, cone.high.v == 0 ? math::constant(0) : cone.range * math::reciprocal(cone.high), cone.high};
}

Triple hsv_to_srgb(const Triple& hsv) noexcept {
  const Triple pure = pure_hue(hsv[0]);
  const math::Jet amount = hsv[1] * hsv[2];
  Triple result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = hsv[2] + amount * (pure[i] + -1.0);
  return result;
}

}  // namespace tweenfall::color_spaces
