#include <algorithm>

#include "color/color_spaces.h"

namespace tweenfall::color_spaces {
namespace {

constexpr double sixth = 0x1.921fb54442d18p+2 / 6;

}  // namespace

// Source: W3C, "CSS Color Module Level 4", 7.
Hexcone hexcone(const Triple& c) noexcept {
  std::size_t high = 0, low = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (c[i].v > c[high].v) high = i;
    if (c[i].v < c[low].v) low = i;
  }
  const math::Jet range = c[high] - c[low];
  if (!(range.v > 1e-9)) return {math::constant(0), c[low], c[high], math::constant(0)};
  const math::Jet within = (c[(high + 1) % 3] - c[(high + 2) % 3]) * math::reciprocal(range);
  math::Jet hue = (within + 2.0 * static_cast<double>(high)) * sixth;
  if (hue.v < 0) hue.v += 6 * sixth;
  return {hue, c[low], c[high], range};
}

Triple pure_hue(const math::Jet& hue) noexcept {
  const math::Jet sextant = hue * (1 / sixth);
  Triple result;
  constexpr double phases[3] = {0, 4, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    // A trapezoid around the circle: down for one sixth, low for two, up for one, high for two.
    math::Jet k = sextant + phases[i];
    k.v -= 6 * std::floor(k.v / 6);
    math::Jet wave = math::constant(0);
    if (k.v < 1 || k.v >= 5)
      wave = math::constant(1);
    else if (k.v < 2)
      wave = (k + -2.0) * -1.0;
    else if (k.v >= 4)
      wave = k + -4.0;
    result[i] = wave;
  }
  return result;
}

Triple srgb_to_hsl(const Triple& c) noexcept {
  const Hexcone cone = hexcone(c);
  const math::Jet lightness = (cone.high + cone.low) * 0.5;
  const math::Jet room = lightness.v < 0.5 ? lightness * 2 : (lightness + -1.0) * -2.0;
  return {cone.hue, room.v == 0 ? math::constant(0) : cone.range * math::reciprocal(room), lightness};
}

Triple hsl_to_srgb(const Triple& hsl) noexcept {
  const math::Jet& lightness = hsl[2];
  const math::Jet amount = hsl[1] * (lightness.v < 0.5 ? lightness : (lightness + -1.0) * -1.0);
  const Triple pure = pure_hue(hsl[0]);
  Triple result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = lightness + amount * (pure[i] * 2 + -1.0);
  return result;
}

}  // namespace tweenfall::color_spaces
