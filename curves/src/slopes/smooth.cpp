#include <algorithm>
#include <cmath>

#include "eases/ease_row.h"
#include "slopes/slope_rule.h"

namespace tweenfall::slopes {
namespace {

double end_slope(const SlopeProblem& p, std::size_t own_span, std::size_t c) noexcept {
  return p.ends == Ends::flat ? 0.0 : p.secant(own_span, c);
}

void smooth(const SlopeProblem& p) {
  p.for_each_key([&p](std::size_t key, std::size_t c) {
    const std::size_t a = p.before(key), b = p.after(key);
    if (a == SlopeProblem::none) return end_slope(p, b, c);
    if (b == SlopeProblem::none) return end_slope(p, a, c);
    return 0.5 * p.secant(a, c) + 0.5 * p.secant(b, c);
  });
}

// Three times the smaller secant keeps a cubic between its two values.
// Source: Fritsch and Carlson, "Monotone piecewise cubic interpolation", SIAM J. Numer. Anal. 17, 1980.
void smooth_clamped(const SlopeProblem& p) {
  p.for_each_key([&p](std::size_t key, std::size_t c) {
    const std::size_t a = p.before(key), b = p.after(key);
    if (a == SlopeProblem::none) return end_slope(p, b, c);
    if (b == SlopeProblem::none) return end_slope(p, a, c);
    const double d0 = p.secant(a, c), d1 = p.secant(b, c);
    if (!((d0 > 0 && d1 > 0) || (d0 < 0 && d1 < 0))) return 0.0;
    const double limit = 3 * std::min(std::abs(d0), std::abs(d1));
    return std::clamp(0.5 * d0 + 0.5 * d1, -limit, limit);
  });
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::smooth() {
  static const Ease ease(Form{.rule = Rule::smooth, .name = "smooth", .slopes = &slopes::smooth});
  return ease;
}

namespace eases {
extern const Row smooth_row{"smooth", &Ease::smooth};
}  // namespace eases

Ease Ease::smooth_clamped() {
  static const Ease ease(
      Form{.rule = Rule::smooth_clamped, .name = "smooth-clamped", .slopes = &slopes::smooth_clamped});
  return ease;
}

namespace eases {
extern const Row smooth_clamped_row{"smooth-clamped", &Ease::smooth_clamped};
}  // namespace eases

}  // namespace tweenfall
