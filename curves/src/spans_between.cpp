#include "spans_between.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "outside.h"
#include "span_part.h"

namespace tweenfall {
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
    if (span.form == RotationSpan::Form::normalized)
      for (int i = 0; i <= span.degree; ++i) {
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
  T first, last;  // values at the ends of the knots
  std::vector<SpanType> result;

  // One play of the knots, shown from start + k duration on.
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
      offset_span<T>(result.back(), first, last, offset);
    }
  }

  void add_outside(double from, double to, bool early) {
    const Outside rule = early ? curve.before() : curve.after();
    if (rule == Outside::hold || rule == Outside::linear || !(curve.duration() > 0)) {
      const double anchor = early ? curve.start() : curve.end();
      const Sample<T> end = early ? curve.sample(anchor, Side::in) : curve.sample(anchor, Side::out);
      result.push_back(straight_span<T>(end, anchor, rule == Outside::linear && curve.duration() > 0, from, to));
      return;
    }
    const double duration = curve.duration();
    const double begin = std::floor((from - curve.start()) / duration),
                 end = std::ceil((to - curve.start()) / duration);
    for (double k = begin; k < end; k += 1)
      add(k, rule == Outside::pingpong && std::fmod(k, 2) != 0, rule == Outside::repeat_offset ? k : 0, from, to);
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
  const auto loops = [](Outside rule) { return rule != Outside::hold && rule != Outside::linear; };
  const double beyond = (loops(curve.before()) ? std::max(0.0, curve.start() - from) : 0) +
                        (loops(curve.after()) ? std::max(0.0, to - curve.end()) : 0);
  if (curve.duration() > 0 && !(beyond <= most_plays * curve.duration()))
    throw std::invalid_argument("from " + text_of(from) + " s to " + text_of(to) +
                                " s the curve plays more than a million times; ask about less time");
}

}  // namespace

void check_times(double from, double to) {
  for (const double t : {from, to})
    if (!std::isfinite(t)) throw std::invalid_argument("the time " + text_of(t) + " s must be finite");
}

template <class T>
bool has_spans(const Curve<T>& curve) {
  return curve.start() == curve.end() || !curve.spans().empty();
}

template <class T>
std::vector<typename SpanOf<T>::type> spans_between(const Curve<T>& curve, double from, double to) {
  check_times(from, to);
  check_plays(curve, from, to);
  if (curve.start() == curve.end()) return {straight_span<T>(at_rest<T>(curve.value(from)), from, false, from, to)};
  const std::vector<typename SpanOf<T>::type> spans = curve.spans();
  Plays<T> plays{curve, spans, curve.value(curve.start(), Side::out), curve.value(curve.end(), Side::in), {}};
  if (from < curve.start()) plays.add_outside(from, std::min(to, curve.start()), true);
  plays.add(0, false, 0, from, to);
  if (to > curve.end()) plays.add_outside(std::max(from, curve.end()), to, false);
  std::erase_if(plays.result, [](const auto& span) { return !(span.duration > 0); });
  close_gaps(plays.result, from, to);
  return std::move(plays.result);
}

template <class T>
std::vector<double> seams_between(const Curve<T>& curve, double from, double to) {
  check_times(from, to);
  check_plays(curve, from, to);
  std::vector<double> result = {from};
  const auto add = [&](double time) {
    if (time > result.back() && time < to) result.push_back(time);
  };
  const std::span<const double> knots = curve.knots();
  const auto add_plays = [&](double low, double high, bool pingpong) {
    const double duration = curve.duration();
    for (double k = std::floor((low - curve.start()) / duration); k < std::ceil((high - curve.start()) / duration);
         k += 1) {
      const bool backward = pingpong && std::fmod(k, 2) != 0;
      const double seam = curve.start() + (k + 1) * duration;
      add(curve.start() + k * duration);
      for (std::size_t j = 0; j < knots.size(); ++j)
        add(backward ? seam - (knots[knots.size() - 1 - j] - knots[0]) : knots[j] + k * duration);
      add(seam);
    }
  };
  const auto loops = [&](Outside rule) {
    return rule != Outside::hold && rule != Outside::linear && std::isfinite(curve.duration()) && curve.duration() > 0;
  };
  if (from < curve.start() && loops(curve.before()))
    add_plays(from, std::min(to, curve.start()), curve.before() == Outside::pingpong);
  add(curve.start());
  for (const double knot : knots) add(knot);
  add(curve.end());
  if (to > curve.end() && loops(curve.after()))
    add_plays(std::max(from, curve.end()), to, curve.after() == Outside::pingpong);
  result.push_back(to);
  return result;
}

#define TWEENFALL_BETWEEN(T)                                                                        \
  template bool has_spans<T>(const Curve<T>&);                                                      \
  template std::vector<typename SpanOf<T>::type> spans_between<T>(const Curve<T>&, double, double); \
  template std::vector<double> seams_between<T>(const Curve<T>&, double, double);
TWEENFALL_BETWEEN(double)
TWEENFALL_BETWEEN(Vec2)
TWEENFALL_BETWEEN(Vec3)
TWEENFALL_BETWEEN(Vec4)
TWEENFALL_BETWEEN(Color)
TWEENFALL_BETWEEN(Quat)
#undef TWEENFALL_BETWEEN

}  // namespace tweenfall
