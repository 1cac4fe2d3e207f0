#include <tweenfall/curves/splines.h>

#include "curve/curve_data.h"
#include "curve/hermite_coefficients.h"
#include "eases/ease_form.h"
#include "keys/span_slopes.h"
#include "slopes/c2_rows.h"
#include "splines/spline_check.h"

namespace tweenfall::splines {
namespace {

template <class T>
void check_data(std::span<const double> times, std::span<const T> values, const SplineEnds<T>& ends) {
  check_spline_times(times);
  check_spline_list(values, times.size() - (ends.closed ? 1 : 0), "value");
  for (const SplineEnd<T>* end : {&ends.start, &ends.end}) {
    if (!spans::all_finite(end->given))
      refuse_spline("has the non-finite number " + spans::text_of(end->given) + " at an end");
    if (ends.closed && end->kind != SplineEnd<T>::Kind::automatic)
      refuse_spline("that is closed cannot have ends given");
  }
}

// Spans between the values, and the slopes at both ends of each, to be chosen.
template <class T>
struct Interpolation {
  std::span<const double> times;
  std::span<const T> values;
  std::vector<double> durations, secants;
  keying::Slopes slopes;

  Interpolation(std::span<const double> given_times, std::span<const T> given_values)
      : times(given_times), values(given_values) {
    durations.reserve(times.size() - 1);
    secants.reserve(durations.capacity() * static_cast<std::size_t>(spans::dimensions<T>));
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      durations.push_back(times[i + 1] - times[i]);
      for (int c = 0; c < spans::dimensions<T>; ++c)
        secants.push_back((spans::component(value(i + 1), c) - spans::component(value(i), c)) / durations[i]);
    }
  }

  [[nodiscard]] const T& value(std::size_t i) const noexcept { return values[i < values.size() ? i : 0]; }

  [[nodiscard]] T slope(const std::vector<double>& of, std::size_t span) const noexcept {
    T result = zero<T>();
    for (int c = 0; c < spans::dimensions<T>; ++c)
      spans::component_of(result, c) =
          of[span * static_cast<std::size_t>(spans::dimensions<T>) + static_cast<std::size_t>(c)];
    return result;
  }

  [[nodiscard]] Curve<T> curve() const {
    std::vector<Span<T>> spans(durations.size());
    for (std::size_t i = 0; i < spans.size(); ++i) {
      Span<T>& span = spans[i];
      span.start = times[i];
      span.duration = durations[i];
      span.degree = 3;
      span.end = value(i + 1);
      const T change = span.end - value(i);
      const T d0 = durations[i] * slope(slopes.leaving, i), d1 = durations[i] * slope(slopes.arriving, i);
      spans::cubic_coefficients(value(i), change, d0, d1, span.coefficients.data());
    }
    return CurveAccess::from_spans<T>(spans, times.back());
  }
};

template <class T>
slopes::C2End c2_end(const SplineEnd<T>& end) {
  using Kind = typename SplineEnd<T>::Kind;
  slopes::C2End result{end.kind == Kind::rate         ? slopes::C2End::Kind::slope
                       : end.kind == Kind::not_a_knot ? slopes::C2End::Kind::not_a_knot
                                                      : slopes::C2End::Kind::second};
  if (end.kind == Kind::rate || end.kind == Kind::acceleration)
    for (int c = 0; c < spans::dimensions<T>; ++c) result.given.push_back(spans::component(end.given, c));
  return result;
}

// Replaces the ends that the rule chose by the given ones, one component at a time.
template <class T>
void state_ends(Interpolation<T>& frame, const SplineEnds<T>& ends) {
  using Kind = typename SplineEnd<T>::Kind;
  const std::size_t d = static_cast<std::size_t>(spans::dimensions<T>), spans = frame.durations.size();
  const Kind first = ends.start.kind, last = ends.end.kind;
  for (std::size_t c = 0; c < d; ++c) {
    const double start = spans::component(ends.start.given, static_cast<int>(c));
    const double end = spans::component(ends.end.given, static_cast<int>(c));
    const std::size_t at = (spans - 1) * d + c;
    const double h0 = frame.durations[0], h1 = frame.durations[spans - 1];
    const double d0 = frame.secants[c], d1 = frame.secants[at];
    double &leaving = frame.slopes.leaving[c], &arriving = frame.slopes.arriving[at];
    if (first == Kind::rate) leaving = start;
    if (last == Kind::rate) arriving = end;
    if (spans == 1 && first == Kind::acceleration && last == Kind::acceleration) {
      leaving = d0 - h0 * (start / 3 + end / 6);
      arriving = d0 + h0 * (start / 6 + end / 3);
      continue;
    }
    if (first == Kind::acceleration) leaving = 0.5 * (3 * d0 - frame.slopes.arriving[c]) - 0.25 * h0 * start;
    if (last == Kind::acceleration) arriving = 0.5 * (3 * d1 - frame.slopes.leaving[at]) + 0.25 * h1 * end;
  }
}

}  // namespace
}  // namespace tweenfall::splines

