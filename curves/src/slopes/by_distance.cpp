#include <algorithm>
#include <cmath>

#include "eases/ease_row.h"
#include "slopes/slope_rule.h"

namespace tweenfall::slopes {
namespace {

// How far the spline's own parameter advances over a span whose ends lie `distance` apart.
using Advance = double (*)(double distance);

double advance_of(const SlopeProblem& p, std::size_t span, Advance advance) noexcept {
  // Divided by the largest component first, so that no square overflows.
  double largest = 0, square = 0;
  for (std::size_t c = 0; c < p.dimensions; ++c)
    largest = std::max(largest, std::abs(p.secant(span, c) * p.durations[span]));
  if (!(largest > 0)) return advance(0);
  for (std::size_t c = 0; c < p.dimensions; ++c) {
    const double step = p.secant(span, c) * p.durations[span] / largest;
    square += step * step;
  }
  return advance(largest * std::sqrt(square));
}

// Catmull-Rom in a parameter of its own that advances evenly through each span, whatever the span's duration. The
// direction is continuous at a key; the speed is each span's own. Source: Yuksel, Schaefer, Keyser, "Parameterization
// and applications of Catmull-Rom curves", 2011.
void by_distance(const SlopeProblem& p, Advance advance) {
  const auto slopes_at = [&p, advance](std::size_t key, std::size_t span, double* result) {
    const std::size_t a = p.before(key), b = p.after(key);
    const double t0 = a == SlopeProblem::none ? 0 : advance_of(p, a, advance);
    const double t1 = b == SlopeProblem::none ? 0 : advance_of(p, b, advance);
    const double own = span == a ? t0 : t1;
    for (std::size_t c = 0; c < p.dimensions; ++c) {
      result[c] = 0;
      // A rest beside the key has no direction: the curve stops there.
      if (!(t0 > 0) || !(t1 > 0)) continue;
      const double v0 = p.secant(a, c) * p.durations[a] / t0, v1 = p.secant(b, c) * p.durations[b] / t1;
      result[c] = (t1 / (t0 + t1) * v0 + t0 / (t0 + t1) * v1) * own / p.durations[span];
    }
  };
  for (std::size_t i = p.first; i < p.last; ++i) {
    slopes_at(i, i, p.leaving + i * p.dimensions);
    slopes_at(i + 1, i, p.arriving + i * p.dimensions);
  }
  p.finish_open_ends();
}

void uniform(const SlopeProblem& p) {
  by_distance(p, [](double) { return 1.0; });
}

void centripetal(const SlopeProblem& p) {
  by_distance(p, [](double distance) { return std::sqrt(distance); });
}

void chordal(const SlopeProblem& p) {
  by_distance(p, [](double distance) { return distance; });
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::uniform() {
  static const Ease ease(Form{.name = "uniform", .slopes = &slopes::uniform});
  return ease;
}

namespace eases {
extern const Row uniform_row{"uniform", &Ease::uniform};
}  // namespace eases

Ease Ease::centripetal() {
  static const Ease ease(Form{.name = "centripetal", .slopes = &slopes::centripetal});
  return ease;
}

namespace eases {
extern const Row centripetal_row{"centripetal", &Ease::centripetal};
}  // namespace eases

Ease Ease::chordal() {
  static const Ease ease(Form{.name = "chordal", .slopes = &slopes::chordal});
  return ease;
}

namespace eases {
extern const Row chordal_row{"chordal", &Ease::chordal};
}  // namespace eases

}  // namespace tweenfall
