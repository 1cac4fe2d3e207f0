#include <algorithm>

#include "color/color_spaces.h"

namespace tweenfall::color_spaces {

Triple to_polar(const Triple& plane, double gray) noexcept {
  const math::Jet &a = plane[1], &b = plane[2];
  const math::Jet square = a * a + b * b;
  const double chroma = std::sqrt(square.v);
  if (!(chroma > gray)) return {plane[0], math::constant(chroma), math::constant(0)};
  const math::Jet c = math::chained(square, chroma, 0.5 / chroma, -0.25 / (chroma * square.v));
  // The rate of the angle is (a b' - b a') / c^2, and its rate follows from the quotient.
  const double turn = a.v * b.d - b.v * a.d;
  const double turn_rate = a.v * b.dd - b.v * a.dd;
  const double rate = turn / square.v;
  return {plane[0], c, {elementary::atan2(b.v, a.v), rate, (turn_rate - rate * square.d) / square.v}};
}

Triple from_polar(const Triple& polar) noexcept {
  const math::Jet& h = polar[2];
  const elementary::SinCos t = elementary::sin_cos(h.v);
  return {polar[0], polar[1] * math::chained(h, t.cos, -t.sin, -t.cos),
          polar[1] * math::chained(h, t.sin, t.cos, -t.sin)};
}

}  // namespace tweenfall::color_spaces
