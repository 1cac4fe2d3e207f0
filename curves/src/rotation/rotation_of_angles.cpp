#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/elementary.h>

#include <stdexcept>

#include "curve/curve_data.h"

namespace tweenfall {
Curve<Quat> euler_curve(const Curve<Vec3>& angles, const EulerOrder& order) {
  for (int i = 0; i < 3; ++i)
    if (order.axes[i] < 0 || order.axes[i] > 2 || (i > 0 && order.axes[i] == order.axes[i - 1]))
      throw std::invalid_argument("the axes of Euler angles must be 0, 1 or 2 with neighbors that differ; they are " +
                                  std::to_string(order.axes[0]) + ", " + std::to_string(order.axes[1]) + ", " +
                                  std::to_string(order.axes[2]));
  return CurveAccess::converted<Quat>(angles, [order](const Curve<Vec3>& curve, double time, Side side) {
    return from_euler(curve.sample(time, side), order);
  });
}

Curve<Quat> axis_curve(const Vec3& axis, const Curve<double>& angle) {
  const double largest = axis.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !all_finite(axis))
    throw std::invalid_argument("an axis must be finite and not zero; it is " + text_of(axis));
  const Vec3 scaled = axis / largest;
  const Vec3 unit = scaled / std::sqrt(scaled.squaredNorm());
  return CurveAccess::converted<Quat>(angle, [unit](const Curve<double>& curve, double time, Side side) {
    const Sample<double> s = curve.sample(time, side);
    const elementary::SinCos half = elementary::sin_cos(s.value / 2);
    return Sample<Quat>{Quat(half.cos, half.sin * unit.x(), half.sin * unit.y(), half.sin * unit.z()), s.rate * unit,
                        s.acceleration * unit};
  });
}

}  // namespace tweenfall
