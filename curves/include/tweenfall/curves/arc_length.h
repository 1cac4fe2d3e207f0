#pragma once

/// How long a path is, which point is reached after a given length, and the same path at even speed.
///
/// Lengths are measured along the path, whatever the timing: by Gauss-Legendre quadrature with 16 points, on stretches
/// cut where the speed is least and then halved until the two halves agree with the whole within 1e-13 of the path's
/// length. A jump has no length.

#include <tweenfall/curves/curve.h>

#include <memory>

namespace tweenfall {

/// Length of the path from time `from` to time `to`, U; negative when to < from. For double (the way up and down),
/// Vec2, Vec3, Vec4.
/// @throws std::invalid_argument for a time that is not finite, and where loops would play more than a million times.
template <class T>
[[nodiscard]] double arc_length(const Curve<T>& curve, double from, double to);

/// A path measured once, from its first knot to its last, to be asked often.
template <class T>
class MeasuredPath {
 public:
  // A move is a copy: that is just as cheap, and the object moved from stays valid.
  MeasuredPath(const MeasuredPath&) noexcept = default;
  MeasuredPath& operator=(const MeasuredPath&) noexcept = default;

  /// @throws std::invalid_argument for an endless curve.
  explicit MeasuredPath(const Curve<T>& path);

  [[nodiscard]] double length() const noexcept;                           ///< of the whole path, U
  [[nodiscard]] double length_at(double time) const noexcept;             ///< from the start; 0 before, the whole after
  [[nodiscard]] double time_at(double length_from_start) const noexcept;  ///< s; its ends outside 0 to length()

  /// The point after a length, and its derivatives by length: the unit tangent and the curvature vector, 1/U.
  [[nodiscard]] Sample<T> sample_at(double length_from_start, Side side = Side::out) const noexcept;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// The path from its first knot to its last in `duration` seconds from `start` on, at constant speed.
/// @throws std::invalid_argument for an endless path, and unless duration > 0 s.
template <class T>
[[nodiscard]] Curve<T> at_even_speed(const Curve<T>& path, double start, double duration);

}  // namespace tweenfall
