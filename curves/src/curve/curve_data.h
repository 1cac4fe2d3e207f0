#pragma once

// What a curve stores: spans laid out to be read in sequence, or a formula.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/leaps.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "curve/components.h"
#include "curve/hermite_coefficients.h"
#include "curve/span_times.h"

namespace tweenfall::spans {

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
  std::optional<T> value{};  ///< the value arriving at the first knot or leaving the last, if not that of the spans
  std::optional<Rate<T>> slope{};  ///< of the end key on its outer side, if it is not the curve's own

  [[nodiscard]] const std::optional<Rate<T>>& straight() const noexcept { return rule.slope ? rule.slope : slope; }
};

/// The knots of a curve, and which of them are keys.
struct Breaks {
  std::vector<double> knots;
  std::vector<double> keys{};  // empty where all knots are keys
};

// One span as it is evaluated.
struct Segment {
  double start, duration, inverse;
  std::size_t first;  // index of its first row of coefficients
  std::int16_t degree;
  bool warped;
  RotationSpan::Form form;  // rotations only

  // Where in the segment `time` lies, 0 to 1.
  [[nodiscard]] double position(double time) const noexcept { return std::min((time - start) * inverse, 1.0); }
};

}  // namespace tweenfall::spans

namespace tweenfall {

template <class T>
struct Curve<T>::Data {
  using Row = typename spans::Stored<T>::type;
  // The kind of a span: one for each of them, or a single one where all are alike.
  struct Kind {
    std::uint32_t first;  // row of coefficients; where all are alike they follow each other
    std::int16_t degree;
    bool warped;
    RotationSpan::Form form;
  };

  spans::CurveEnd<T> before, after;
  double start = 0, end = 0;

  std::shared_ptr<const SpanTimes> times;  // null where there is a formula
  std::vector<Kind> kinds;
  std::uint32_t rows = 0;  // per span, where all are alike
  std::vector<Row> pool;
  // The value and the rate at each knot, where all spans are the cubics through them. They replace the pool and take
  // half of its room; curves of numbers, which are sampled most often, always have a pool.
  std::vector<Row> passed;
  // Values on arrival, one for each span; only the last one where every span ends where the next starts.
  std::vector<T> ends;
  std::vector<Warp> warps;  // empty, or one for each span

  // Rotations only: the rotations that the exponentials multiply, one per span; and, if all are exponentials of the
  // same degree without warp or spin, their rows: three numbers each, from the first power on, in place of the pool.
  std::vector<T> starts;
  std::vector<Vec3> turns;
  bool plain_turns = false;
  std::vector<Vec3> spins;  // empty, or one for each span

  std::vector<double> marks;            // knots that a formula states
  std::vector<NumberOverTime> leaping;  // parts of a formula that leap elsewhere
  std::vector<double> keys;             // the knots that are keys; empty where all are
  Formula formula;                      // empty where there are spans
  // Set where the formula can be evaluated at every time; rebuilds the curve with other rules outside.
  std::function<Curve(const OutsideRule<T>&, const OutsideRule<T>&)> rebuilt;

  [[nodiscard]] std::size_t span_count() const noexcept { return times ? times->count() : 0; }
  [[nodiscard]] std::span<const double> knots() const noexcept {
    return times ? times->knots() : std::span<const double>(marks);
  }
  [[nodiscard]] spans::Segment segment(std::size_t i) const noexcept {
    const bool alike = kinds.size() == 1;
    const Kind& kind = kinds[alike ? 0 : i];
    return {times->knots()[i], times->duration(i), times->inverse(i), alike ? i * rows : kind.first,
            kind.degree,       kind.warped,        kind.form};
  }
  // The coefficients of span i.
  [[nodiscard]] const Row* coefficients(std::size_t i, std::size_t first, std::array<Row, 4>& room) const noexcept {
    if constexpr (!std::is_same_v<T, double>) {
      if (!passed.empty()) {
        spans::cubic_through(&passed[2 * i], times->duration(i), room.data());
        return room.data();
      }
    }
    return &pool[first];
  }
  [[nodiscard]] T arrival(std::size_t i) const noexcept {
    if (ends.size() == span_count()) return ends[i];
    if (i + 1 == span_count()) return ends[0];
    return departure(i + 1);
  }

 private:
  [[nodiscard]] T departure(std::size_t i) const noexcept {
    if constexpr (std::is_same_v<T, Quat>)
      return starts[i];
    else
      return T{passed.empty() ? pool[segment(i).first] : passed[2 * i]};
  }
};

struct CurveAccess {
  template <class T>
  static spans::Breaks breaks(const Curve<T>& curve) {
    const std::span<const double> knots = curve.knots();
    return {{knots.begin(), knots.end()}, curve.data_->keys};
  }

  template <class T>
  static const typename Curve<T>::Data& data(const Curve<T>& curve) noexcept {
    return *curve.data_;
  }

