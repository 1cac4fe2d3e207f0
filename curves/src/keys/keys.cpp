#include <tweenfall/curves/keys.h>

#include "curve/bezier_span.h"
#include "curve/curve_data.h"
#include "curve/hermite_coefficients.h"
#include "eases/ease_form.h"
#include "keys/key_check.h"
#include "keys/key_tangents.h"
#include "keys/keys_converted.h"
#include "keys/span_slopes.h"
#include "slopes/c2_rows.h"

namespace tweenfall::keying {
namespace {

template <class T>
const T& arrival(const Key<T>& key) {
  return key.value_in ? *key.value_in : key.value;
}

/// What keys ask for, read in one pass: they are large, and most of the time is spent waiting for them.
template <class T>
struct Gathered {
  SlopeRequest request;
  std::vector<double> times;
  std::vector<T> values;
  bool bare = true;  ///< whether all spans are cubics by eases alone, without tangents or arriving values
};

template <class T>
Gathered<T> gathered(std::span<const Key<T>> keys, Ends ends) {
  constexpr std::size_t n = spans::dimensions<T>;
  Gathered<T> all{{n, {}, {}, ends, {}, {}}, {}, {}};
  SlopeRequest& request = all.request;
  const std::size_t count = keys.size() - 1;
  request.eases.reserve(keys.size());
  all.times.reserve(keys.size());
  all.values.reserve(keys.size());
  request.durations.reserve(count);
  request.secants.reserve(count * n);
  request.span_eases.reserve(count);
  const Ease* ease = nullptr;  // the first of those alike that follow each other
  SpanPlan plan{};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Key<T>& key = keys[i];
    request.eases.push_back(&key.ease);
    all.times.push_back(key.time);
    all.values.push_back(key.value);
    all.bare = all.bare && !key.in && !key.out && !key.value_in;
    if (i + 1 == keys.size()) break;
    const Key<T>& next = keys[i + 1];
    const double duration = next.time - key.time;
    request.durations.push_back(duration);
    for (int c = 0; c < spans::dimensions<T>; ++c)
      request.secants.push_back((spans::component(arrival(next), c) - spans::component(key.value, c)) / duration);
    if (!ease || &key.ease.form() != &ease->form()) {
      ease = &key.ease;
      plan = plan_span(*ease, false);
    }
    const bool stated = key.out || next.in;
    request.span_eases.push_back(stated ? plan_span(key.ease, true).slopes : plan.slopes);
    all.bare = all.bare && plan.kind == SpanKind::cubic;
  }
  return all;
}

template <class T>
void append_shape(std::vector<Span<T>>& spans, const Key<T>& from, double end, const T& to) {
  const double duration = end - from.time;
  const std::vector<Ease::Piece> pieces = from.ease.pieces_for(duration);
  const T change = to - from.value;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ease::Piece& piece = pieces[i];
    Span<T> span{};
    span.start = i == 0 ? from.time : from.time + piece.start * duration;
    span.duration = (i + 1 < pieces.size() ? from.time + pieces[i + 1].start * duration : end) - span.start;
    if (!(span.duration > 0)) continue;
    span.degree = piece.degree;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(piece.degree); ++k)
      span.coefficients[k] = piece.coefficients[k] * change;
    span.coefficients[0] += from.value;
    span.end = piece.end == 1 ? to : T(from.value + piece.end * change);
    span.warp = piece.warp;
    span.starts_at_key = span.start == from.time;
    spans.push_back(span);
  }
}

template <class T>
Span<T> cubic(const Key<T>& from, const Key<T>& to, const KeyTangents<T>& tangents, std::size_t i, Overlong overlong) {
  Span<T> span{};
  span.start = from.time;
  span.duration = to.time - from.time;
  span.degree = 3;
  span.end = arrival(to);
  const T change = span.end - from.value;
  const T d0 = span.duration * tangents.leaving(i), d1 = span.duration * tangents.arriving(i);
  const HandleWidths w = tangents.widths(i);
  constexpr double third = 1.0 / 3;
  if (w.start == third && w.end == third)
    spans::cubic_coefficients(from.value, change, d0, d1, span.coefficients.data());
  else
    spans::fill_bezier(span, from.value, change, T(w.start * d0), T(w.end * d1), w, overlong);
  return span;
}

// The rates at the keys where each has a single one and all spans between them are plain cubics; else empty.
template <class T>
std::vector<double> shared_rates(std::span<const Key<T>> keys, const KeyTangents<T>& tangents) {
  constexpr double third = 1.0 / 3;
  std::vector<double> rates;
  const auto add = [&rates](const T& rate) {
    for (int c = 0; c < spans::dimensions<T>; ++c) rates.push_back(spans::component(rate, c));
  };
  T arriving = zero<T>();
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const Key<T>&a = keys[i], &b = keys[i + 1];
    const bool stated = a.out || b.in;
    if (plan_span(a.ease, stated).kind != SpanKind::cubic || (b.value_in && !(*b.value_in == b.value))) return {};
    if (stated) {
      const HandleWidths w = tangents.widths(i);
      if (w.start != third || w.end != third) return {};
    }
    const T leaving = tangents.leaving(i);
    if (i == 0)
      rates.reserve(keys.size() * static_cast<std::size_t>(spans::dimensions<T>));
    else if (!(leaving == arriving))
      return {};
    add(leaving);
    arriving = tangents.arriving(i);
  }
  add(arriving);
  return rates;
}