namespace tweenfall {

template <class T>
Curve<T> c2_spline(std::span<const double> times, std::span<const T> values, const SplineEnds<T>& ends) {
  splines::check_data(times, values, ends);
  const slopes::C2End start = splines::c2_end(ends.start), end = splines::c2_end(ends.end);
  if (!ends.closed)
    if (std::optional<Curve<T>> curve = CurveAccess::cubics_through<T>(
            times, values, slopes::c2_slopes(slopes::ValueRun<T>{times, values}, start, end)))
      return *std::move(curve);
  splines::Interpolation<T> frame(times, values);
  const std::size_t spans = frame.durations.size(), d = static_cast<std::size_t>(spans::dimensions<T>);
  frame.slopes.leaving.resize(spans * d);
  frame.slopes.arriving.resize(spans * d);
  const SlopeProblem problem{spans,
                             0,
                             spans,
                             d,
                             frame.durations.data(),
                             frame.secants.data(),
                             Ends::secant,
                             nullptr,
                             frame.slopes.leaving.data(),
                             frame.slopes.arriving.data()};
  ends.closed ? slopes::solve_c2_periodic(problem) : slopes::solve_c2(problem, start, end);
  return frame.curve();
}

template <class T>
Curve<T> cubic_spline(std::span<const double> times, std::span<const T> values, std::span<const Ease> rules,
                      const SplineEnds<T>& ends) {
  splines::check_data(times, values, ends);
  splines::Interpolation<T> frame(times, values);
  if (rules.size() != 1 && rules.size() != values.size())
    splines::refuse_spline("needs one rule, or " + std::to_string(values.size()) + "; " + std::to_string(rules.size()) +
                           " were given");
  const bool stated =
      ends.start.kind != SplineEnd<T>::Kind::automatic || ends.end.kind != SplineEnd<T>::Kind::automatic;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (!rules[i].slope_rule())
      splines::refuse_spline("needs rules that choose slopes; number " + std::to_string(i) + " is \"" +
                             rules[i].name() + "\"");
    if (stated && rules[i].form().continuous_acceleration)
      splines::refuse_spline("by the rule \"" + rules[i].name() +
                             "\" depends on its ends everywhere, so they are given to c2_spline instead");
  }
  for (const SplineEnd<T>* end : {&ends.start, &ends.end})
    if (end->kind == SplineEnd<T>::Kind::not_a_knot)
      splines::refuse_spline("whose slopes a rule chooses cannot have a not-a-knot end; c2_spline can");
  const std::size_t spans = frame.durations.size();
  keying::SlopeRequest request{static_cast<std::size_t>(spans::dimensions<T>),
                               frame.durations,
                               frame.secants,
                               ends.closed ? Ends::wrap : Ends::secant,
                               {},
                               {}};
  for (std::size_t i = 0; i <= spans; ++i)
    request.eases.push_back(&rules[rules.size() == 1 || i >= rules.size() ? 0 : i]);
  request.span_eases.assign(request.eases.begin(), request.eases.end() - 1);
  frame.slopes = keying::choose_slopes(request);
  splines::state_ends(frame, ends);
  return frame.curve();
}

#define TWEENFALL_SPLINE(T)                                                                             \
  template Curve<T> c2_spline<T>(std::span<const double>, std::span<const T>, const SplineEnds<T>&);    \
  template Curve<T> cubic_spline<T>(std::span<const double>, std::span<const T>, std::span<const Ease>, \
                                    const SplineEnds<T>&);
TWEENFALL_SPLINE(double)
TWEENFALL_SPLINE(Vec2)
TWEENFALL_SPLINE(Vec3)
TWEENFALL_SPLINE(Vec4)
#undef TWEENFALL_SPLINE

}  // namespace tweenfall
