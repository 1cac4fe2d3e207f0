#include "color/color_spaces.h"

namespace tweenfall::color_spaces {
namespace {

math::Jet mirrored(const math::Jet& x, math::Jet (*f)(const math::Jet&)) noexcept {
  return x.v < 0 ? -1.0 * f(-1.0 * x) : f(x);
}

// Source: IEC 61966-2-1, 1999.
math::Jet encoded(const math::Jet& x) noexcept {
  return x.v <= 0.0031308 ? x * 12.92 : math::pow(x, 1 / 2.4) * 1.055 + -0.055;
}

math::Jet decoded(const math::Jet& x) noexcept {
  return x.v <= 0.04045 ? x * (1 / 12.92) : math::pow((x + 0.055) * (1 / 1.055), 2.4);
}

}  // namespace

Triple to_srgb(const Triple& c) noexcept {
  return {mirrored(c[0], &encoded), mirrored(c[1], &encoded), mirrored(c[2], &encoded)};
}

Triple from_srgb(const Triple& c) noexcept {
  return {mirrored(c[0], &decoded), mirrored(c[1], &decoded), mirrored(c[2], &decoded)};
}

}  // namespace tweenfall::color_spaces