  /// `value` at all times, with one knot at `time`.
  template <class T>
  static Curve<T> one_key(const T& value, double time, const spans::CurveEnd<T>& before = {},
                          const spans::CurveEnd<T>& after = {}) {
    auto data = std::make_shared<typename Curve<T>::Data>();
    data->formula = [value](double, Side) {
      return Sample<T>{value, spans::zero_rate<Rate<T>>(), spans::zero_rate<Rate<T>>()};
    };
    data->start = data->end = time;
    data->marks = {time};
    data->before = before;
    data->after = after;
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// A curve of checked spans with its last knot given to the bit, and what lies beyond its ends.
  template <class T>
  static Curve<T> from_spans(std::span<const typename SpanOf<T>::type> spans, double end,
                             const spans::CurveEnd<T>& before = {}, const spans::CurveEnd<T>& after = {});

  /// The curve of the cubics through values with one rate at each of two or more knots, `dimensions` numbers per rate,
  /// made without their spans. Empty where numbers are so large that each span must be checked.
  /// @param times  finite and increasing
  template <class T>
  static std::optional<Curve<T>> cubics_through(std::span<const double> times, std::span<const T> values,
                                                std::span<const double> rates, const spans::CurveEnd<T>& before = {},
                                                const spans::CurveEnd<T>& after = {});

  /// The same curve with something else beyond its ends.
  template <class T>
  static Curve<T> with_ends(const Curve<T>& curve, const spans::CurveEnd<T>& before, const spans::CurveEnd<T>& after) {
    auto data = std::make_shared<typename Curve<T>::Data>(*curve.data_);
    data->before = before;
    data->after = after;
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// The value arriving at the first knot (`early`) or leaving the last: the curve continues from it, and the
  /// difference of the two is what loops with an offset add per play.
  template <class T>
  static T end_value(const Curve<T>& curve, bool early) noexcept;

  /// A formula between knots, with the usual rules outside.
  template <class T>
  static Curve<T> formula_with_knots(typename Curve<T>::Formula formula, double start, double end,
                                     const spans::Breaks& breaks) {
    auto data = std::make_shared<typename Curve<T>::Data>();
    data->formula = std::move(formula);
    data->start = start;
    data->end = end;
    data->marks = breaks.knots;
    data->keys = breaks.keys;
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// The parts of its formula that may leap.
  template <class T>
  static const std::vector<NumberOverTime>& leaping(const Curve<T>& curve) noexcept {
    return curve.data_->leaping;
  }
  template <class T>
  static Curve<T> with_leaping(const Curve<T>& curve, std::span<const NumberOverTime> parts) {
    auto data = std::make_shared<typename Curve<T>::Data>(*curve.data_);
    data->leaping.assign(parts.begin(), parts.end());
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// A curve converted from another: `formula` holds at all times; `rebuilt` makes the curve with other rules outside.
  template <class T>
  static Curve<T> seen_through(typename Curve<T>::Formula formula, double start, double end,
                               const spans::Breaks& breaks, const OutsideRule<T>& before, const OutsideRule<T>& after,
                               std::function<Curve<T>(const OutsideRule<T>&, const OutsideRule<T>&)> rebuilt,
                               std::span<const NumberOverTime> leaping = {}) {
    auto data = std::make_shared<typename Curve<T>::Data>();
    data->formula = std::move(formula);
    data->start = start;
    data->end = end;
    data->marks = breaks.knots;
    data->keys = breaks.keys;
    data->before.rule = before;
    data->after.rule = after;
    data->rebuilt = std::move(rebuilt);
    data->leaping.assign(leaping.begin(), leaping.end());
    return Curve<T>(std::shared_ptr<const typename Curve<T>::Data>(std::move(data)));
  }

  /// The values of `inner` as values of another kind: `sampler(inner, time, side)`. Rules outside are those of `inner`;
  /// a slope stated later applies to the result, not to `inner`.
  template <class T, class Inner, class Sampler>
  static Curve<T> converted(const Curve<Inner>& inner, const Sampler& sampler) {
    const OutsideRule<Inner>&before = inner.rule_before(), &after = inner.rule_after();
    return seen_through<T>(
        [inner, sampler](double time, Side side) { return sampler(inner, time, side); }, inner.start(), inner.end(),
        breaks(inner), {before.rule, {}, before.plays}, {after.rule, {}, after.plays},
        [inner, sampler](const OutsideRule<T>& early, const OutsideRule<T>& late) {
          const Curve<T> again =
              converted<T>(inner.with_outside({early.rule, {}, early.plays}, {late.rule, {}, late.plays}), sampler);
          return with_ends<T>(again, {early, {}, {}}, {late, {}, {}});
        },
        leaping(inner));
  }
};

}  // namespace tweenfall
