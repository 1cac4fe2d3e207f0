#pragma once

/// Splines from data: curves through values at given times, or defined by control points; `keys.h` is for curves that
/// people shape with eases. All are piecewise polynomials, so that rates are exact; every builder takes time and memory
/// in proportion to its input.
///
/// `T` is double, Vec2, Vec3 or Vec4. Times are in seconds, strictly increasing. Wrong input throws
/// std::invalid_argument, which names the index and the value: too few or unordered times, lists of the wrong length,
/// non-finite numbers.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/ease.h>

#include <span>
#include <vector>

namespace tweenfall {

/// The cubic Hermite spline through `values` with `rates`, U/s; one of each per time, two or more.
template <class T>
[[nodiscard]] Curve<T> hermite_spline(std::span<const double> times, std::span<const T> values,
                                      std::span<const T> rates);

/// The quintic Hermite spline through `values` with `rates`, U/s, and `accelerations`, U/s^2.
template <class T>
[[nodiscard]] Curve<T> quintic_spline(std::span<const double> times, std::span<const T> values,
                                      std::span<const T> rates, std::span<const T> accelerations);

/// The condition that a spline meets at one of its ends.
template <class T>
struct SplineEnd {
  enum class Kind {
    automatic,     ///< as the spline's rule chooses
    rate,          ///< `given`, U/s ("clamped")
    acceleration,  ///< `given`, U/s^2; zero is "natural"
    not_a_knot,    ///< the two spans next to the end are one cubic; C2 splines only
  };
  Kind kind = Kind::automatic;
  T given = zero<T>();

  [[nodiscard]] static SplineEnd rate(const T& given) { return {Kind::rate, given}; }
  [[nodiscard]] static SplineEnd acceleration(const T& given) { return {Kind::acceleration, given}; }
  [[nodiscard]] static SplineEnd not_a_knot() { return {Kind::not_a_knot}; }
};

template <class T>
struct SplineEnds {
  SplineEnd<T> start{}, end{};
  /// The spline returns to its first value at an additional last time, and is as smooth there as at any other value.
  bool closed = false;
};

/// The cubic spline through `values` with continuous acceleration; an automatic end is natural.
template <class T>
[[nodiscard]] Curve<T> c2_spline(std::span<const double> times, std::span<const T> values,
                                 const SplineEnds<T>& ends = {});

/// The cubic spline through `values` whose slopes a rule chooses, as Ease::makima() or Ease::tcb(...) do.
/// @param rules  one for all values, or one for each
/// @throws std::invalid_argument also for an ease without slopes, and for ends with one of continuous acceleration.
template <class T>
[[nodiscard]] Curve<T> cubic_spline(std::span<const double> times, std::span<const T> values,
                                    std::span<const Ease> rules, const SplineEnds<T>& ends = {});
template <class T>
[[nodiscard]] Curve<T> cubic_spline(std::span<const double> times, std::span<const T> values, const Ease& rule,
                                    const SplineEnds<T>& ends = {}) {
  return cubic_spline<T>(times, values, std::span<const Ease>(&rule, 1), ends);
}

/// How far a path's own parameter advances from one point to the next.
enum class Parametrization {
  uniform,      ///< 1
  centripetal,  ///< the square root of the distance: no cusps or loops
  chordal,      ///< the distance
};

/// Times for a spline through `points`, starting at 0; for a closed one, also the time of the return to the first.
/// @throws std::invalid_argument where consecutive points coincide, unless uniform.
template <class T>
[[nodiscard]] std::vector<double> spline_times(std::span<const T> points, Parametrization parametrization,
                                               bool closed = false);

/// Bezier segments, one from each time to the next.
/// @param control  degree + 1 control values per segment; degree 1 to 5, the same for all. A segment that does not
/// start where the one before ended makes a jump.
template <class T>
[[nodiscard]] Curve<T> bezier_spline(std::span<const double> times, std::span<const T> control);

/// The B-spline of a full knot vector, on the stretch where its basis functions sum to 1: from knot number `degree` to
/// knot number `control.size()`.
/// @param degree   1 to 5
/// @param knots    not decreasing, s; degree + 1 more than there are control points; each degree + 1 times at most
template <class T>
[[nodiscard]] Curve<T> b_spline(int degree, std::span<const double> knots, std::span<const T> control);

/// A full knot vector for `control` points with evenly spaced knots, on which a B-spline begins at the first point at
/// time `start` and ends at the last at time `end`.
/// @throws std::invalid_argument unless control > degree >= 1 and end > start.
[[nodiscard]] std::vector<double> clamped_knots(int degree, std::size_t control, double start, double end);

}  // namespace tweenfall
