#pragma once

/// The things that can vary over time, and what comes back when one is sampled.
///
/// A curve carries numbers, vectors, colors or rotations. Sampling any of them gives a
/// `Sample`: the value, its rate (derivative with respect to seconds) and its
/// acceleration, all exact, never a finite difference. The rate of a rotation is an
/// angular velocity in radians per second, about the axes of the space that the rotation
/// maps into ("world axes" for a root).
///
/// None of these types asks for more than the alignment of `double`, so that a library and
/// a program built for different instruction sets agree on their layout.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <type_traits>

namespace tweenfall {

using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Vec3 = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;
using Vec4 = Eigen::Matrix<double, 4, 1, Eigen::DontAlign>;
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::DontAlign>;

/// A unit quaternion; `q` and `-q` are the same rotation.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Linear (not gamma-encoded) red, green, blue with Rec. 709 primaries, and straight alpha.
/// In gamut every part lies in 0 to 1; values outside are kept, not clipped.
struct Color {
  Vec4 rgba{0, 0, 0, 1};

  bool operator==(const Color&) const = default;
};

/// The type of a derivative of `T` with respect to time.
template <class T>
struct RateOf {
  using type = T;
};
template <>
struct RateOf<Quat> {
  using type = Vec3;
};
template <>
struct RateOf<Color> {
  using type = Vec4;
};
template <class T>
using Rate = typename RateOf<T>::type;

/// The zero of numbers and of vectors, which a default-constructed vector is not.
template <class T>
[[nodiscard]] T zero() noexcept {
  if constexpr (std::is_arithmetic_v<T>)
    return T{0};
  else
    return T::Zero();
}

/// What evaluation returns.
template <class T>
struct Sample {
  T value;               ///< unit U
  Rate<T> rate;          ///< U/s
  Rate<T> acceleration;  ///< U/s^2
};

/// Which limit to take at a key where a curve jumps or kinks: `in` is the motion that
/// arrives (what was shown up to that time), `out` the one that leaves.
enum class Side { in, out };

}  // namespace tweenfall
