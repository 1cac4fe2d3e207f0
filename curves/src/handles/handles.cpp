#include <tweenfall/curves/handles.h>

#include <cmath>

#include "curve/bezier_span.h"
#include "curve/curve_data.h"

namespace tweenfall::handling {
namespace {

// A handle's share of the span; exactly a third where only the rounding of absolute times differs from it.
double share(double length, double duration, double time) noexcept {
  constexpr double third = 1.0 / 3;
  const double result = length / duration;
  return std::abs(result - third) <= 1e-15 * (1 + std::abs(time) / duration) ? third : result;
}

void append_span(std::vector<Span<double>>& spans, const HandleKey& a, const HandleKey& b, Overlong overlong) {
  Span<double> span{};
  span.start = a.time;
  span.duration = b.time - a.time;
  span.end = b.value;
  const double change = b.value - a.value;
  const double first = a.out.value - a.value, second = b.value - b.in.value;
  const HandleWidths widths{share(a.out.time - a.time, span.duration, a.time),
                            share(b.time - b.in.time, span.duration, b.time)};
  if (widths.start == 0 && widths.end == 0 && first == 0 && second == 0) {
    // Without handles time and value advance in proportion: a straight line.
    span.degree = 1;
    span.coefficients[0] = a.value;
    span.coefficients[1] = change;
  } else {
    spans::fill_bezier(span, a.value, change, first, second, widths, overlong);
  }
  spans.push_back(span);
}

std::optional<double> slope_of(double time, double value) {
  if (!(time > 0)) return std::nullopt;
  return value / time;
}

}  // namespace
}  // namespace tweenfall::handling

namespace tweenfall {

Curve<double> handle_curve(std::span<const HandleKey> keys, const HandleOptions& options) {
  const std::vector<HandleKey> placed = placed_handles(keys, options);
  const HandleKey &front = placed.front(), &back = placed.back();
  const spans::CurveEnd<double> before{
      {}, front.value, handling::slope_of(front.time - front.in.time, front.value - front.in.value)};
  const spans::CurveEnd<double> after{
      {}, back.value, handling::slope_of(back.out.time - back.time, back.out.value - back.value)};
  if (placed.size() == 1) return CurveAccess::one_key(front.value, front.time, before, after);
  std::vector<Span<double>> spans;
  for (std::size_t i = 0; i + 1 < placed.size(); ++i) {
    const HandleKey &a = placed[i], &b = placed[i + 1];
    if (!a.ease) {
      handling::append_span(spans, a, b, options.overlong);
      continue;
    }
    const Key<double> pair[] = {{a.time, a.value, *a.ease}, {b.time, b.value}};
    for (const Span<double>& span : keyed_curve<double>(pair).spans()) spans.push_back(span);
  }
  return CurveAccess::from_spans<double>(spans, back.time, before, after);
}

}  // namespace tweenfall
