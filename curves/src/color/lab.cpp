#include "color/color_spaces.h"

namespace tweenfall::color_spaces {
namespace {

// Source: W3C, "CSS Color Module Level 4", 10 and 17: Rec. 709 primaries, Bradford adaptation to white D50.
constexpr Matrix xyz_of_linear = {{{0.436065742824811, 0.3851514688337912, 0.14307845442264197},
                                   {0.22249319175623702, 0.7168870538238823, 0.06061979053616537},
                                   {0.013923904500943465, 0.09708128566574634, 0.7140993584005155}}};
constexpr Matrix linear_of_xyz = inverted(xyz_of_linear);
constexpr double white[3] = {0.3457 / 0.3585, 1, (1 - 0.3457 - 0.3585) / 0.3585};
constexpr double epsilon = 216.0 / 24389, kappa = 24389.0 / 27;

math::Jet compressed(const math::Jet& t) noexcept {
  return t.v > epsilon ? math::cbrt(t) : (t * kappa + 16) * (1.0 / 116);
}

math::Jet expanded(const math::Jet& f) noexcept {
  const math::Jet cube = f * f * f;
  return cube.v > epsilon ? cube : (f * 116 + -16) * (1 / kappa);
}

}  // namespace

Triple to_lab(const Triple& linear) noexcept {
  const Triple xyz = multiplied(xyz_of_linear, linear);
  const math::Jet x = compressed(xyz[0] * (1 / white[0])), y = compressed(xyz[1]),
                  z = compressed(xyz[2] * (1 / white[2]));
  return {y * 116 + -16, (x - y) * 500, (y - z) * 200};
}

Triple from_lab(const Triple& lab) noexcept {
  const math::Jet y = (lab[0] + 16) * (1.0 / 116);
  const math::Jet x = y + lab[1] * (1.0 / 500), z = y - lab[2] * (1.0 / 200);
  return multiplied(linear_of_xyz, {expanded(x) * white[0], expanded(y), expanded(z) * white[2]});
}

}  // namespace tweenfall::color_spaces
