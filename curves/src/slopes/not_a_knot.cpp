#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"

namespace tweenfall::slopes {
namespace {

void not_a_knot(const SlopeProblem& p) {
  solve_c2_automatic(p, C2End::Kind::not_a_knot);
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::not_a_knot() {
  static const Ease ease(Form{.name = "not-a-knot",
                              .slopes = &slopes::not_a_knot,
                              .continuous_acceleration = true,
                              .c2_ends = slopes::C2End::Kind::not_a_knot});
  return ease;
}

namespace eases {
extern const Row not_a_knot_row{"not-a-knot", &Ease::not_a_knot};
}  // namespace eases

}  // namespace tweenfall
