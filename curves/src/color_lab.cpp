#include "color_spaces.h"

namespace tweenfall::color_spaces {
namespace {

// Source: W3C, "CSS Color Module Level 4", 10 and 17: Rec. 709 primaries, Bradford adaptation to white D50.
constexpr Matrix xyz65_of_linear = {{{506752.0 / 1228815, 87881.0 / 245763, 12673.0 / 70218},
                                     {87098.0 / 409605, 175762.0 / 245763, 12673.0 / 175545},
                                     {7918.0 / 409605, 87881.0 / 737289, 1001167.0 / 1053270}}};
constexpr Matrix xyz50_of_xyz65 = {{{1.0479297925449969, 0.022946870601609652, -0.05019226628920524},
                                    {0.02962780877005599, 0.9904344267538799, -0.017073799063418826},
                                    {-0.009243040646204504, 0.015055191490298152, 0.7518742814281371}}};
constexpr Matrix xyz_of_linear = multiplied(xyz50_of_xyz65, xyz65_of_linear);
constexpr Matrix linear_of_xyz = inverted(xyz_of_linear);
constexpr double white[3] = {0.3457 / 0.3585, 1, (1 - 0.3457 - 0.3585) / 0.3585};
constexpr double epsilon = 216.0 / 24389, kappa = 24389.0 / 27;

Jet compressed(const Jet& t) noexcept {
  return t.v > epsilon ? cbrt(t) : (t * kappa + 16) * (1.0 / 116);
}

Jet expanded(const Jet& f) noexcept {
  const Jet cube = f * f * f;
  return cube.v > epsilon ? cube : (f * 116 + -16) * (1 / kappa);
}

}  // namespace

Triple to_lab(const Triple& linear) noexcept {
  const Triple xyz = multiplied(xyz_of_linear, linear);
  const Jet x = compressed(xyz[0] * (1 / white[0])), y = compressed(xyz[1]), z = compressed(xyz[2] * (1 / white[2]));
  return {y * 116 + -16, (x - y) * 500, (y - z) * 200};
}

Triple from_lab(const Triple& lab) noexcept {
  const Jet y = (lab[0] + 16) * (1.0 / 116);
  const Jet x = y + lab[1] * (1.0 / 500), z = y - lab[2] * (1.0 / 200);
  return multiplied(linear_of_xyz, {expanded(x) * white[0], expanded(y), expanded(z) * white[2]});
}

}  // namespace tweenfall::color_spaces
