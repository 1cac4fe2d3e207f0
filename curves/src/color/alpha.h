#pragma once

// Conversion to and from premultiplied coordinates, the form in which colors are mixed.

#include <tweenfall/curves/values.h>

#include "math/jet.h"

namespace tweenfall::color_spaces {

// Coordinates times alpha, except a hue, with rates by the product rule.
inline Sample<Vec4> premultiplied(const Sample<Vec4>& s, int hue) noexcept {
  Sample<Vec4> result = s;
  const math::Jet alpha{s.value[3], s.rate[3], s.acceleration[3]};
  for (int i = 0; i < 3; ++i) {
    if (i == hue) continue;
    const math::Jet p = math::Jet{s.value[i], s.rate[i], s.acceleration[i]} * alpha;
    result.value[i] = p.v;
    result.rate[i] = p.d;
    result.acceleration[i] = p.dd;
  }
  return result;
}

// The way back; where alpha is 0 the coordinates are 0, at rest.
inline Sample<Vec4> divided(const Sample<Vec4>& s, int hue) noexcept {
  Sample<Vec4> result = s;
  const math::Jet alpha{s.value[3], s.rate[3], s.acceleration[3]};
  const math::Jet inverse = alpha.v == 0 ? math::Jet{} : math::reciprocal(alpha);
  for (int i = 0; i < 3; ++i) {
    if (i == hue) continue;
    const math::Jet p = math::Jet{s.value[i], s.rate[i], s.acceleration[i]} * inverse;
    result.value[i] = p.v;
    result.rate[i] = p.d;
    result.acceleration[i] = p.dd;
  }
  return result;
}

}  // namespace tweenfall::color_spaces
