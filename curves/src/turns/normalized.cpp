#include "eases/ease_row.h"
#include "turns/turn_rule.h"

namespace tweenfall::turns {
namespace {

void normalized(const TurnProblem& p) {
  for (std::size_t i = p.first; i < p.last; ++i) {
    RotationSpan span = blank_span(p.stretches[i]);
    span.form = RotationSpan::Form::normalized;
    span.degree = 1;
    span.coefficients[0] = p.stretches[i].from.coeffs();
    span.coefficients[1] = p.stretches[i].near_to().coeffs() - p.stretches[i].from.coeffs();
    p.spans.push_back(span);
  }
}

}  // namespace
}  // namespace tweenfall::turns

namespace tweenfall {

Ease Ease::nlerp() {
  static const Ease ease(Form{.rule = Rule::linear, .name = "nlerp", .turns = &turns::normalized});
  return ease;
}

namespace eases {
extern const Row nlerp_row{"nlerp", &Ease::nlerp};
}  // namespace eases

}  // namespace tweenfall
