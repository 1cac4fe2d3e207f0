#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

/// A spring that holds at every length.
Spring spring_of(const Damper& kind, double strength) {
  return {kind.a, kind.b, kind.anchor_a, kind.anchor_b, 0, 0, kind.damping * not_negative(strength)};
}

void validate(const Damper& kind) {
  state::require_finite(kind.anchor_a, "first anchor of a damper");
  state::require_finite(kind.anchor_b, "second anchor of a damper");
  state::require_amount(kind.damping, "damping of a damper");
}

}  // namespace tweenfall::forces
