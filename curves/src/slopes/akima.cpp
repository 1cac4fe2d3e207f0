#include "eases/ease_row.h"
#include "slopes/akima_slopes.h"

namespace tweenfall::slopes {
namespace {

// Source: Akima, "A new method of interpolation and smooth curve fitting based on local procedures", J. ACM 17, 1970.
void akima(const SlopeProblem& p) {
  akima_slopes(p, [](double m0, double m1, double m2, double m3) {
    const double w1 = std::abs(m3 - m2), w2 = std::abs(m1 - m0);
    // Where both pairs of secants agree up to rounding, their weights would be only that rounding.
    const double noise = 1e-9 * std::max({std::abs(m0), std::abs(m1), std::abs(m2), std::abs(m3)});
    if (!(w1 + w2 > noise)) return 0.5 * m1 + 0.5 * m2;
    return w1 / (w1 + w2) * m1 + w2 / (w1 + w2) * m2;
  });
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::akima() {
  static const Ease ease(Form{.name = "akima", .slopes = &slopes::akima});
  return ease;
}

namespace eases {
extern const Row akima_row{"akima", &Ease::akima};
}  // namespace eases

}  // namespace tweenfall
