#pragma once

/// `Curve<T>`: a value that varies over time, and its exact rates.
///
/// A curve is immutable, always valid and cheap to copy (copies share their data). It is made
/// from keys (`keys.h`), from a formula (`functions.h`), or from spans directly (`span.h`), and
/// evaluated at any finite time: evaluation never throws and never allocates.
///
/// Which span owns a knot: the one that leaves it. At a key, `Side::out` (the default) gives
/// the value and rate that leave, `Side::in` those that arrive; they differ only where the
/// curve jumps or kinks. Outside its knots a curve continues as `outside` says.

#include <tweenfall/curves/rotation.h>
#include <tweenfall/curves/span.h>
#include <tweenfall/curves/values.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tweenfall {

/// What a curve does before its first and after its last knot.
enum class Outside {
  hold,           ///< the end value, at rest
  linear,         ///< straight on at the end's rate
  repeat,         ///< the curve again
  repeat_offset,  ///< the curve again, starting from where it ended
  pingpong,       ///< the curve backwards, then forwards, ...
};

/// The rule in full, for one end of a curve of values `T`.
template <class T>
struct OutsideRule {
  Outside rule = Outside::hold;
  /// For `linear`: the rate to go on at, U/s. If absent, the rate at the end, or that of the handle which the end's key
  /// has on its outer side.
  std::optional<Rate<T>> slope{};
  /// For `repeat`, `repeat_offset` and `pingpong`: how many times the curve plays beyond this end before it rests where
  /// it got to; 0 is for ever. Need not be a whole number.
  double plays = 0;
};

struct CurveAccess;

template <class T>
class Curve {
 public:
  using Formula = std::function<Sample<T>(double time, Side side)>;

  // A move is a copy: that is just as cheap, and the object moved from stays valid.
  Curve(const Curve&) noexcept = default;
  Curve& operator=(const Curve&) noexcept = default;

  /// The constant `value`, at every time.
  explicit Curve(const T& value);

  /// Spans in order of time, each starting where the one before ends.
  /// @throws std::invalid_argument naming the span: empty list, gap, duration not > 0, non-finite number.
  explicit Curve(std::span<const typename SpanOf<T>::type> spans);

  /// A formula that returns its own derivatives; `start` and `end` may be infinite. Must not throw.
  Curve(Formula formula, double start, double end);

  /// A formula that can be evaluated at every time, beyond its ends too, and has `knots`, s: where it begins, changes
  /// and ends. Beyond its ends, a rule set by `with_outside` takes its place.
  /// @throws std::invalid_argument for no formula, no knots, or knots that do not strictly increase.
  Curve(Formula formula, std::vector<double> knots);

  /// The same curve with other rules outside its knots.
  [[nodiscard]] Curve with_outside(Outside before, Outside after) const;
  /// @throws std::invalid_argument for a non-finite slope or plays not >= 0.
  [[nodiscard]] Curve with_outside(const OutsideRule<T>& before, const OutsideRule<T>& after) const;

  [[nodiscard]] double start() const noexcept;  ///< first knot, s; -infinity for an endless formula, 0 for a constant
  [[nodiscard]] double end() const noexcept;    ///< last knot, s
  [[nodiscard]] double duration() const noexcept { return end() - start(); }
  [[nodiscard]] Outside before() const noexcept;
  [[nodiscard]] Outside after() const noexcept;
  [[nodiscard]] const OutsideRule<T>& rule_before() const noexcept;
  [[nodiscard]] const OutsideRule<T>& rule_after() const noexcept;

  /// Knots in order, s; empty for a constant or a formula. A curve seen through a conversion (a color mixed in
  /// another space, a logarithmic scale, angles as a rotation) has the knots of the curve it is made of.
  [[nodiscard]] std::span<const double> knots() const noexcept;

  /// The knots that are keys, in order, s: all but those inside an ease of several pieces, which nobody wrote, such as
  /// the one half way through quad-in-out.
  [[nodiscard]] std::span<const double> key_times() const noexcept;

  /// Value, rate and acceleration at any finite time.
  [[nodiscard]] Sample<T> sample(double time, Side side = Side::out) const noexcept;
  [[nodiscard]] T value(double time, Side side = Side::out) const noexcept;
  [[nodiscard]] Rate<T> rate(double time, Side side = Side::out) const noexcept { return sample(time, side).rate; }

  /// The spans, as built; empty for a constant, a formula or a curve seen through a conversion.
  [[nodiscard]] std::vector<typename SpanOf<T>::type> spans() const;

 private:
  friend struct CurveAccess;
  struct Data;
  explicit Curve(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;
};

extern template class Curve<double>;
extern template class Curve<Vec2>;
extern template class Curve<Vec3>;
extern template class Curve<Vec4>;
extern template class Curve<Color>;
extern template class Curve<Quat>;

/// Angles over time as a rotation; the rate is the exact angular velocity.
/// @param angles  radians in the order's sequence of axes
[[nodiscard]] Curve<Quat> euler_curve(const Curve<Vec3>& angles, const EulerOrder& order);

/// An angle in radians over time about a fixed axis; turns are not wrapped.
/// @throws std::invalid_argument for a zero axis.
[[nodiscard]] Curve<Quat> axis_curve(const Vec3& axis, const Curve<double>& angle);

/// A ratio of width to height over time as the two factors of a shape that keeps its area: (sqrt(r), 1 / sqrt(r)), of
/// product 1. Keys of `ratio` mixed by their logarithm (`KeyOptions::logarithmic`) go from 1:4 to 4:1 through 1:1.
/// @param ratio  > 0 wherever it is sampled; where it is not, the factors are those of 1
[[nodiscard]] Curve<Vec2> aspect_curve(const Curve<double>& ratio);

}  // namespace tweenfall
