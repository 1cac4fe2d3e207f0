#pragma once

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/values.h>

namespace tweenfall::planar::inner {

[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}
/// A quarter turn counterclockwise; times a spin, it is the velocity of a point at this arm.
[[nodiscard]] inline Vec2 quarter(const Vec2& a) {
  return {-a.y(), a.x()};
}

/// A rotation.
struct Turn {
  double cos = 1, sin = 0;

  [[nodiscard]] static Turn of(double angle) {
    const elementary::SinCos both = elementary::sin_cos(angle);
    return {both.cos, both.sin};
  }
  [[nodiscard]] Vec2 operator*(const Vec2& v) const { return {cos * v.x() - sin * v.y(), sin * v.x() + cos * v.y()}; }
  /// The inverse rotation.
  [[nodiscard]] Vec2 back(const Vec2& v) const { return {cos * v.x() + sin * v.y(), cos * v.y() - sin * v.x()}; }
  /// The rotation of another relative to this one.
  [[nodiscard]] Turn to(const Turn& other) const {
    return {cos * other.cos + sin * other.sin, cos * other.sin - sin * other.cos};
  }
};

}  // namespace tweenfall::planar::inner
