#include <tweenfall/curves/curve.h>

#include <limits>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/extrapolation.h"
#include "math/polynomial.h"
#include "rotation/rotation_span.h"

namespace tweenfall {
namespace {

[[noreturn]] void refuse(std::size_t index, double start, const std::string& what) {
  throw std::invalid_argument("span " + std::to_string(index) + " (at " + text_of(start) + " s) " + what);
}

// How many of the coefficients a span has.
template <class T>
int rows_of(const Span<T>& span) noexcept {
  return span.degree + 1;
}
int rows_of(const RotationSpan& span) noexcept {
  return span.form == RotationSpan::Form::nested ? rotation_rows : span.degree + 1;
}

template <class SpanType>
void check(std::span<const SpanType> spans) {
  if (spans.empty()) throw std::invalid_argument("a curve needs at least one span; none were given");
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SpanType& s = spans[i];
    if (!std::isfinite(s.start)) refuse(i, s.start, "must start at a finite time");
    if (!(s.duration > 0) || !std::isfinite(s.duration))
      refuse(i, s.start, "must have a finite duration > 0 s; it is " + text_of(s.duration));
    if (s.degree < 0 || s.degree > max_degree)
      refuse(i, s.start,
             "must have a degree from 0 to " + std::to_string(max_degree) + "; it is " + std::to_string(s.degree));
    for (int k = 0; k < rows_of(s); ++k)
      if (!all_finite(s.coefficients[static_cast<std::size_t>(k)]))
        refuse(i, s.start,
               "has a non-finite number in coefficient " + std::to_string(k) + ": " +
                   text_of(s.coefficients[static_cast<std::size_t>(k)]));
    if (!all_finite(s.end)) refuse(i, s.start, "has a non-finite end value " + text_of(s.end));
    if constexpr (std::is_same_v<SpanType, RotationSpan>)
      if (!all_finite(s.spin)) refuse(i, s.start, "has a non-finite spin " + text_of(s.spin));
    if (i == 0) continue;
    const double expected = spans[i - 1].start + spans[i - 1].duration;
    // Durations are differences of times, so the sum may be off by the rounding of both.
    const double slack = 4e-16 * (std::abs(s.start) + std::abs(spans[i - 1].start));
    if (!(s.start > spans[i - 1].start) || std::abs(s.start - expected) > slack)
      refuse(i, s.start, "must start where the one before ends, at " + text_of(expected) + " s");
  }
}

template <class T>
Sample<T> with_rates(const T& value, const T& first, const T& second, double inverse) noexcept {
  return {value, first * inverse, second * (inverse * inverse)};
}

// Derivatives in the polynomial's own variable, to derivatives in the position u of the span.
template <class V>
void through(const Warp::Result& w, Polynomial<V>& p) noexcept {
  p.second = p.second * (w.ds * w.ds) + p.first * w.dds;
  p.first = p.first * w.ds;
}

template <class Data>
Sample<Quat> sample_rotation(const Data& d, std::size_t i, const Warp::Result& w) noexcept {
  const Segment& s = d.segments[i];
  Sample<Quat> result;
  if (s.form == RotationSpan::Form::nested) {
    result = sample_nested(&d.pool[s.first], w);
  } else {
    Polynomial<Vec4> p = evaluate_polynomial(&d.pool[s.first], s.degree, w.s);
    if (s.warped) through(w, p);
    result =
        s.form == RotationSpan::Form::normalized ? sample_normalized(p, d.ends[i]) : sample_exponential(d.starts[i], p);
  }
  if (!d.spins.empty() && !d.spins[i].isZero(0)) result = spun(result, d.spins[i], w);
  result.rate *= s.inverse;
  result.acceleration *= s.inverse * s.inverse;
  return result;
}

template <class T, class Data>
Sample<T> sample_segment(const Data& d, std::size_t i, double u) noexcept {
  const Segment& s = d.segments[i];
  Warp::Result w{u, 1, 0};
  if (s.warped) w = d.warps[i].at(u);
  if constexpr (std::is_same_v<T, Quat>) {
    return sample_rotation(d, i, w);
  } else {
    Polynomial<typename Stored<T>::type> p = evaluate_polynomial(&d.pool[s.first], s.degree, w.s);
    if (s.warped) through(w, p);
    if constexpr (std::is_same_v<T, Color>) {
      const Sample<Vec4> v = with_rates(p.value, p.first, p.second, s.inverse);
      return {Color{v.value}, v.rate, v.acceleration};
    } else {
      return with_rates<T>(p.value, p.first, p.second, s.inverse);
    }
  }
}

// From the first knot to the last.
template <class T, class Data>
Sample<T> sample_inside(const Data& d, double time, Side side) noexcept {
  if (d.segments.empty()) return d.formula(time, side);
  std::size_t i = time < d.end ? d.locate(time) : d.segments.size();
  const bool at_knot = i == d.segments.size() || time == d.knots[i];
  if (at_knot && i > 0 && (side == Side::in || i == d.segments.size())) {
    Sample<T> arrival = sample_segment<T>(d, i - 1, 1);
    arrival.value = d.ends[i - 1];
    return arrival;
  }
  const Segment& s = d.segments[i];
  return sample_segment<T>(d, i, s.position(time));
}

// What arrives at the first knot, or leaves the last.
template <class T, class Data>
T end_value(const Data& d, bool early) noexcept {
  const std::optional<T>& own = early ? d.before.value : d.after.value;
  if (own) return *own;
  const double end = early ? d.start : d.end;
  if (d.rebuilt) return d.formula(end, early ? Side::in : Side::out).value;
  return sample_inside<T>(d, end, early ? Side::out : Side::in).value;
}

// Outside the knots, by rules that go on for ever.
template <class T, class Data>
Sample<T> sample_endless(const Data& d, double time, Side side) noexcept {
  const bool early = time < d.start || (time == d.start && side == Side::in);
  return sample_outside<T>((early ? d.before : d.after).rule.rule, d.start, d.end, time, side,
                           [&d](double t, Side s) { return sample_inside<T>(d, t, s); },
                           [&d](bool first) { return end_value<T>(d, first); });
}

}  // namespace

