#include "rotation_span.h"

#include <cmath>

#include "rotation_series.h"

namespace tweenfall {

Sample<Quat> sample_exponential(const Quat& from, const Polynomial<Vec4>& p) noexcept {
  const Vec3 r = p.value.head<3>(), d = p.first.head<3>(), dd = p.second.head<3>();
  const RotationSeries c(r.squaredNorm());
  // Body angular velocity J(r) r' = r' - a r x r' + b r x (r x r'), and its derivative by the product rule.
  const Vec3 cross = r.cross(d), cross_rate = r.cross(dd);
  const Vec3 twice = r.cross(cross);
  const Vec3 twice_rate = d.cross(cross) + r.cross(cross_rate);
  const double along = r.dot(d);
  const Vec3 velocity = d - c.a * cross + c.b * twice;
  const Vec3 acceleration = dd - (c.a1 * along) * cross - c.a * cross_rate + (c.b1 * along) * twice + c.b * twice_rate;
  const Quat q = from * exp_map(r);
  return {q, q * velocity, q * acceleration};
}

Sample<Quat> sample_normalized(const Polynomial<Vec4>& p, const Quat& fallback) noexcept {
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

}  // namespace tweenfall
