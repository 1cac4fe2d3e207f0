#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"

namespace tweenfall::slopes {
namespace {

void periodic(const SlopeProblem& p) {
  solve_c2_periodic(p);
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::periodic() {
  static const Ease ease(Form{.name = "periodic", .slopes = &slopes::periodic, .continuous_acceleration = true});
  return ease;
}

namespace eases {
extern const Row periodic_row{"periodic", &Ease::periodic};
}  // namespace eases

}  // namespace tweenfall
