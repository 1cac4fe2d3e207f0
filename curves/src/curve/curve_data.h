#pragma once

// What a curve stores: spans laid out for reading in one sweep, or a formula.

#include <tweenfall/curves/curve.h>

#include <algorithm>
#include <cstdint>

#include "curve/components.h"

namespace tweenfall {

// Coefficients are kept in this type.
template <class T>
struct Stored {
  using type = T;
};
template <>
struct Stored<Color> {
  using type = Vec4;
};
template <>
struct Stored<Quat> {
  using type = Vec4;
};

/// What lies beyond one end of a curve.
template <class T>
struct CurveEnd {
  OutsideRule<T> rule{};
  std::optional<T> value{};        ///< what arrives at the first knot, or leaves the last, where spans say otherwise
  std::optional<Rate<T>> slope{};  ///< of the end's key on its outer side, where that is not the curve's own

  [[nodiscard]] const std::optional<Rate<T>>& straight() const noexcept { return rule.slope ? rule.slope : slope; }
};

struct Segment {
  double start, duration, inverse;
  std::uint32_t first;  // index of coefficient 0 in the pool
  std::int16_t degree;
  bool warped;
  RotationSpan::Form form;  // rotations only

  // Where in the segment `time` lies, 0 to 1.
  [[nodiscard]] double position(double time) const noexcept { return std::min((time - start) * inverse, 1.0); }
};

template <class T>
struct Curve<T>::Data {
  CurveEnd<T> before, after;
  double start = 0, end = 0;

  std::vector<double> knots;
  std::vector<Segment> segments;
  std::vector<typename Stored<T>::type> pool;
  std::vector<T> ends;      // values on arrival, one a segment
  std::vector<T> starts;    // rotations only: what the exponential multiplies
  std::vector<Warp> warps;  // empty, or one a segment
  std::vector<Vec3> spins;  // rotations only: empty, or one a segment

  // Where to look for a time: entry b counts the knots in buckets below b, buckets being equal shares of the duration.
  // Two a span, so that where keys are spread evenly no bucket has more than one.
  std::vector<std::uint32_t> buckets;
  double bucket_scale = 0;

  Formula formula;  // empty where there are spans
  // Set where the formula answers at every time by itself and makes the curve anew with other rules outside.
  std::function<Curve(const OutsideRule<T>&, const OutsideRule<T>&)> rebuilt;

  [[nodiscard]] std::size_t bucket(double time) const noexcept {
    const double b = (time - start) * bucket_scale;
    const std::size_t last = buckets.size() - 2;
    return b < static_cast<double>(last) ? static_cast<std::size_t>(b) : last;
  }

  // Index of the segment that leaves the last knot at or before `time`, for start <= time < end.
  [[nodiscard]] std::size_t locate(double time) const noexcept {
    if (segments.size() == 1) return 0;
    const std::size_t b = bucket(time);
    std::size_t low = buckets[b], high = buckets[b + 1];  // knots below the bucket, and up to its end
    // Without a branch that depends on the time; a knot beyond the bucket is later than `time` anyway.
    if (high - low <= 1) return low + (knots[low] <= time ? 1 : 0) - 1;
    while (high - low > 4) {
      const std::size_t middle = (low + high) / 2;
      (knots[middle] <= time ? low : high) = knots[middle] <= time ? middle + 1 : middle;
    }
    while (low < high && knots[low] <= time) ++low;
    return low - 1;
  }
};

struct CurveAccess {
  template <class T>
  static const typename Curve<T>::Data& data(const Curve<T>& curve) noexcept {
    return *curve.data_;
  }

  /// `value` at all times, with one knot at `time`.
  template <class T>
  static Curve<T> one_key(const T& value, double time, const CurveEnd<T>& before = {}, const CurveEnd<T>& after = {}) {
    auto data = std::make_shared<typename Curve<T>::Data>();
    data->formula = [value](double, Side) { return Sample<T>{value, zero_rate<Rate<T>>(), zero_rate<Rate<T>>()}; };
    data->start = data->end = time;
    data->knots = {time};
    data->before = before;
    data->after = after;
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// A curve of checked spans with its last knot given to the bit, and what lies beyond its ends.
  template <class T>
  static Curve<T> from_spans(std::span<const typename SpanOf<T>::type> spans, double end,
                             const CurveEnd<T>& before = {}, const CurveEnd<T>& after = {});

  /// The same curve with something else beyond its ends.
  template <class T>
  static Curve<T> with_ends(const Curve<T>& curve, const CurveEnd<T>& before, const CurveEnd<T>& after) {
    auto data = std::make_shared<typename Curve<T>::Data>(*curve.data_);
    data->before = before;
    data->after = after;
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// What arrives at the first knot (`early`) or leaves the last: that from which the curve goes on, and between which
  /// loops with an offset climb.
  template <class T>
  static T end_value(const Curve<T>& curve, bool early) noexcept;

  /// A formula between knots, with the usual rules outside.
  template <class T>
  static Curve<T> formula_with_knots(typename Curve<T>::Formula formula, double start, double end,
                                     std::span<const double> knots) {
    auto data = std::make_shared<typename Curve<T>::Data>();
    data->formula = std::move(formula);
    data->start = start;
    data->end = end;
    data->knots.assign(knots.begin(), knots.end());
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// A curve that another one is made into: it answers at all times, `rebuilt` makes it anew with other rules outside.
  template <class T>
  static Curve<T> seen_through(typename Curve<T>::Formula formula, double start, double end,
                               std::span<const double> knots, const OutsideRule<T>& before, const OutsideRule<T>& after,
                               std::function<Curve<T>(const OutsideRule<T>&, const OutsideRule<T>&)> rebuilt) {
    auto data = std::make_shared<typename Curve<T>::Data>();
    data->formula = std::move(formula);
    data->start = start;
    data->end = end;
    data->knots.assign(knots.begin(), knots.end());
    data->before.rule = before;
    data->after.rule = after;
    data->rebuilt = std::move(rebuilt);
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// The values of `inner` as values of another kind: `sampler(inner, time, side)`. Rules outside are those of `inner`;
  /// slopes stated for the result are its own.
  template <class T, class Inner, class Sampler>
  static Curve<T> converted(const Curve<Inner>& inner, const Sampler& sampler) {
    const OutsideRule<Inner>&before = inner.rule_before(), &after = inner.rule_after();
    return seen_through<T>(
        [inner, sampler](double time, Side side) { return sampler(inner, time, side); }, inner.start(), inner.end(),
        inner.knots(), {before.rule, {}, before.plays}, {after.rule, {}, after.plays},
        [inner, sampler](const OutsideRule<T>& early, const OutsideRule<T>& late) {
          const Curve<T> again =
              converted<T>(inner.with_outside({early.rule, {}, early.plays}, {late.rule, {}, late.plays}), sampler);
          return with_ends<T>(again, {early, {}, {}}, {late, {}, {}});
        });
  }
};

}  // namespace tweenfall
