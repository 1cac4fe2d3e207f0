#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>

#include "rotation/moving_rotation.h"

namespace tweenfall {

Sample<Quat> from_euler(const Sample<Vec3>& angles, const EulerOrder& order) noexcept {
  Quat q(1, 0, 0, 0);
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero();
  // From the outermost turn inward, each about an axis that the turns before it carry along.
  for (int n = 0; n < 3; ++n) {
    const int i = order.intrinsic ? n : 2 - n;
    const Vec3 axis = Vec3::Unit(order.axes[i]);
    const Vec3 carried = q * axis;
    acceleration += angles.acceleration[i] * carried + angles.rate[i] * velocity.cross(carried);
    velocity += angles.rate[i] * carried;
    const elementary::SinCos half = elementary::sin_cos(angles.value[i] / 2);
    q = q * Quat(half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z());
  }
  return {q, velocity, acceleration};
}

Sample<Vec3> to_euler(const Sample<Quat>& rotation, const EulerOrder& order) noexcept {
  const Vec3 angles = to_euler(rotation.value, order);
  // The columns are the axes that the three angles turn about: velocity = axes * rates. The moving axes add to the
  // acceleration what it would be for angles without acceleration.
  Mat3 axes;
  for (int i = 0; i < 3; ++i) axes.col(i) = from_euler(Sample<Vec3>{angles, Vec3::Unit(i), Vec3::Zero()}, order).rate;
  const double volume = axes.determinant();
  if (!(std::abs(volume) > 1e-9)) {
    const Vec3 first = axes.col(0), second = axes.col(1);
    const auto parts = [&](const Vec3& v) { return Vec3(first.dot(v), second.dot(v), 0); };
    return {angles, parts(rotation.rate), parts(rotation.acceleration)};
  }
  const Mat3 inverse = axes.inverse();
  const Vec3 rates = inverse * rotation.rate;
  const Vec3 carried = from_euler(Sample<Vec3>{angles, rates, Vec3::Zero()}, order).acceleration;
  return {angles, rates, inverse * Vec3(rotation.acceleration - carried)};
}

Sample<Quat> product(const Sample<Quat>& a, const Sample<Quat>& b) noexcept {
  const Vec3 carried = a.value * b.rate;
  return {a.value * b.value, a.rate + carried, a.acceleration + a.value * b.acceleration + a.rate.cross(carried)};
}

// From 0 = product(q, inverse(q)): the inverse turns against q, seen in its own axes.
Sample<Quat> inverse(const Sample<Quat>& q) noexcept {
  const Quat back = q.value.conjugate();
  return {back, -(back * q.rate), -(back * q.acceleration)};
}

Sample<Quat> slerp(const Sample<Quat>& a, const Sample<Quat>& b, const Sample<double>& weight) noexcept {
  Sample<Quat> near = b;
  near.value = hemisphere_aligned(b.value, a.value);
  return rotations::outer(
      rotations::mixed(rotations::inner(a), rotations::inner(near), {weight.value, weight.rate, weight.acceleration}));
}

}  // namespace tweenfall
