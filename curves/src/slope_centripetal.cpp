#include <cmath>

#include "slope_rule.h"

namespace tweenfall {
namespace {

// The spline's own parameter advances by the square root of the distance between two keys.
double advance(const SlopeProblem& p, std::size_t span) noexcept {
  double square = 0;
  for (std::size_t c = 0; c < p.dimensions; ++c) {
    const double step = p.secant(span, c) * p.durations[span];
    square += step * step;
  }
  return std::sqrt(std::sqrt(square));
}

}  // namespace

// Source: Yuksel, Schaefer, Keyser, "Parameterization and applications of Catmull-Rom curves", 2011.
void slopes_centripetal(const SlopeProblem& p) {
  const auto slopes_at = [&p](std::size_t key, std::size_t span, double* result) {
    const std::size_t a = p.before(key), b = p.after(key);
    const double t0 = a == SlopeProblem::none ? 0 : advance(p, a), t1 = b == SlopeProblem::none ? 0 : advance(p, b);
    const double own = span == a ? t0 : t1;
    for (std::size_t c = 0; c < p.dimensions; ++c) {
      result[c] = 0;
      // A rest beside the key has no direction: the curve stops there.
      if (!(t0 > 0) || !(t1 > 0)) continue;
      const double v0 = p.secant(a, c) * p.durations[a] / t0, v1 = p.secant(b, c) * p.durations[b] / t1;
      result[c] = (t1 * v0 + t0 * v1) / (t0 + t1) * own / p.durations[span];
    }
  };
  for (std::size_t i = p.first; i < p.last; ++i) {
    slopes_at(i, i, p.leaving + i * p.dimensions);
    slopes_at(i + 1, i, p.arriving + i * p.dimensions);
  }
  p.finish_open_ends();
}

}  // namespace tweenfall
