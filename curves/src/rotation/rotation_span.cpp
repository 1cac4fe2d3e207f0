#include "rotation/rotation_span.h"

#include <cmath>

#include "rotation/moving_rotation.h"

namespace tweenfall::rotations {

Sample<Quat> sample_exponential(const Quat& from, const math::Polynomial<Vec3>& p) noexcept {
  MovingRotation turned = exponential({p.value, p.first, p.second});
  turned.value = from * turned.value;
  return outer(turned);
}

Sample<Quat> sample_normalized(const math::Polynomial<Vec4>& p, const Quat& fallback) noexcept {
  const double square = p.value.squaredNorm();
  if (!(square > 1e-200)) return {fallback, Vec3::Zero(), Vec3::Zero()};
  const Vec4 unit = p.value / std::sqrt(square);
  // Angular velocity is twice the vector part of p' p^-1.
  const auto turned = [&](const Vec4& rate) {
    const Vec3 v = p.value.head<3>(), u = rate.head<3>();
    return Vec3(2 / square * (p.value[3] * u - rate[3] * v - u.cross(v)));
  };
  const Vec3 velocity = turned(p.first);
  const Vec3 acceleration = turned(p.second) - (2 * p.value.dot(p.first) / square) * velocity;
  return {Quat(unit[3], unit[0], unit[1], unit[2]), velocity, acceleration};
}

Sample<Quat> sample_nested(const Vec4* rows, const Warp::Result& s) noexcept {
  const auto turn = [&](int i) {
    const Vec4& p = rows[i];
    const Vec3 v = rows[3 + i].head<3>();
    return MovingRotation{Quat(p[3], p[0], p[1], p[2]) * exp_map(s.s * v), s.ds * v, s.dds * v};
  };
  const auto linear = [&](double at_start, double slope) {
    return MovingWeight{at_start + slope * s.s, slope * s.ds, slope * s.dds};
  };
  const MovingRotation first = turn(0), second = turn(1), third = turn(2);
  const MovingRotation low = mixed(first, second, linear(rows[6][0], rows[6][1]));
  const MovingRotation high = mixed(second, third, linear(rows[6][2], rows[6][3]));
  const double f = rows[7][0], g = rows[7][1];
  const double slope = f + 2 * g * s.s;
  return outer(mixed(low, high, {(f + g * s.s) * s.s, slope * s.ds, 2 * g * s.ds * s.ds + slope * s.dds}));
}

Sample<Quat> spun(const Sample<Quat>& sample, const Vec3& spin, const Warp::Result& s) noexcept {
  const Quat turn = exp_map(s.s * spin);
  const Vec3 spinning = s.ds * spin, carried = turn * sample.rate;
  return {turn * sample.value, spinning + carried, s.dds * spin + spinning.cross(carried) + turn * sample.acceleration};
}

}  // namespace tweenfall::rotations