template <class T>
Curve<T> CurveAccess::from_spans(std::span<const typename SpanOf<T>::type> spans, double end, const CurveEnd<T>& before,
                                 const CurveEnd<T>& after) {
  check(spans);
  auto data = std::make_shared<typename Curve<T>::Data>();
  typename Curve<T>::Data& d = *data;
  d.start = spans.front().start;
  d.end = end;
  d.before = before;
  d.after = after;
  if (!std::isfinite(end - d.start))
    throw std::invalid_argument("a curve from " + text_of(d.start) + " s to " + text_of(end) + " s is too long");
  d.knots.reserve(spans.size() + 1);
  for (const auto& s : spans) d.knots.push_back(s.start);
  d.knots.push_back(end);
  for (const auto& s : spans)
    if (s.warp.function) {
      d.warps.resize(spans.size());
      break;
    }
  d.segments.reserve(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const auto& s = spans[i];
    const double duration = d.knots[i + 1] - d.knots[i];
    Segment segment{s.start,
                    duration,
                    1 / duration,
                    static_cast<std::uint32_t>(d.pool.size()),
                    static_cast<std::int16_t>(s.degree),
                    s.warp.function != nullptr,
                    RotationSpan::Form::exponential};
    for (int k = 0; k < rows_of(s); ++k) {
      const auto& c = s.coefficients[static_cast<std::size_t>(k)];
      if constexpr (std::is_same_v<T, Color>)
        d.pool.push_back(c.rgba);
      else
        d.pool.push_back(c);
    }
    if constexpr (std::is_same_v<T, Quat>) {
      segment.form = s.form;
      d.starts.push_back(s.from);
      if (!s.spin.isZero(0)) d.spins.resize(spans.size(), Vec3(0, 0, 0));
      if (!d.spins.empty()) d.spins[i] = s.spin;
    }
    d.ends.push_back(s.end);
    d.segments.push_back(segment);
    if (segment.warped) d.warps[i] = s.warp;
  }
  if (spans.size() > 1) {
    const std::size_t count = spans.size();
    d.bucket_scale = static_cast<double>(2 * count) / (d.end - d.start);
    d.buckets.assign(2 * count + 1, 0);
    for (std::size_t i = 0; i < count; ++i) ++d.buckets[d.bucket(d.knots[i]) + 1];
    for (std::size_t b = 1; b < d.buckets.size(); ++b) d.buckets[b] += d.buckets[b - 1];
  }
  return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
}

template <class T>
T CurveAccess::end_value(const Curve<T>& curve, bool early) noexcept {
  return tweenfall::end_value<T>(*curve.data_, early);
}

