#include "forces/kinds/kinds.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>

#include <cmath>

#include "state/checks.h"

namespace tweenfall::forces {

double fall_off(double square, double power) {
  if (!(square > 0)) return 0;
  if (power == 2) return 1 / (square * std::sqrt(square));
  if (power == 1) return 1 / square;
  if (power == 0) return 1 / std::sqrt(square);
  if (power == -1) return 1;
  return elementary::pow(square, -0.5 * (power + 1));
}

void require_power(double power, const char* name) {
  constexpr double least = -4, most = 8;
  state::require(power >= least && power <= most,
                 "power of " + std::string(name) + " must lie in -4 to 8, but is " + number_text(power));
}

}  // namespace tweenfall::forces
