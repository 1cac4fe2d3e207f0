#include "eases/ease_row.h"
#include "slopes/akima_slopes.h"

namespace tweenfall::slopes {
namespace {

// Akima's weights with half the sum of the secants' sizes added, so that a flat stretch stays flat and the weights
// never vanish beside a slope. Source: MathWorks, documentation of "makima"; Boost.Math, "Modified Akima
// interpolation".
void makima(const SlopeProblem& p) {
  akima_slopes(p, [](double m0, double m1, double m2, double m3) {
    const double w1 = std::abs(m3 - m2) + 0.5 * std::abs(m3 + m2), w2 = std::abs(m1 - m0) + 0.5 * std::abs(m1 + m0);
    if (!(w1 + w2 > 0)) return 0.0;
    return w1 / (w1 + w2) * m1 + w2 / (w1 + w2) * m2;
  });
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::makima() {
  static const Ease ease(Form{.name = "makima", .slopes = &slopes::makima});
  return ease;
}

namespace eases {
extern const Row makima_row{"makima", &Ease::makima};
}  // namespace eases

}  // namespace tweenfall
