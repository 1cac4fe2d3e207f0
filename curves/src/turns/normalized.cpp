#include "turns/turn_rule.h"

namespace tweenfall {

void turns_normalized(const TurnProblem& p) {
  for (std::size_t i = p.first; i < p.last; ++i) {
    RotationSpan span = blank_span(p.stretches[i]);
    span.form = RotationSpan::Form::normalized;
    span.degree = 1;
    span.coefficients[0] = p.stretches[i].from.coeffs();
    span.coefficients[1] = p.stretches[i].near_to().coeffs() - p.stretches[i].from.coeffs();
    p.spans.push_back(span);
  }
}

}  // namespace tweenfall
