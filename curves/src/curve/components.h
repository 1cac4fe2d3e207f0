#pragma once

// Value types as rows of plain numbers, for rules that work component by component.

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/values.h>

#include <cmath>
#include <string>

namespace tweenfall::spans {

template <class T>
inline constexpr int dimensions = T::RowsAtCompileTime;
template <>
inline constexpr int dimensions<double> = 1;
template <>
inline constexpr int dimensions<Color> = 4;
template <>
inline constexpr int dimensions<Quat> = 4;

inline double component(double v, int) noexcept {
  return v;
}
inline double component(const Color& v, int i) noexcept {
  return v.rgba[i];
}
inline double component(const Quat& v, int i) noexcept {
  return v.coeffs()[i];
}
template <class T>
double component(const T& v, int i) noexcept {
  return v[i];
}

inline double& component_of(double& v, int) noexcept {
  return v;
}
template <class T>
double& component_of(T& v, int i) noexcept {
  return v[i];
}

template <class R>
R zero_rate() noexcept {
  if constexpr (std::is_same_v<R, double>)
    return 0.0;
  else
    return R::Zero();
}

template <class T>
bool all_finite(const T& v) noexcept {
  for (int i = 0; i < dimensions<T>; ++i)
    if (!std::isfinite(component(v, i))) return false;
  return true;
}

// For error texts: vectors in parentheses.
inline std::string text_of(double v) {
  return number_text(v);
}
template <class T>
std::string text_of(const T& v) {
  std::string out = "(";
  for (int i = 0; i < dimensions<T>; ++i) out += (i ? ", " : "") + text_of(component(v, i));
  return out + ")";
}

}  // namespace tweenfall::spans
