#include "keys/span_slopes.h"

#include <algorithm>

#include "slopes/slope_rule.h"

namespace tweenfall::keying {
namespace {

// On a loop whose last span has the same rule as its first, the run that crosses the seam is one run.
std::size_t seam_run(const SlopeRequest& request) {
  const std::size_t spans = request.durations.size();
  if (request.ends != Ends::wrap || spans == 0) return 0;
  const auto rule = [&request](std::size_t span) {
    return request.span_eases[span] ? request.span_eases[span]->slope_rule() : nullptr;
  };
  std::size_t first = spans;
  while (first > 0 && rule(first - 1) && rule(first - 1) == rule(0)) --first;
  return first == 0 || first == spans ? 0 : first;
}

// The loop as if it began with span `first`.
SlopeRequest rotated(const SlopeRequest& request, std::size_t first) {
  SlopeRequest result = request;
  const auto turn = [](auto& list, std::size_t by) {
    std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(by), list.end());
  };
  turn(result.durations, first);
  turn(result.secants, first * request.dimensions);
  turn(result.span_eases, first);
  // The first and the last key are the same; the ease of the first one counts.
  result.eases.pop_back();
  turn(result.eases, first);
  result.eases.push_back(result.eases.front());
  return result;
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

keying::Slopes keying::choose_slopes(const keying::SlopeRequest& given) {
  if (const std::size_t first = keying::seam_run(given)) {
    const std::size_t spans = given.durations.size();
    keying::SlopeRequest opened = keying::rotated(given, first);
    keying::Slopes result = keying::choose_slopes(opened);
    for (std::vector<double>* list : {&result.leaving, &result.arriving})
      std::rotate(list->begin(), list->begin() + static_cast<std::ptrdiff_t>((spans - first) * given.dimensions),
                  list->end());
    return result;
  }
  const keying::SlopeRequest& request = given;
  const std::size_t spans = request.durations.size();
  keying::Slopes result;
  result.leaving.assign(spans * request.dimensions, 0.0);
  result.arriving.assign(spans * request.dimensions, 0.0);
  for (std::size_t first = 0; first < spans;) {
    const Ease* ease = request.span_eases[first];
    std::size_t last = first + 1;
    if (ease) {
      const auto is_alike = [ease](const Ease* other) {
        return other == ease || (other && other->slope_rule() == ease->slope_rule());
      };
      while (last < spans && is_alike(request.span_eases[last])) ++last;
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

keying::SpanPlan keying::plan_span(const Ease& ease, bool has_tangents) {
  static const Ease smooth = Ease::smooth();
  if (has_tangents) return {keying::SpanKind::cubic, &smooth};
  if (ease.slope_rule()) return {keying::SpanKind::cubic, &ease};
  switch (ease.rule()) {
    case Ease::Rule::hold:
      return {keying::SpanKind::hold, nullptr};
    case Ease::Rule::shape:
      return {keying::SpanKind::shape, nullptr};
    default:
      return {keying::SpanKind::linear, nullptr};
  }
}

}  // namespace tweenfall
