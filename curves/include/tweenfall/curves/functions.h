#pragma once

/// Motion given by a formula instead of keyframes: the state is an exact function of time.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/ease.h>

#include <span>
#include <vector>

namespace tweenfall {

/// A body thrown in uniform gravity: from + velocity t + gravity t^2 / 2.
struct Projectile {
  Vec3 from{0, 0, 0};         ///< m
  Vec3 velocity{0, 0, 0};     ///< m/s at t = 0
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
};
[[nodiscard]] Curve<Vec3> projectile(const Projectile& settings);

/// amplitude cos(2 pi hz t + phase) exp(-damping t).
struct Oscillator {
  double amplitude = 1;  ///< any unit U
  double hz = 1;         ///< cycles per second
  double phase = 0;      ///< radians
  double damping = 0;    ///< decay rate, 1/s; >= 0
  double center = 0;     ///< U, added
};
/// @throws std::invalid_argument for non-finite numbers or negative damping.
[[nodiscard]] Curve<double> oscillator(const Oscillator& settings);

/// A mass on a damped spring whose anchor moves at constant speed: x'' + 2 z w x' + w^2 (x - goal - goal_velocity t) =
/// 0 with w = 2 pi hz, solved exactly for every damping ratio and at every time, before t = 0 too.
struct DampedSpring {
  double hz = 1;             ///< undamped cycles per second; > 0
  double damping_ratio = 1;  ///< z; 0 rings forever, 1 is critical, above 1 creeps; >= 0
  double position = 0;       ///< any unit U, at t = 0
  double velocity = 0;       ///< U/s, at t = 0
  double goal = 0;           ///< U, at t = 0
  double goal_velocity = 0;  ///< U/s
};
/// @throws std::invalid_argument for non-finite numbers, hz not > 0 or a negative damping ratio.
[[nodiscard]] Curve<double> damped_spring(const DampedSpring& settings);
/// A mass on a stiff, massless arm, without friction: angle'' = -(gravity / length) sin(angle), at any amplitude.
struct Pendulum {
  double angle = 0.5;     ///< radians from hanging down, at t = 0
  double rate = 0;        ///< rad/s at t = 0; if fast enough, it goes over the top and its angle grows without end
  double length = 1;      ///< m; > 0
  double gravity = 9.81;  ///< m/s^2; > 0
};
/// The angle over time. Source: the closed form in Jacobi's elliptic functions, NIST DLMF 22.19(i).
/// @throws std::invalid_argument for non-finite numbers, or a length or gravity not > 0.
[[nodiscard]] Curve<double> pendulum(const Pendulum& settings);
/// Time of one swing there and back, or of one turn over the top, s; infinity where it just reaches the top.
[[nodiscard]] double pendulum_period(const Pendulum& settings);

/// A small body around a heavy one: a conic section with the heavy body at a focus, traversed by Kepler's second law.
struct Orbit {
  Vec3 center{0, 0, 0};                ///< the heavy body, m
  double periapsis = 1;                ///< least distance from it, m; > 0
  double eccentricity = 0;             ///< >= 0: below 1 an ellipse, 1 a parabola, above a hyperbola
  double gravitational_parameter = 1;  ///< G M, m^3/s^2; > 0
  double passage = 0;                  ///< time at which the periapsis is passed, s
  Quat rotation{1, 0, 0, 0};           ///< turns the plane: x to the periapsis, y as the body moves there

  /// The settings of an ellipse that takes `period` seconds for one revolution.
  /// @throws std::invalid_argument unless eccentricity < 1 and period > 0.
  [[nodiscard]] Orbit with_period(double period) const;
};
/// @throws std::invalid_argument for non-finite numbers, those out of range, and a zero rotation.
[[nodiscard]] Curve<Vec3> orbit(const Orbit& settings);

/// A smooth path through points, traversed at constant speed.
struct EvenPath {
  std::vector<Vec3> points;     ///< m; two or more, no two neighbors equal
  bool closed = false;          ///< back to the first point, and smooth there
  double duration = 1;          ///< s for the whole way; > 0
  Ease ease = Ease::natural();  ///< tangent rule that shapes the path
};
/// From 0 s to the duration; the speed is the path's length divided by the duration, to about 1e-12.
/// @throws std::invalid_argument naming the point that is not finite or equal to the one before; too few points.
[[nodiscard]] Curve<Vec3> even_path(const EvenPath& settings);
/// The path of `shape`, from its first knot to its last, traversed at constant speed from 0 s to `duration`. It kinks
/// where `shape` does; where `shape` jumps, the jump takes no time.
/// @throws std::invalid_argument for an endless shape, one without length, or a duration not > 0.
[[nodiscard]] Curve<Vec3> even_path(const Curve<Vec3>& shape, double duration);

/// A straight line, traversed at constant speed.
struct Line {
  Vec3 from{0, 0, 0}, to{0, 0, 0};  ///< m
  double duration = 1;              ///< s; > 0
};
[[nodiscard]] Curve<Vec3> line(const Line& settings);

/// Part of a circle, or several turns of it, at constant speed.
struct Arc {
  Vec3 center{0, 0, 0};  ///< m
  Vec3 from{1, 0, 0};    ///< where it begins, m
  Vec3 axis{0, 0, 1};    ///< turns counter-clockwise seen from its tip; any length. The part of `from` along it stays
  double angle = 0x1.921fb54442d18p+2;  ///< radians; negative: the other way
  double duration = 1;                  ///< s; > 0
};
[[nodiscard]] Curve<Vec3> arc(const Arc& settings);

/// Any curve in space from functions for its coordinates. It has their extent if they share one; otherwise it is
/// endless, and each coordinate continues by its own rule.
[[nodiscard]] Curve<Vec2> parametric(const Curve<double>& x, const Curve<double>& y);
[[nodiscard]] Curve<Vec3> parametric(const Curve<double>& x, const Curve<double>& y, const Curve<double>& z);

/// The sum of coefficients[i] * basis[i](t): one basis for all coordinates.
/// @throws std::invalid_argument unless there are as many coefficients as functions, and one at least.
template <class T>
[[nodiscard]] Curve<T> combined(std::span<const Curve<double>> basis, std::span<const T> coefficients);

}  // namespace tweenfall