template <class T>
Curve<T>::Curve(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

template <class T>
Curve<T>::Curve(const T& value) {
  if (!all_finite(value)) throw std::invalid_argument("a constant must be finite; it is " + text_of(value));
  auto data = std::make_shared<Data>();
  data->formula = [value](double, Side) { return at_rest<T>(value); };
  data_ = std::move(data);
}

template <class T>
Curve<T>::Curve(std::span<const typename SpanOf<T>::type> spans)
    : data_(CurveAccess::from_spans<T>(spans, spans.empty() ? 0 : spans.back().start + spans.back().duration).data_) {}

template <class T>
Curve<T>::Curve(Formula formula, double start, double end) {
  if (!formula) throw std::invalid_argument("a curve needs a formula; an empty function was given");
  if (!(start <= end))
    throw std::invalid_argument("a formula's end, " + text_of(end) + " s, must not lie before its start, " +
                                text_of(start) + " s");
  auto data = std::make_shared<Data>();
  data->formula = std::move(formula);
  data->start = start;
  data->end = end;
  data_ = std::move(data);
}

template <class T>
Curve<T> Curve<T>::with_outside(Outside before, Outside after) const {
  return with_outside(OutsideRule<T>{before}, OutsideRule<T>{after});
}

template <class T>
Curve<T> Curve<T>::with_outside(const OutsideRule<T>& before, const OutsideRule<T>& after) const {
  for (const OutsideRule<T>* rule : {&before, &after}) {
    if (rule->slope && !all_finite(*rule->slope))
      throw std::invalid_argument("the slope outside a curve must be finite; it is " + text_of(*rule->slope));
    if (!(rule->plays >= 0) || !std::isfinite(rule->plays))
      throw std::invalid_argument("the plays outside a curve must be >= 0; they are " + text_of(rule->plays));
  }
  if (data_->rebuilt) return data_->rebuilt(before, after);
  auto data = std::make_shared<Data>(*data_);
  data->before.rule = before;
  data->after.rule = after;
  return Curve(std::shared_ptr<const Data>(std::move(data)));
}

template <class T>
double Curve<T>::start() const noexcept {
  return data_->start;
}

template <class T>
double Curve<T>::end() const noexcept {
  return data_->end;
}

template <class T>
Outside Curve<T>::before() const noexcept {
  return data_->before.rule.rule;
}

template <class T>
Outside Curve<T>::after() const noexcept {
  return data_->after.rule.rule;
}

template <class T>
const OutsideRule<T>& Curve<T>::rule_before() const noexcept {
  return data_->before.rule;
}

template <class T>
const OutsideRule<T>& Curve<T>::rule_after() const noexcept {
  return data_->after.rule;
}

template <class T>
std::span<const double> Curve<T>::knots() const noexcept {
  return data_->knots;
}

template <class T>
Sample<T> Curve<T>::sample(double time, Side side) const noexcept {
  const Data& d = *data_;
  if ((time > d.start || (time == d.start && side == Side::out)) &&
      (time < d.end || (time == d.end && side == Side::in)))
    return d.rebuilt ? d.formula(time, side) : sample_inside<T>(d, time, side);
  const bool early = time < d.start || (time == d.start && side == Side::in);
  const CurveEnd<T>& beyond = early ? d.before : d.after;
  if (const std::optional<Rate<T>>& slope = beyond.straight(); slope && beyond.rule.rule == Outside::linear)
    return straight_on(Sample<T>{end_value<T>(d, early), *slope, zero_rate<Rate<T>>()},
                       time - (early ? d.start : d.end));
  if (d.rebuilt) return d.formula(time, side);
  if (const std::optional<double> last = last_play(beyond.rule, d.start, d.end, early);
      last && is_beyond(time, side, *last, early))
    return at_rest<T>(sample_endless<T>(d, *last, early ? Side::out : Side::in).value);
  return sample_endless<T>(d, time, side);
}

template <class T>
T Curve<T>::value(double time, Side side) const noexcept {
  if constexpr (std::is_same_v<T, double>) {
    // The most frequent question of all, without the work for rates.
    const Data& d = *data_;
    if (time >= d.start && time < d.end && side == Side::out && d.warps.empty() && !d.segments.empty()) {
      const Segment& s = d.segments[d.locate(time)];
      return polynomial_value(&d.pool[s.first], s.degree, s.position(time));
    }
  }
  return sample(time, side).value;
}

template <class T>
std::vector<typename SpanOf<T>::type> Curve<T>::spans() const {
  const Data& d = *data_;
  std::vector<typename SpanOf<T>::type> result;
  result.reserve(d.segments.size());
  for (std::size_t i = 0; i < d.segments.size(); ++i) {
    const Segment& s = d.segments[i];
    typename SpanOf<T>::type span{};
    span.start = s.start;
    span.duration = s.duration;
    span.degree = s.degree;
    if constexpr (std::is_same_v<T, Quat>) {
      for (Vec4& c : span.coefficients) c.setZero();
      span.form = s.form;
      span.from = d.starts[i];
      if (!d.spins.empty()) span.spin = d.spins[i];
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(rows_of(span)); ++k) {
      if constexpr (std::is_same_v<T, Color>)
        span.coefficients[k].rgba = d.pool[s.first + k];
      else
        span.coefficients[k] = d.pool[s.first + k];
    }
    span.end = d.ends[i];
    if (s.warped) span.warp = d.warps[i];
    result.push_back(span);
  }
  return result;
}

#define TWEENFALL_CURVE(T)                                                                                            \
  template class Curve<T>;                                                                                            \
  template Curve<T> CurveAccess::from_spans<T>(std::span<const typename SpanOf<T>::type>, double, const CurveEnd<T>&, \
                                               const CurveEnd<T>&);                                                   \
  template T CurveAccess::end_value<T>(const Curve<T>&, bool) noexcept;
TWEENFALL_CURVE(double)
TWEENFALL_CURVE(Vec2)
TWEENFALL_CURVE(Vec3)
TWEENFALL_CURVE(Vec4)
TWEENFALL_CURVE(Color)
TWEENFALL_CURVE(Quat)
#undef TWEENFALL_CURVE

}  // namespace tweenfall