// The same where the keys state nothing but eases.
std::vector<double> shared_rates(const Slopes& slopes, std::size_t dimensions) {
  const std::size_t last = slopes.leaving.size() - dimensions;
  for (std::size_t i = 0; i < last; ++i)
    if (!(slopes.leaving[i + dimensions] == slopes.arriving[i])) return {};
  std::vector<double> rates;
  rates.reserve(last + 2 * dimensions);
  rates.insert(rates.end(), slopes.leaving.begin(), slopes.leaving.end());
  rates.insert(rates.end(), slopes.arriving.begin() + static_cast<std::ptrdiff_t>(last), slopes.arriving.end());
  return rates;
}

// The curve, if all its spans are cubics through its keys.
template <class T>
std::optional<Curve<T>> cubics_through_keys(std::span<const Key<T>> keys, const Gathered<T>& all, const Slopes& slopes,
                                            const KeyTangents<T>& tangents) {
  const std::vector<double> rates =
      all.bare ? shared_rates(slopes, all.request.dimensions) : shared_rates(keys, tangents);
  if (rates.empty()) return std::nullopt;
  return CurveAccess::cubics_through<T>(all.times, all.values, rates, {{}, all.values.front(), tangents.before()},
                                        {{}, all.values.back(), tangents.after()});
}

// The curve, if the keys are sound and state nothing but one and the same ease that makes a C2 spline: they are large,
// and for very many of them reading them once takes less time than the rest.
template <class T>
std::optional<Curve<T>> one_c2_spline(std::span<const Key<T>> keys, const KeyOptions& options) {
  if (keys.size() < 2 || options.ends != Ends::secant) return std::nullopt;
  const Ease::Form& form = keys[0].ease.form();
  if (!form.c2_ends) return std::nullopt;
  std::vector<double> times(keys.size());
  std::vector<T> values(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Key<T>& key = keys[i];
    const bool alike = i + 1 == keys.size() || &key.ease.form() == &form;
    if (!alike || key.in || key.out || key.value_in || !spans::all_finite(key.value)) return std::nullopt;
    if (!std::isfinite(key.time) || (i > 0 && !(key.time > times[i - 1]))) return std::nullopt;
    times[i] = key.time;
    values[i] = key.value;
  }
  const auto end = [&](double given) {
    return slopes::C2End{*form.c2_ends, std::vector<double>(spans::dimensions<T>, given)};
  };
  return CurveAccess::cubics_through<T>(
      times, values,
      slopes::c2_slopes(slopes::ValueRun<T>{times, values}, end(form.parameters[0]), end(form.parameters[1])),
      {{}, values.front(), {}}, {{}, values.back(), {}});
}

// Numbers and vectors, in their own units.
template <class T>
Curve<T> plain_curve(std::span<const Key<T>> keys, const KeyOptions& options) {
  if (keys.size() == 1) return CurveAccess::one_key(keys[0].value, keys[0].time);
  const Gathered<T> all = gathered(keys, options.ends);
  const Slopes slopes = choose_slopes(all.request);
  const KeyTangents<T> tangents(keys, all.request, slopes);
  if (std::optional<Curve<T>> curve = cubics_through_keys(keys, all, slopes, tangents)) return *std::move(curve);
  std::vector<Span<T>> spans;
  spans.reserve(keys.size() - 1);
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const Key<T>&a = keys[i], &b = keys[i + 1];
    const SpanKind kind = plan_span(a.ease, a.out || b.in).kind;
    if (kind != SpanKind::hold && !spans::all_finite(T(arrival(b) - a.value)))
      refuse_key(
          keys, i + 1,
          "is too far from the key before it, at " + spans::text_of(a.value) + ", for a number to hold the difference");
    if (kind == SpanKind::shape) {
      append_shape(spans, a, b.time, arrival(b));
    } else if (kind == SpanKind::cubic) {
      spans.push_back(cubic(a, b, tangents, i, options.overlong));
    } else {
      Span<T> span{};
      span.start = a.time;
      span.duration = b.time - a.time;
      span.coefficients[0] = span.end = a.value;
      if (kind == SpanKind::linear) {
        span.degree = 1;
        span.end = arrival(b);
        span.coefficients[1] = span.end - a.value;
      }
      spans.push_back(span);
    }
  }
  return CurveAccess::from_spans<T>(spans, keys.back().time, {{}, keys.front().value, tangents.before()},
                                    {{}, keys.back().value, tangents.after()});
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

template <class T>
Curve<T> keyed_curve(std::span<const Key<T>> keys, const KeyOptions& options) {
  if constexpr (std::is_same_v<T, Quat>) {
    keying::check_keys(keys);
    return keying::rotation_curve(keys, options);
  } else if constexpr (std::is_same_v<T, Color>) {
    keying::check_keys(keys);
    return keying::color_curve(keys, options);
  } else {
    if (!options.logarithmic)
      if (std::optional<Curve<T>> curve = keying::one_c2_spline(keys, options)) return *std::move(curve);
    keying::check_keys(keys);
    return options.logarithmic ? keying::logarithmic_curve(keys, options) : keying::plain_curve(keys, options);
  }
}

template Curve<double> keyed_curve<double>(std::span<const Key<double>>, const KeyOptions&);
template Curve<Vec2> keyed_curve<Vec2>(std::span<const Key<Vec2>>, const KeyOptions&);
template Curve<Vec3> keyed_curve<Vec3>(std::span<const Key<Vec3>>, const KeyOptions&);
template Curve<Vec4> keyed_curve<Vec4>(std::span<const Key<Vec4>>, const KeyOptions&);
template Curve<Color> keyed_curve<Color>(std::span<const Key<Color>>, const KeyOptions&);
template Curve<Quat> keyed_curve<Quat>(std::span<const Key<Quat>>, const KeyOptions&);

}  // namespace tweenfall
