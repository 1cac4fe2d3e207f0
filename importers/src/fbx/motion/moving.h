#pragma once

// Curves made of curves, moment by moment, with exact rates.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall::fbx {

/// A curve, and whether the file drives it at all or it is only the value at rest.
template <class T>
struct Channel {
  Curve<T> curve;
  bool driven = false;
};

/// The times at which any of some curves has a knot.
class Knots {
 public:
  template <class T>
  Knots& of(const Curve<T>& curve) {
    times_.insert(times_.end(), curve.knots().begin(), curve.knots().end());
    return *this;
  }
  /// In order, each once.
  [[nodiscard]] std::vector<double> sorted() const;

 private:
  std::vector<double> times_;
};

/// The formula with those knots; without any knots, the constant.
template <class T>
[[nodiscard]] Curve<T> composed(typename Curve<T>::Formula formula, const Knots& knots) {
  std::vector<double> times = knots.sorted();
  if (times.empty()) return Curve<T>(formula(0, Side::out).value);
  return Curve<T>(std::move(formula), std::move(times));
}

/// Three curves of numbers as one of vectors. If they have the same keys, their spans are kept.
[[nodiscard]] Curve<Vec3> vector_curve(const Curve<double>& x, const Curve<double>& y, const Curve<double>& z);

[[nodiscard]] Sample<Vec3> sum(const Sample<Vec3>& a, const Sample<Vec3>& b) noexcept;
[[nodiscard]] Sample<Vec3> difference(const Sample<Vec3>& a, const Sample<Vec3>& b) noexcept;
[[nodiscard]] Sample<double> product(const Sample<double>& a, const Sample<double>& b) noexcept;
/// Component by component.
[[nodiscard]] Sample<Vec3> product(const Sample<Vec3>& a, const Sample<Vec3>& b) noexcept;
[[nodiscard]] Sample<Vec3> scaled(const Sample<Vec3>& a, const Sample<double>& factor) noexcept;
[[nodiscard]] Sample<Vec3> turned(const Sample<Quat>& rotation, const Sample<Vec3>& v) noexcept;
/// base^exponent with the sign of the base; 1 for an exponent of 0 or less, the base for one of 1 or more.
[[nodiscard]] Sample<double> power(const Sample<double>& base, const Sample<double>& exponent) noexcept;

/// The product of two channels, component by component.
[[nodiscard]] Channel<Vec3> product(const Channel<Vec3>& a, const Channel<Vec3>& b);

}  // namespace tweenfall::fbx
