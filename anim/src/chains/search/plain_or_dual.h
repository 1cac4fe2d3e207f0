#pragma once

// Arithmetic for code that is written once, for plain numbers and for numbers with rates. Both take the same steps to
// the same bits: so a way that was found with plain numbers, which are several times as fast, is gone again for rates.

#include "chains/moving.h"

namespace tweenfall::chains {

[[gnu::always_inline]] inline double value_of(double a) noexcept {
  return a;
}
[[gnu::always_inline]] inline double value_of(const Dual& a) noexcept {
  return a.v;
}
[[gnu::always_inline]] inline double reciprocal(double a) noexcept {
  return 1 / a;
}
[[gnu::always_inline]] inline Dual reciprocal(const Dual& a) noexcept {
  const double i = 1 / a.v;
  return {i, -a.d * i * i};
}
/// Square root; 0 at rest for numbers that are not positive.
[[gnu::always_inline]] inline double root(double a) noexcept {
  return a > 0 ? std::sqrt(a) : 0;
}

/// The angle of a sine and a cosine, of any length.
inline double arc_of(double sine, double cosine) noexcept {
  return elementary::atan2(sine, cosine);
}
inline Dual arc_of(const Dual& sine, const Dual& cosine) noexcept {
  return angle_of(sine, cosine);
}

template <class Number>
struct SinCosOf {
  Number sin, cos;
};
inline SinCosOf<double> sin_cos_of(double a) noexcept {
  const elementary::SinCos of = elementary::sin_cos(a);
  return {of.sin, of.cos};
}
inline SinCosOf<Dual> sin_cos_of(const Dual& a) noexcept {
  const elementary::SinCos of = elementary::sin_cos(a.v);
  return {{of.sin, of.cos * a.d}, {of.cos, -of.sin * a.d}};
}

/// A vector of such numbers.
template <class Number>
struct Three {
  Number x{}, y{}, z{};

  static Three of(const Arrow& a) noexcept {
    if constexpr (std::is_same_v<Number, Dual>)
      return {{a.v.x(), a.d.x()}, {a.v.y(), a.d.y()}, {a.v.z(), a.d.z()}};
    else
      return {a.v.x(), a.v.y(), a.v.z()};
  }
  static Three of(const Vec3& a) noexcept { return {Number(a.x()), Number(a.y()), Number(a.z())}; }
};

template <class Number>
[[gnu::always_inline]] inline Three<Number> operator+(const Three<Number>& a, const Three<Number>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Number>
[[gnu::always_inline]] inline Three<Number> operator-(const Three<Number>& a, const Three<Number>& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Number>
[[gnu::always_inline]] inline Three<Number> operator*(const Number& s, const Three<Number>& a) noexcept {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Number>
[[gnu::always_inline]] inline Number dot(const Three<Number>& a, const Three<Number>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Number>
[[gnu::always_inline]] inline Three<Number> cross(const Three<Number>& a, const Three<Number>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A rotation by what it makes of the axes.
template <class Number>
struct Nine {
  Three<Number> x{Number(1), Number(0), Number(0)}, y{Number(0), Number(1), Number(0)},
      z{Number(0), Number(0), Number(1)};

  static Nine of(const Turning& a) noexcept {
    const auto column = [&](int i) { return Three<Number>::of(a * Arrow{Vec3::Unit(i), Vec3(0, 0, 0)}); };
    return {column(0), column(1), column(2)};
  }
};

template <class Number>
[[gnu::always_inline]] inline Three<Number> operator*(const Nine<Number>& m, const Three<Number>& a) noexcept {
  return a.x * m.x + a.y * m.y + a.z * m.z;
}
template <class Number>
[[gnu::always_inline]] inline Nine<Number> operator*(const Nine<Number>& a, const Nine<Number>& b) noexcept {
  return {a * b.x, a * b.y, a * b.z};
}
/// The inverse rotation of a vector.
template <class Number>
[[gnu::always_inline]] inline Three<Number> back(const Nine<Number>& m, const Three<Number>& a) noexcept {
  return {dot(m.x, a), dot(m.y, a), dot(m.z, a)};
}

}  // namespace tweenfall::chains
