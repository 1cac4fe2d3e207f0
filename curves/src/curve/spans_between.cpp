#include "curve/spans_between.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/extrapolation.h"
#include "curve/span_part.h"

namespace tweenfall::spans {
namespace {

constexpr double most_plays = 1e6;

template <class T>
T turned_part(const Quat& turn, const T& part) noexcept {
  const Quat q = turn * Quat(part[3], part[0], part[1], part[2]);
  return T(q.x(), q.y(), q.z(), q.w());
}

template <class T>
void offset_span(typename SpanOf<T>::type& span, const T& start, const T& end, double plays) noexcept {
  if (plays == 0) return;
  if constexpr (std::is_same_v<T, Quat>) {
    const Quat turn = exp_map(plays * log_map(end * start.conjugate()));
    span.from = turn * span.from;
    span.end = turn * span.end;
    span.spin = turn * span.spin;
    // The number of rows that are rotations, or whose sum is one.
    const int rotations = span.form == RotationSpan::Form::normalized ? span.degree + 1
                          : span.form == RotationSpan::Form::nested   ? 3
                                                                      : 0;
    for (int i = 0; i < rotations; ++i) {
      Vec4& c = span.coefficients[static_cast<std::size_t>(i)];
      c = turned_part(turn, c);
    }
  } else if constexpr (std::is_same_v<T, Color>) {
    const Vec4 offset = plays * (end.rgba - start.rgba);
    span.coefficients[0].rgba += offset;
    span.end.rgba += offset;
  } else {
    const T offset = plays * (end - start);
    span.coefficients[0] += offset;
    span.end += offset;
  }
}

template <class T>
typename SpanOf<T>::type straight_span(const Sample<T>& end, double anchor, bool moving, double from, double to) {
  typename SpanOf<T>::type span{};
  span.start = from;
  span.duration = to - from;
  const T first = moving ? straight_on(end, from - anchor).value : end.value;
  span.end = moving ? straight_on(end, to - anchor).value : end.value;
  span.degree = moving ? 1 : 0;
  if constexpr (std::is_same_v<T, Quat>) {
    span.from = first;
    for (Vec4& c : span.coefficients) c.setZero();
    if (moving) span.coefficients[1].template head<3>() = first.conjugate() * Vec3((to - from) * end.rate);
  } else {
    span.coefficients[0] = first;
    if (moving) {
      if constexpr (std::is_same_v<T, Color>)
        span.coefficients[1].rgba = (to - from) * end.rate;
      else
        span.coefficients[1] = (to - from) * end.rate;
    }
  }
  return span;
}

template <class T>
struct Plays {
  using SpanType = typename SpanOf<T>::type;
  const Curve<T>& curve;
  const std::vector<SpanType>& spans;
  T first, last;  // values between which offsets climb
  std::vector<SpanType> result;

  // One play of the knots, which begins at start + k duration.
  void add(double k, bool backward, double offset, double from, double to) {
    const std::span<const double> knots = curve.knots();
    const double shift = k * curve.duration(), seam = curve.start() + (k + 1) * curve.duration();
    const std::size_t n = spans.size();
    const auto boundary = [&](std::size_t j) {
      if (k == 0 && !backward) return knots[j];
      if (j == n) return seam;
      return backward ? seam - (knots[n - j] - knots[0]) : knots[j] + shift;
    };
    for (std::size_t j = 0; j < n; ++j) {
      const double a = boundary(j), b = boundary(j + 1);
      const double low = std::max(a, from), high = std::min(b, to);
      if (!(high > low)) continue;
      double u0 = low == a ? 0 : (low - a) / (b - a), u1 = high == b ? 1 : (high - a) / (b - a);
      if (backward) {
        u0 = 1 - u0;
        u1 = 1 - u1;
      }
      result.push_back(span_part(spans[backward ? n - 1 - j : j], u0, u1, low, high));
      if (backward) result.back().starts_at_key = j == 0 || spans[n - j].starts_at_key;
      offset_span<T>(result.back(), first, last, offset);
    }
  }

  void add_outside(double from, double to, bool early) {
    const OutsideRule<T>& rule = early ? curve.rule_before() : curve.rule_after();
    const double anchor = early ? curve.start() : curve.end();
    if (!loops(rule.rule) || !(curve.duration() > 0)) {
      const Sample<T> end = curve.sample(anchor, early ? Side::in : Side::out);
      result.push_back(straight_span<T>(end, anchor, rule.rule == Outside::linear, from, to));
      return;
    }
    const double over = last_play(rule, curve.start(), curve.end(), early).value_or(early ? from : to);
    const auto rest = [&](double low, double high) {
      if (!(low < high)) return;
      const Sample<T> end = curve.sample(over, early ? Side::in : Side::out);
      result.push_back(straight_span<T>(end, over, false, low, high));
    };
    if (early) rest(from, std::min(to, over));
    add_plays(rule.rule, early ? std::max(from, over) : from, early ? to : std::min(to, over));
    if (!early) rest(std::max(from, over), to);
  }

