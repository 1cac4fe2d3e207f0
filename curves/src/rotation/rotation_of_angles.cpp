#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/curve_data.h"

namespace tweenfall::rotations {
namespace {

// Beyond 1e15 rad no digit of an angle is left below a turn. Accelerations of turns hold squares of the rates.
template <class T>
void check_angles(const Curve<T>& angles) {
  const auto check = [](double time, double reach, double duration) {
    if (!(reach <= 1e15))
      throw std::invalid_argument("angles must stay within 1e15 rad; from " + spans::text_of(time) +
                                  " s on they reach " + spans::text_of(reach) + " rad");
    if (const double rate = 100 * reach / duration; !std::isfinite(rate * rate))
      throw std::invalid_argument("angles turn faster than a number can tell, by " + spans::text_of(reach) +
                                  " rad within " + spans::text_of(duration) + " s from " + spans::text_of(time) +
                                  " s on");
  };
  const auto size = [](const T& value) {
    double largest = 0;
    for (int i = 0; i < spans::dimensions<T>; ++i) largest = std::max(largest, std::abs(spans::component(value, i)));
    return largest;
  };
  if (angles.start() == angles.end()) check(angles.start(), size(angles.value(angles.start())), 1);
  for (const Span<T>& span : angles.spans()) {
    double reach = 0;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(span.degree); ++k) reach += size(span.coefficients[k]);
    check(span.start, reach, span.duration);
  }
}

}  // namespace
}  // namespace tweenfall::rotations

namespace tweenfall {

Curve<Quat> euler_curve(const Curve<Vec3>& angles, const EulerOrder& order) {
  for (int i = 0; i < 3; ++i)
    if (order.axes[i] < 0 || order.axes[i] > 2 || (i > 0 && order.axes[i] == order.axes[i - 1]))
      throw std::invalid_argument("the axes of Euler angles must be 0, 1 or 2 with neighbors that differ; they are " +
                                  std::to_string(order.axes[0]) + ", " + std::to_string(order.axes[1]) + ", " +
                                  std::to_string(order.axes[2]));
  rotations::check_angles(angles);
  return CurveAccess::converted<Quat>(angles, [order](const Curve<Vec3>& curve, double time, Side side) {
    return from_euler(curve.sample(time, side), order);
  });
}

Curve<Quat> axis_curve(const Vec3& axis, const Curve<double>& angle) {
  const double largest = axis.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !spans::all_finite(axis))
    throw std::invalid_argument("an axis must be finite and not zero; it is " + spans::text_of(axis));
  const Vec3 scaled = axis / largest;
  const Vec3 unit = scaled / std::sqrt(scaled.squaredNorm());
  rotations::check_angles(angle);
  return CurveAccess::converted<Quat>(angle, [unit](const Curve<double>& curve, double time, Side side) {
    const Sample<double> s = curve.sample(time, side);
    const elementary::SinCos half = elementary::sin_cos(s.value / 2);
    return Sample<Quat>{Quat(half.cos, half.sin * unit.x(), half.sin * unit.y(), half.sin * unit.z()), s.rate * unit,
                        s.acceleration * unit};
  });
}

}  // namespace tweenfall
