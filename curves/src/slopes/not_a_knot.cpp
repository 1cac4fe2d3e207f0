#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"

namespace tweenfall {

static void slopes_not_a_knot(const SlopeProblem& p) {
  slopes::solve_c2_automatic(p, slopes::C2End::Kind::not_a_knot);
}

Ease Ease::not_a_knot() {
  static const Ease ease(Form{.name = "not-a-knot", .slopes = &slopes_not_a_knot, .continuous_acceleration = true});
  return ease;
}

namespace eases {
extern const Row not_a_knot_row{"not-a-knot", &Ease::not_a_knot};
}  // namespace eases

}  // namespace tweenfall