  void add_plays(Outside rule, double from, double to) {
    const double duration = curve.duration();
    const double begin = std::floor((from - curve.start()) / duration),
                 end = std::ceil((to - curve.start()) / duration);
    for (double k = begin; k < end; k += 1)
      add(k, is_backward(rule, k), rule == Outside::repeat_offset ? k : 0, from, to);
  }
};

// Rounding may leave a seam a few bits from its neighbor: each span ends where the next one starts.
template <class SpanType>
void close_gaps(std::vector<SpanType>& spans, double from, double to) {
  spans.front().start = from;
  for (std::size_t i = 0; i < spans.size(); ++i)
    spans[i].duration = (i + 1 < spans.size() ? spans[i + 1].start : to) - spans[i].start;
}

template <class T>
void check_plays(const Curve<T>& curve, double from, double to) {
  const auto seconds_played = [&curve](const OutsideRule<T>& rule, double beyond) {
    if (!loops(rule.rule) || !(beyond > 0)) return 0.0;
    return rule.plays > 0 ? std::min(beyond, rule.plays * curve.duration()) : beyond;
  };
  const double played =
      seconds_played(curve.rule_before(), curve.start() - from) + seconds_played(curve.rule_after(), to - curve.end());
  if (curve.duration() > 0 && !(played <= most_plays * curve.duration()))
    throw std::invalid_argument("from " + text_of(from) + " s to " + text_of(to) +
                                " s the curve plays more than a million times; ask about less time");
}

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall {

void spans::check_times(double from, double to) {
  for (const double t : {from, to})
    if (!std::isfinite(t)) throw std::invalid_argument("the time " + spans::text_of(t) + " s must be finite");
}

template <class T>
bool spans::has_spans(const Curve<T>& curve) {
  const auto& data = CurveAccess::data(curve);
  return data.times || (curve.start() == curve.end() && !data.rebuilt);
}

template <class T>
std::vector<typename SpanOf<T>::type> spans::spans_between(const Curve<T>& curve, double from, double to) {
  spans::check_times(from, to);
  spans::check_plays(curve, from, to);
  const std::vector<typename SpanOf<T>::type> spans = curve.spans();
  spans::Plays<T> plays{curve, spans, CurveAccess::end_value(curve, true), CurveAccess::end_value(curve, false), {}};
  if (from < curve.start()) plays.add_outside(from, std::min(to, curve.start()), true);
  if (!spans.empty()) plays.add(0, false, 0, from, to);
  if (to > curve.end()) plays.add_outside(std::max(from, curve.end()), to, false);
  std::erase_if(plays.result, [](const auto& span) { return !(span.duration > 0); });
  spans::close_gaps(plays.result, from, to);
  return std::move(plays.result);
}

template <class T>
std::vector<double> spans::seams_between(const Curve<T>& curve, double from, double to) {
  spans::check_times(from, to);
  spans::check_plays(curve, from, to);
  std::vector<double> result = {from};
  const auto add = [&](double time) {
    if (time > result.back() && time < to) result.push_back(time);
  };
  const std::span<const double> knots = curve.knots();
  const double duration = curve.duration();
  const auto add_plays = [&](const OutsideRule<T>& rule, double low, double high, bool early) {
    if (!(low < high) || !spans::loops(rule.rule) || !std::isfinite(duration) || !(duration > 0)) return;
    const std::optional<double> over = spans::last_play(rule, curve.start(), curve.end(), early);
    if (over) (early ? low : high) = early ? std::max(low, *over) : std::min(high, *over);
    if (over && early) add(*over);
    for (double k = std::floor((low - curve.start()) / duration); k < std::ceil((high - curve.start()) / duration);
         k += 1) {
      const bool backward = spans::is_backward(rule.rule, k);
      const double seam = curve.start() + (k + 1) * duration;
      const auto add_played = [&](double time) {
        if (time < high) add(time);
      };
      add_played(curve.start() + k * duration);
      for (std::size_t j = 0; j < knots.size(); ++j)
        add_played(backward ? seam - (knots[knots.size() - 1 - j] - knots[0]) : knots[j] + k * duration);
      add_played(seam);
    }
    add(high);
  };
  add_plays(curve.rule_before(), from, std::min(to, curve.start()), true);
  add(curve.start());
  for (const double knot : knots) add(knot);
  add(curve.end());
  add_plays(curve.rule_after(), std::max(from, curve.end()), to, false);
  result.push_back(to);
  return result;
}

#define TWEENFALL_BETWEEN(T)                                                                               \
  template bool spans::has_spans<T>(const Curve<T>&);                                                      \
  template std::vector<typename SpanOf<T>::type> spans::spans_between<T>(const Curve<T>&, double, double); \
  template std::vector<double> spans::seams_between<T>(const Curve<T>&, double, double);
TWEENFALL_BETWEEN(double)
TWEENFALL_BETWEEN(Vec2)
TWEENFALL_BETWEEN(Vec3)
TWEENFALL_BETWEEN(Vec4)
TWEENFALL_BETWEEN(Color)
TWEENFALL_BETWEEN(Quat)
#undef TWEENFALL_BETWEEN

}  // namespace tweenfall
