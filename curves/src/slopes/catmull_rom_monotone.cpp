#include <algorithm>
#include <cmath>

#include "eases/ease_row.h"
#include "slopes/slope_rule.h"

namespace tweenfall::slopes {
namespace {

// Zero at a local extreme, else at most three times the smaller secant.
double limited(double slope, double d0, double d1) noexcept {
  if (!((d0 > 0 && d1 > 0) || (d0 < 0 && d1 < 0))) return 0;
  const double limit = 3 * std::min(std::abs(d0), std::abs(d1));
  return std::clamp(slope, -limit, limit);
}

// Source: Dougherty, Edelman, Hyman, "Nonnegativity-, monotonicity-, or convexity-preserving cubic and quintic Hermite
// interpolation", Math. Comp. 52, 1989, equation 4.2, on Catmull-Rom slopes.
void catmull_rom_monotone(const SlopeProblem& p) {
  catmull_rom(p);
  for (std::size_t i = p.first; i < p.last; ++i)
    for (std::size_t c = 0; c < p.dimensions; ++c) {
      const double own = p.secant(i, c);
      const auto limit = [&p, c, own](double& slope, std::size_t other) {
        slope = limited(slope, own, other == SlopeProblem::none ? own : p.secant(other, c));
      };
      limit(p.leaving[i * p.dimensions + c], p.before(i));
      limit(p.arriving[i * p.dimensions + c], p.after(i + 1));
    }
  // Computed from limited neighbors, these lie within the limits too.
  p.finish_open_ends();
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::catmull_rom_monotone() {
  static const Ease ease(Form{.name = "catmull-rom-monotone", .slopes = &slopes::catmull_rom_monotone});
  return ease;
}

namespace eases {
extern const Row catmull_rom_monotone_row{"catmull-rom-monotone", &Ease::catmull_rom_monotone};
}  // namespace eases

}  // namespace tweenfall
