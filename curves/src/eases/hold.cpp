#include "eases/ease_row.h"

namespace tweenfall {

Ease Ease::hold() {
  static const Ease ease(Form{.rule = Rule::hold, .name = "hold"});
  return ease;
}

namespace eases {
extern const Row hold_row{"hold", &Ease::hold};
}  // namespace eases

}  // namespace tweenfall
