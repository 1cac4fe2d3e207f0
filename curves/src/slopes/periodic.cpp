#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"

namespace tweenfall {

static void slopes_periodic(const SlopeProblem& p) {
  slopes::solve_c2_periodic(p);
}

Ease Ease::periodic() {
  static const Ease ease(Form{.name = "periodic", .slopes = &slopes_periodic, .continuous_acceleration = true});
  return ease;
}

namespace eases {
extern const Row periodic_row{"periodic", &Ease::periodic};
}  // namespace eases

}  // namespace tweenfall
