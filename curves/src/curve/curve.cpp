#include <tweenfall/curves/curve.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/extrapolation.h"
#include "curve/given_spans.h"
#include "curve/time_bezier.h"
#include "math/polynomial.h"
#include "rotation/rotation_span.h"

namespace tweenfall::spans {
namespace {

template <class T>
Sample<T> with_rates(const T& value, const T& first, const T& second, double inverse) noexcept {
  return {value, first * inverse, second * (inverse * inverse)};
}

// From derivatives with respect to the polynomial's own variable to those with respect to the position u in the span.
template <class V>
void through(const Warp& warp, const Warp::Result& w, const V* c, int degree, math::Polynomial<V>& p) noexcept {
  if (w.ds * least_time_slope >= 0.999 * warp.width && limit_where_time_rests(warp, w.s, c, degree, p)) return;
  p.second = p.second * (w.ds * w.ds) + p.first * w.dds;
  p.first = p.first * w.ds;
}

// A turn from one rotation to the next, as made by keys alone. A linear one keeps its axis and its speed.
template <class Data>
Sample<Quat> sample_plain_turn(const Data& d, std::size_t i, const Segment& s, double u) noexcept {
  const Vec3* rows = d.turns.data() + s.first;
  if (s.degree == 1) return {d.starts[i] * exp_map(rows[0] * u), d.starts[i] * rows[0], Vec3::Zero()};
  Vec3 c[max_degree + 1];
  c[0].setZero();
  std::copy_n(rows, s.degree, c + 1);
  return rotations::sample_exponential(d.starts[i], math::evaluate_polynomial(c, s.degree, u));
}

template <class Data>
Sample<Quat> sample_rotation(const Data& d, std::size_t i, const Segment& s, const Warp::Result& w) noexcept {
  Sample<Quat> result;
  if (d.plain_turns) {
    result = sample_plain_turn(d, i, s, w.s);
  } else if (s.form == RotationSpan::Form::nested) {
    result = rotations::sample_nested(&d.pool[s.first], w);
  } else {
    math::Polynomial<Vec4> p = math::evaluate_polynomial(&d.pool[s.first], s.degree, w.s);
    if (s.warped) through(d.warps[i], w, &d.pool[s.first], s.degree, p);
    result =
        s.form == RotationSpan::Form::normalized
            ? rotations::sample_normalized(p, d.arrival(i))
            : rotations::sample_exponential(d.starts[i], {p.value.head<3>(), p.first.head<3>(), p.second.head<3>()});
  }
  if (!d.spins.empty() && !d.spins[i].isZero(0)) result = rotations::spun(result, d.spins[i], w);
  result.rate *= s.inverse;
  result.acceleration *= s.inverse * s.inverse;
  return result;
}

template <class T, class Data>
Sample<T> sample_segment(const Data& d, std::size_t i, const Segment& s, double u) noexcept {
  Warp::Result w{u, 1, 0};
  if (s.warped) w = d.warps[i].at(u);
  if constexpr (std::is_same_v<T, Quat>) {
    return sample_rotation(d, i, s, w);
  } else {
    std::array<typename Stored<T>::type, 4> room;
    const auto* c = d.coefficients(i, s.first, room);
    math::Polynomial<typename Stored<T>::type> p = math::evaluate_polynomial(c, s.degree, w.s);
    if (s.warped) through(d.warps[i], w, c, s.degree, p);
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
  const std::size_t count = d.span_count();
  if (count == 0) return d.formula(time, side);
  const std::size_t i = time < d.end ? d.times->locate(time) : count;
  const bool at_knot = i == count || time == d.times->knots()[i];
  if (at_knot && i > 0 && (side == Side::in || i == count)) {
    Sample<T> arrival = sample_segment<T>(d, i - 1, d.segment(i - 1), 1);
    arrival.value = d.arrival(i - 1);
    return arrival;
  }
  const Segment s = d.segment(i);
  return sample_segment<T>(d, i, s, s.position(time));
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
}  // namespace tweenfall::spans

namespace tweenfall {

template <class T>
Curve<T> CurveAccess::from_spans(std::span<const typename SpanOf<T>::type> spans, double end,
                                 const spans::CurveEnd<T>& before, const spans::CurveEnd<T>& after) {
  spans::check(spans);
  auto data = std::make_shared<typename Curve<T>::Data>();
  typename Curve<T>::Data& d = *data;
  d.start = spans.front().start;
  d.end = end;
  d.before = before;
  d.after = after;
  if (!std::isfinite(end - d.start))
    throw std::invalid_argument("a curve from " + spans::text_of(d.start) + " s to " + spans::text_of(end) +
                                " s is too long");
  std::vector<double> knots;
  knots.reserve(spans.size() + 1);
  for (const auto& s : spans) knots.push_back(s.start);
  knots.push_back(end);
  d.times = spans::shared_times(knots);
  if (std::any_of(spans.begin() + 1, spans.end(), [](const auto& s) { return !s.starts_at_key; })) {
    for (std::size_t i = 0; i < spans.size(); ++i)
      if (i == 0 || spans[i].starts_at_key) d.keys.push_back(knots[i]);
    d.keys.push_back(end);
  }

  const std::size_t count = spans.size();
  const auto has_warp = [](const auto& s) { return s.warp.function != nullptr; };
  if (std::ranges::any_of(spans, has_warp))
    for (const auto& s : spans) d.warps.push_back(s.warp);
  bool joined = spans::are_joined(spans);
  std::size_t unread = 0;  // coefficients that are known without being stored
  if constexpr (std::is_same_v<T, Quat>) {
    d.plain_turns = spans::are_plain_turns(spans);
    joined = joined && d.plain_turns;
    unread = d.plain_turns ? 1 : 0;
    d.starts.reserve(count);
    for (const RotationSpan& s : spans) d.starts.push_back(s.from);
    if (std::ranges::any_of(spans, [](const RotationSpan& s) { return !s.spin.isZero(0); }))
      for (const RotationSpan& s : spans) d.spins.push_back(s.spin);
  }

  std::size_t rows = 0;
  for (const auto& s : spans) rows += static_cast<std::size_t>(spans::rows_of(s)) - unread;
  d.rows = static_cast<std::uint32_t>(spans::rows_of(spans[0])) - static_cast<std::uint32_t>(unread);
  if (unread)
    d.turns.reserve(rows);
  else
    d.pool.reserve(rows);
  const bool alike = spans::are_alike(spans);
  d.kinds.reserve(alike ? 1 : count);
  d.ends.reserve(joined ? 1 : count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& s = spans[i];
    if (!alike || i == 0) {
      typename Curve<T>::Data::Kind kind{static_cast<std::uint32_t>(d.pool.size()), static_cast<std::int16_t>(s.degree),
                                         has_warp(s), RotationSpan::Form::exponential};
      if constexpr (std::is_same_v<T, Quat>) kind.form = s.form;
      d.kinds.push_back(kind);
    }
    for (std::size_t k = unread; k < static_cast<std::size_t>(spans::rows_of(s)); ++k) {
      const auto& c = s.coefficients[k];
      if constexpr (std::is_same_v<T, Color>)
        d.pool.push_back(c.rgba);
      else if constexpr (std::is_same_v<T, Quat>)
        d.plain_turns ? d.turns.push_back(c.template head<3>()) : d.pool.push_back(c);
      else
        d.pool.push_back(c);
    }
    if (!joined || i + 1 == count) d.ends.push_back(s.end);
  }
  return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
}

template <class T>
T CurveAccess::end_value(const Curve<T>& curve, bool early) noexcept {
  return spans::end_value<T>(*curve.data_, early);
}

template <class T>
Curve<T>::Curve(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

template <class T>
Curve<T>::Curve(const T& value) {
  if (!spans::all_finite(value))
    throw std::invalid_argument("a constant must be finite; it is " + spans::text_of(value));
  auto data = std::make_shared<Data>();
  data->formula = [value](double, Side) { return spans::at_rest<T>(value); };
  data_ = std::move(data);
}

template <class T>
Curve<T>::Curve(std::span<const typename SpanOf<T>::type> spans)
    : data_(CurveAccess::from_spans<T>(spans, spans.empty() ? 0 : spans.back().start + spans.back().duration).data_) {}

template <class T>
Curve<T>::Curve(Formula formula, double start, double end) {
  if (!formula) throw std::invalid_argument("a curve needs a formula; an empty function was given");
  if (!(start <= end))
    throw std::invalid_argument("a formula's end, " + spans::text_of(end) + " s, must not lie before its start, " +
                                spans::text_of(start) + " s");
  auto data = std::make_shared<Data>();
  data->formula = std::move(formula);
  data->start = start;
  data->end = end;
  data_ = std::move(data);
}

template <class T>
Curve<T>::Curve(Formula formula, std::vector<double> knots) {
  if (!formula) throw std::invalid_argument("a curve needs a formula; an empty function was given");
  if (knots.empty()) throw std::invalid_argument("a formula between knots needs one at least");
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (!std::isfinite(knots[i]) || (i > 0 && !(knots[i] > knots[i - 1])))
      throw std::invalid_argument("knots must be finite and increase; knot " + std::to_string(i) + " is " +
                                  spans::text_of(knots[i]) + " s");
  const auto rebuilt = [formula, knots](const OutsideRule<T>& before, const OutsideRule<T>& after) {
    return CurveAccess::formula_with_knots<T>(formula, knots.front(), knots.back(), {knots})
        .with_outside(before, after);
  };
  data_ = CurveAccess::seen_through<T>(formula, knots.front(), knots.back(), {knots}, {}, {}, rebuilt).data_;
}

template <class T>
Curve<T> Curve<T>::with_outside(Outside before, Outside after) const {
  return with_outside(OutsideRule<T>{before}, OutsideRule<T>{after});
}

template <class T>
Curve<T> Curve<T>::with_outside(const OutsideRule<T>& before, const OutsideRule<T>& after) const {
  for (const OutsideRule<T>* rule : {&before, &after}) {
    if (rule->slope && !spans::all_finite(*rule->slope))
      throw std::invalid_argument("the slope outside a curve must be finite; it is " + spans::text_of(*rule->slope));
    if (!(rule->plays >= 0) || !std::isfinite(rule->plays))
      throw std::invalid_argument("the plays outside a curve must be >= 0; they are " + spans::text_of(rule->plays));
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
  return data_->knots();
}

template <class T>
std::span<const double> Curve<T>::key_times() const noexcept {
  return data_->keys.empty() ? data_->knots() : data_->keys;
}

template <class T>
Sample<T> Curve<T>::sample(double time, Side side) const noexcept {
  const Data& d = *data_;
  if ((time > d.start || (time == d.start && side == Side::out)) &&
      (time < d.end || (time == d.end && side == Side::in)))
    return d.rebuilt ? d.formula(time, side) : spans::sample_inside<T>(d, time, side);
  const bool early = time < d.start || (time == d.start && side == Side::in);
  const spans::CurveEnd<T>& beyond = early ? d.before : d.after;
  if (const std::optional<Rate<T>>& slope = beyond.straight(); slope && beyond.rule.rule == Outside::linear)
    return spans::straight_on(Sample<T>{spans::end_value<T>(d, early), *slope, spans::zero_rate<Rate<T>>()},
                              time - (early ? d.start : d.end));
  if (d.rebuilt) return d.formula(time, side);
  if (const std::optional<double> last = spans::last_play(beyond.rule, d.start, d.end, early);
      last && spans::is_beyond(time, side, *last, early))
    return spans::at_rest<T>(spans::sample_endless<T>(d, *last, early ? Side::out : Side::in).value);
  return spans::sample_endless<T>(d, time, side);
}

template <class T>
T Curve<T>::value(double time, Side side) const noexcept {
  if constexpr (std::is_same_v<T, double>) {
    // The most frequent query of all, without the work for rates.
    const Data& d = *data_;
    if (time >= d.start && time < d.end && side == Side::out && d.warps.empty() && d.times) {
      const spans::Segment s = d.segment(d.times->locate(time));
      return math::polynomial_value(&d.pool[s.first], s.degree, s.position(time));
    }
  }
  return sample(time, side).value;
}

template <class T>
std::vector<typename SpanOf<T>::type> Curve<T>::spans() const {
  const Data& d = *data_;
  std::vector<typename SpanOf<T>::type> result;
  result.reserve(d.span_count());
  auto key = d.keys.begin();
  for (std::size_t i = 0; i < d.span_count(); ++i) {
    const spans::Segment s = d.segment(i);
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
    const auto rows = static_cast<std::size_t>(spans::rows_of(span));
    if constexpr (std::is_same_v<T, Quat>) {
      for (std::size_t k = d.plain_turns ? 1 : 0; k < rows; ++k) {
        if (d.plain_turns)
          span.coefficients[k].template head<3>() = d.turns[s.first + k - 1];
        else
          span.coefficients[k] = d.pool[s.first + k];
      }
    } else {
      std::array<typename Data::Row, 4> room;
      const typename Data::Row* c = d.coefficients(i, s.first, room);
      for (std::size_t k = 0; k < rows; ++k) span.coefficients[k] = T{c[k]};
    }
    span.end = d.arrival(i);
    if (s.warped) span.warp = d.warps[i];
    if (!d.keys.empty()) {
      span.starts_at_key = *key == s.start;
      if (span.starts_at_key) ++key;
    }
    result.push_back(span);
  }
  return result;
}

#define TWEENFALL_CURVE(T)                                                                            \
  template class Curve<T>;                                                                            \
  template Curve<T> CurveAccess::from_spans<T>(std::span<const typename SpanOf<T>::type>, double,     \
                                               const spans::CurveEnd<T>&, const spans::CurveEnd<T>&); \
  template T CurveAccess::end_value<T>(const Curve<T>&, bool) noexcept;
TWEENFALL_CURVE(double)
TWEENFALL_CURVE(Vec2)
TWEENFALL_CURVE(Vec3)
TWEENFALL_CURVE(Vec4)
TWEENFALL_CURVE(Color)
TWEENFALL_CURVE(Quat)
#undef TWEENFALL_CURVE

}  // namespace tweenfall
