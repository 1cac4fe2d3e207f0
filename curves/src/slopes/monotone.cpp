#include <cmath>

#include "eases/ease_row.h"
#include "slopes/slope_rule.h"

namespace tweenfall::slopes {
namespace {

bool same_sign(double a, double b) noexcept {
  return (a > 0 && b > 0) || (a < 0 && b < 0);
}

// One-sided three-point slope at an end, kept from overshooting.
double end_slope(double h0, double h1, double d0, double d1) noexcept {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!same_sign(slope, d0)) return 0;
  if (!same_sign(d0, d1) && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}

// Source: Fritsch and Butland, "A method for constructing local monotone piecewise cubic interpolants", 1984.
void monotone(const SlopeProblem& p) {
  p.for_each_key([&p](std::size_t key, std::size_t c) {
    const std::size_t a = p.before(key), b = p.after(key);
    if (a == SlopeProblem::none || b == SlopeProblem::none) {
      if (p.ends == Ends::flat) return 0.0;
      const std::size_t own = a == SlopeProblem::none ? b : a;
      if (p.spans == 1) return p.secant(own, c);
      const std::size_t next = a == SlopeProblem::none ? own + 1 : own - 1;
      return end_slope(p.durations[own], p.durations[next], p.secant(own, c), p.secant(next, c));
    }
    const double d0 = p.secant(a, c), d1 = p.secant(b, c);
    if (!same_sign(d0, d1)) return 0.0;
    const double h0 = p.durations[a], h1 = p.durations[b];
    const double w0 = (2 * h1 + h0) / (3 * (h0 + h1)), w1 = (h1 + 2 * h0) / (3 * (h0 + h1));
    return 1 / (w0 / d0 + w1 / d1);
  });
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::monotone() {
  static const Ease ease(Form{.name = "monotone", .slopes = &slopes::monotone});
  return ease;
}

namespace eases {
extern const Row monotone_row{"monotone", &Ease::monotone};
}  // namespace eases

}  // namespace tweenfall
