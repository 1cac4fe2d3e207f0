#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/inspection.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/extrapolation.h"
#include "curve/span_part.h"
#include "curve/spans_between.h"

namespace tweenfall::editing {
namespace {

void check_order(double from, double to) {
  spans::check_times(from, to);
  if (!(from < to))
    throw std::invalid_argument("a part must end after it starts, at " + spans::text_of(from) + " s; it ends at " +
                                spans::text_of(to) + " s");
}

// What lies beyond an end of a curve, including a formula.
template <class T>
spans::CurveEnd<T> end_of(const Curve<T>& curve, bool early) {
  spans::CurveEnd<T> end = early ? CurveAccess::data(curve).before : CurveAccess::data(curve).after;
  if (curve.spans().empty() && !spans::loops(end.rule.rule) && std::isfinite(early ? curve.start() : curve.end()))
    end.value = early ? curve.value(curve.start(), Side::in) : curve.value(curve.end(), Side::out);
  return end;
}

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
Curve<T> trimmed(const Curve<T>& curve, double from, double to) {
  editing::check_order(from, to);
  spans::CurveEnd<T> before, after;
  if (from == curve.start()) before = editing::end_of(curve, true);
  if (to == curve.end()) after = editing::end_of(curve, false);
  before.rule = after.rule = {};
  if (to < curve.end()) after.value = curve.value(to, Side::out);
  if (spans::has_spans(curve))
    return CurveAccess::from_spans<T>(spans::spans_between(curve, from, to), to, before, after);
  const std::vector<double> knots =
      curve.knots().empty() ? std::vector<double>{} : spans::seams_between(curve, from, to);
  const Curve<T> part = CurveAccess::formula_with_knots<T>(
      [curve](double time, Side side) { return curve.sample(time, side); }, from, to, {knots});
  return CurveAccess::with_ends(part, before, after);
}

template <class T>
std::pair<Curve<T>, Curve<T>> split(const Curve<T>& curve, double time) {
  if (!(curve.start() < time && time < curve.end()))
    throw std::invalid_argument("a curve from " + spans::text_of(curve.start()) + " s to " +
                                spans::text_of(curve.end()) + " s cannot be split at " + spans::text_of(time) + " s");
  return {trimmed(curve, curve.start(), time), trimmed(curve, time, curve.end())};
}

template <class T>
Curve<T> joined(const Curve<T>& first, const Curve<T>& second) {
  const double seam = first.end();
  if (!(std::abs(second.start() - seam) <= 4e-16 * (std::abs(seam) + std::abs(first.start()))))
    throw std::invalid_argument("the second curve must start where the first ends, at " + spans::text_of(seam) +
                                " s; it starts at " + spans::text_of(second.start()) + " s");
  std::vector<typename SpanOf<T>::type> spans = first.spans(), more = second.spans();
  if (spans.empty() || more.empty()) {
    const auto united = [](std::span<const double> early, std::span<const double> late) {
      std::vector<double> times(early.begin(), early.end());
      for (const double time : late)
        if (times.empty() || time > times.back()) times.push_back(time);
      return times;
    };
    const spans::Breaks breaks{united(first.knots(), second.knots()), united(first.key_times(), second.key_times())};
    const Curve<T> whole = CurveAccess::formula_with_knots<T>(
        [first, second, seam](double time, Side side) {
          const bool early = time < seam || (time == seam && side == Side::in);
          return (early ? first : second).sample(time, side);
        },
        first.start(), second.end(), breaks);
    return CurveAccess::with_ends(whole, editing::end_of(first, true), editing::end_of(second, false));
  }
  more.front().start = seam;
  spans.insert(spans.end(), more.begin(), more.end());
  return CurveAccess::from_spans<T>(spans, second.end(), editing::end_of(first, true), editing::end_of(second, false));
}

template <class T>
Curve<T> with_knot(const Curve<T>& curve, double time) {
  std::vector<typename SpanOf<T>::type> spans = curve.spans();
  if (spans.empty()) throw std::invalid_argument("a formula has no spans into which a knot could be put");
  if (!(curve.start() <= time && time <= curve.end()))
    throw std::invalid_argument("a knot at " + spans::text_of(time) + " s would lie outside the curve, from " +
                                spans::text_of(curve.start()) + " s to " + spans::text_of(curve.end()) + " s");
  const std::span<const double> knots = curve.knots();
  if (std::binary_search(knots.begin(), knots.end(), time)) return curve;
  const std::size_t i =
      static_cast<std::size_t>(std::lower_bound(knots.begin(), knots.end(), time) - knots.begin()) - 1;
  const auto whole = spans[i];
  const double u = (time - knots[i]) / (knots[i + 1] - knots[i]);
  spans[i] = spans::span_part(whole, 0, u, knots[i], time);
  spans.insert(spans.begin() + static_cast<std::ptrdiff_t>(i) + 1, spans::span_part(whole, u, 1, time, knots[i + 1]));
  spans[i + 1].starts_at_key = true;
  return CurveAccess::from_spans<T>(spans, curve.end(), editing::end_of(curve, true), editing::end_of(curve, false));
}

template <class T>
Curve<T> without_redundant_knots(const Curve<T>& curve, double tolerance) {
  const std::vector<std::size_t> redundant = redundant_knots(curve, tolerance);
  if (redundant.empty()) return curve;
  const std::vector<Span<T>> spans = curve.spans();
  std::vector<Span<T>> kept;
  auto next = redundant.begin();
  double continued_from = 0, continued_to = 0;  // of the span being continued
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (next == redundant.end() || *next != i) {
      kept.push_back(spans[i]);
      continued_from = spans[i].start;
      continued_to = curve.knots()[i + 1];
      continue;
    }
    ++next;
    Span<T>& span = kept.back();
    const T end = spans[i].end;
    const double u = (curve.knots()[i + 1] - continued_from) / (continued_to - continued_from);
    span = spans::span_part(span, 0, u, continued_from, curve.knots()[i + 1]);
    span.end = end;
    continued_to = curve.knots()[i + 1];
  }
  return CurveAccess::from_spans<T>(kept, curve.end(), editing::end_of(curve, true), editing::end_of(curve, false));
}

#define TWEENFALL_EDITING(T)                                                \
  template Curve<T> trimmed<T>(const Curve<T>&, double, double);            \
  template std::pair<Curve<T>, Curve<T>> split<T>(const Curve<T>&, double); \
  template Curve<T> joined<T>(const Curve<T>&, const Curve<T>&);            \
  template Curve<T> with_knot<T>(const Curve<T>&, double);
TWEENFALL_EDITING(double)
TWEENFALL_EDITING(Vec2)
TWEENFALL_EDITING(Vec3)
TWEENFALL_EDITING(Vec4)
TWEENFALL_EDITING(Color)
TWEENFALL_EDITING(Quat)
#undef TWEENFALL_EDITING
template Curve<double> without_redundant_knots<double>(const Curve<double>&, double);
template Curve<Vec2> without_redundant_knots<Vec2>(const Curve<Vec2>&, double);
template Curve<Vec3> without_redundant_knots<Vec3>(const Curve<Vec3>&, double);
template Curve<Vec4> without_redundant_knots<Vec4>(const Curve<Vec4>&, double);
template Curve<Color> without_redundant_knots<Color>(const Curve<Color>&, double);

}  // namespace tweenfall
