#include "color/color_spaces.h"

namespace tweenfall::color_spaces {
namespace {

// Source: Ottosson, "A perceptual color space for image processing", 2020.
constexpr Matrix cones_of_linear = {{{0.4122214708, 0.5363325363, 0.0514459929},
                                     {0.2119034982, 0.6806995451, 0.1073969566},
                                     {0.0883024619, 0.2817188376, 0.6299787005}}};
constexpr Matrix oklab_of_roots = {{{0.2104542553, 0.7936177850, -0.0040720468},
                                    {1.9779984951, -2.4285922050, 0.4505937099},
                                    {0.0259040371, 0.7827717662, -0.8086757660}}};
constexpr Matrix linear_of_cones = inverted(cones_of_linear);
constexpr Matrix roots_of_oklab = inverted(oklab_of_roots);

}  // namespace

Triple to_oklab(const Triple& linear) noexcept {
  const Triple cones = multiplied(cones_of_linear, linear);
  return multiplied(oklab_of_roots, {math::cbrt(cones[0]), math::cbrt(cones[1]), math::cbrt(cones[2])});
}

Triple from_oklab(const Triple& oklab) noexcept {
  const Triple r = multiplied(roots_of_oklab, oklab);
  return multiplied(linear_of_cones, {r[0] * r[0] * r[0], r[1] * r[1] * r[1], r[2] * r[2] * r[2]});
}

}  // namespace tweenfall::color_spaces
