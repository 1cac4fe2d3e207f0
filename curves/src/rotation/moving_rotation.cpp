#include "rotation/moving_rotation.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>

#include "rotation/rotation_series.h"

namespace tweenfall::rotations {

MovingRotation inner(const Sample<Quat>& sample) noexcept {
  const Quat back = sample.value.conjugate();
  return {sample.value, back * sample.rate, back * sample.acceleration};
}

Sample<Quat> outer(const MovingRotation& moving) noexcept {
  return {moving.value, moving.value * moving.velocity, moving.value * moving.acceleration};
}

// Angular velocity J(r) r' = r' - a r x r' + b r x (r x r'), and its derivative by the product rule.
MovingRotation exponential(const MovingVector& m) noexcept {
  const Vec3 &r = m.value, &d = m.first, &dd = m.second;
  const RotationSeries c(r.squaredNorm());
  const Vec3 cross = r.cross(d), cross_rate = r.cross(dd);
  const Vec3 twice = r.cross(cross);
  const Vec3 twice_rate = d.cross(cross) + r.cross(cross_rate);
  const double along = r.dot(d);
  const Vec3 velocity = d - c.a * cross + c.b * twice;
  const Vec3 acceleration = dd - (c.a1 * along) * cross - c.a * cross_rate + (c.b1 * along) * twice + c.b * twice_rate;
  return {exp_map(r), velocity, acceleration};
}

TurningRotation exponential(const Vec3& r, const Vec3& d) noexcept {
  const double square = r.squaredNorm();
  const Vec3 cross = r.cross(d), twice = r.cross(cross);
  if (square < series_limit) return {exp_map(r), d - series_a(square) * cross + series_b(square) * twice};
  const RotationSeries c(square);
  return {exp_map(r), d - c.a * cross + c.b * twice};
}

Vec3 bent_acceleration(const Vec3& r, const Vec3& first) noexcept {
  return exponential({r, first, Vec3(0, 0, 0)}).acceleration;
}

Vec3 signed_log(const Quat& q) noexcept {
  if (!(q.w() < 0)) return log_map(q);
  const Vec3 v = q.vec();
  const double s = std::sqrt(v.squaredNorm());
  if (!(s > 0)) return {0, 0, 0};
  return (2 * elementary::atan2(s, q.w()) / s) * v;
}

MovingVector signed_log(const MovingRotation& q) noexcept {
  const Vec3 r = signed_log(q.value);
  constexpr double whole_turn = 0x1.921fb54442d18p+2;
  if (!(r.squaredNorm() < (whole_turn - 1e-9) * (whole_turn - 1e-9))) return {r, {0, 0, 0}, {0, 0, 0}};
  const Mat3 inverse = right_jacobian_inverse(r);
  const Vec3 first = inverse * q.velocity;
  return {r, first, inverse * Vec3(q.acceleration - bent_acceleration(r, first))};
}

MovingRotation product(const MovingRotation& a, const MovingRotation& b) noexcept {
  const Quat back = b.value.conjugate();
  const Vec3 carried = back * a.velocity;
  return {a.value * b.value, carried + b.velocity, back * a.acceleration - b.velocity.cross(carried) + b.acceleration};
}

MovingRotation quotient(const MovingRotation& a, const MovingRotation& b) noexcept {
  const Quat between = a.value.conjugate() * b.value;
  const Quat back = between.conjugate();
  const Vec3 carried = back * a.velocity;
  const Vec3 velocity = b.velocity - carried;
  return {between, velocity, b.acceleration - back * a.acceleration + velocity.cross(carried)};
}

MovingRotation mixed(const MovingRotation& a, const MovingRotation& b, const MovingWeight& w) noexcept {
  if (w.first == 0 && w.second == 0) {
    if (w.value == 0) return a;
    if (w.value == 1) return b;
  }
  const MovingVector r = signed_log(quotient(a, b));
  return product(a, exponential({w.value * r.value, w.first * r.value + w.value * r.first,
                                 w.second * r.value + 2 * w.first * r.first + w.value * r.second}));
}

}  // namespace tweenfall::rotations
