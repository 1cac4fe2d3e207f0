#include "span_slopes.h"

#include "slope_rule.h"

namespace tweenfall {

Slopes choose_slopes(const SlopeRequest& request) {
  const std::size_t spans = request.durations.size();
  Slopes result;
  result.leaving.assign(spans * request.dimensions, 0.0);
  result.arriving.assign(spans * request.dimensions, 0.0);
  for (std::size_t first = 0; first < spans;) {
    const Ease* ease = request.span_eases[first];
    std::size_t last = first + 1;
    if (ease) {
      while (last < spans && request.span_eases[last] && request.span_eases[last]->slope_rule() == ease->slope_rule())
        ++last;
      const SlopeProblem problem{spans,
                                 first,
                                 last,
                                 request.dimensions,
                                 request.durations.data(),
                                 request.secants.data(),
                                 request.ends,
                                 request.eases.data(),
                                 result.leaving.data(),
                                 result.arriving.data()};
      ease->slope_rule()(problem);
    }
    first = last;
  }
  return result;
}

SpanPlan plan_span(const Ease& ease, bool has_tangents) {
  static const Ease smooth = Ease::smooth();
  if (has_tangents) return {SpanKind::cubic, &smooth};
  if (ease.slope_rule()) return {SpanKind::cubic, &ease};
  switch (ease.rule()) {
    case Ease::Rule::hold:
      return {SpanKind::hold, nullptr};
    case Ease::Rule::shape:
      return {SpanKind::shape, nullptr};
    default:
      return {SpanKind::linear, nullptr};
  }
}

}  // namespace tweenfall
