#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "math/cross_matrix.h"
#include "rotation/rotation_series.h"

namespace tweenfall::rotations {
namespace {

Quat negated(const Quat& q) noexcept {
  return Quat(-q.w(), -q.x(), -q.y(), -q.z());
}

/// A vector whose squared length is greater is scaled before its length is computed, which would overflow.
constexpr double largest_square = 1e300;

/// A rotation vector of any finite length, taken apart.
struct FarTurn {
  Vec3 axis;
  double half;  ///< half its angle, rad: the whole angle may be too large for a number
};

FarTurn far_turn(const Vec3& rotation_vector) noexcept {
  const double largest = rotation_vector.cwiseAbs().maxCoeff();
  const Vec3 scaled = rotation_vector / largest;
  const double length = std::sqrt(scaled.squaredNorm());
  return {scaled / length, 0.5 * length * largest};
}

}  // namespace
}  // namespace tweenfall::rotations

namespace tweenfall {

Quat exp_map(const Vec3& rotation_vector) noexcept {
  const double square = rotation_vector.squaredNorm();
  if (square < rotations::series_limit) {
    const rotations::HalfTurn half = rotations::half_turn(square);
    const double k = half.sine_share;
    return Quat(half.cosine, k * rotation_vector.x(), k * rotation_vector.y(), k * rotation_vector.z());
  }
  if (!(square <= rotations::largest_square)) {
    const rotations::FarTurn turn = rotations::far_turn(rotation_vector);
    const elementary::SinCos half = elementary::sin_cos(turn.half);
    return Quat(half.cos, half.sin * turn.axis.x(), half.sin * turn.axis.y(), half.sin * turn.axis.z());
  }
  const double angle = std::sqrt(square);
  const elementary::SinCos half = elementary::sin_cos(angle / 2);
  const double k = half.sin / angle;
  return Quat(half.cos, k * rotation_vector.x(), k * rotation_vector.y(), k * rotation_vector.z());
}

Vec3 log_map(const Quat& q) noexcept {
  const double sign = q.w() < 0 ? -1 : 1;
  const Vec3 v(sign * q.x(), sign * q.y(), sign * q.z());
  const double w = sign * q.w();
  const double square = v.squaredNorm();
  if (square < 1e-10 * w * w) {
    // atan(x)/x to 1e-30; valid for vectors too small to take a square root of.
    const double z = square / (w * w);
    return (2 / w * (1 - z * (1.0 / 3 - z / 5))) * v;
  }
  const double s = std::sqrt(square);
  return (2 * elementary::atan2(s, w) / s) * v;
}

Mat3 right_jacobian(const Vec3& r) noexcept {
  const double square = r.squaredNorm();
  if (!(square <= rotations::largest_square)) {
    // Over so many turns all but the axis averages out: the rest is below 1e-149.
    const Vec3 axis = rotations::far_turn(r).axis;
    return axis * axis.transpose();
  }
  const rotations::RotationSeries c(square);
  const Mat3 k = math::cross_matrix(r);
  return Mat3::Identity() - c.a * k + c.b * (k * k);
}

Mat3 right_jacobian_inverse(const Vec3& r) noexcept {
  const Mat3 k = math::cross_matrix(r);
  return Mat3::Identity() + 0.5 * k + rotations::inverse_jacobian_coefficient(r.squaredNorm()) * (k * k);
}

Quat hemisphere_aligned(const Quat& q, const Quat& reference) noexcept {
  return q.dot(reference) < 0 ? rotations::negated(q) : q;
}

Quat slerp(const Quat& a, const Quat& b, double u) noexcept {
  if (u == 0) return a;
  if (u == 1) return b;
  const Vec3 r = log_map(a.conjugate() * b);
  return hemisphere_aligned(a * exp_map(u * r), u < 0.5 ? a : b);
}

Quat normalized(const Quat& q) {
  const Vec4& c = q.coeffs();
  const double largest = c.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(c.sum())) {
    throw std::invalid_argument("a rotation needs a finite quaternion other than zero; this one is (x " +
                                number_text(c.x()) + ", y " + number_text(c.y()) + ", z " + number_text(c.z()) +
                                ", w " + number_text(c.w()) + ")");
  }
  // Scaled first, so that squares neither overflow nor vanish; left alone when it is unit already,
  // so that normalizing twice is normalizing once.
  const double square = c.squaredNorm();
  if (std::abs(square - 1) <= 4e-16) return q;
  const Vec4 scaled = c / largest;
  const Vec4 unit = scaled / std::sqrt(scaled.squaredNorm());
  return Quat(unit.w(), unit.x(), unit.y(), unit.z());
}

Quat from_euler(const Vec3& angles, const EulerOrder& order) noexcept {
  Quat turns[3];
  for (int i = 0; i < 3; ++i) {
    const elementary::SinCos half = elementary::sin_cos(angles[i] / 2);
    Vec3 v = Vec3::Zero();
    v[order.axes[i]] = half.sin;
    turns[i] = Quat(half.cos, v.x(), v.y(), v.z());
  }
  return order.intrinsic ? turns[0] * turns[1] * turns[2] : turns[2] * turns[1] * turns[0];
}

// Source: Bernardes and Viollet, "Quaternion to Euler angles conversion: A direct, general and
// computationally efficient method", PLoS ONE 17(11), 2022.
Vec3 to_euler(const Quat& q, const EulerOrder& order) noexcept {
  constexpr double pi = 0x1.921fb54442d18p+1;
  int i = order.axes[0];
  const int j = order.axes[1];
  int k = order.axes[2];
  // The method is stated for fixed axes; turning axes are the same in reverse.
  if (order.intrinsic) std::swap(i, k);
  const bool proper = i == k;
  if (proper) k = 3 - i - j;
  const double parity = (i - j) * (j - k) * (k - i) > 0 ? 1 : -1;
  const Vec4& v = q.coeffs();
  double a = v[3], b = v[i], c = v[j], d = v[k] * parity;
  if (!proper) {
    const double a0 = a, b0 = b, c0 = c, d0 = d;
    a = a0 - c0;
    b = b0 + d0;
    c = c0 + a0;
    d = d0 - b0;
  }
  double middle = 2 * elementary::atan2(std::sqrt(c * c + d * d), std::sqrt(a * a + b * b));
  constexpr double lock = 1e-7;
  const double half_sum = elementary::atan2(b, a);
  const double half_difference = elementary::atan2(d, c);
  double first = 0, third = 0;  // about the fixed axes, in order
  const bool at_zero = middle<lock, at_pi = middle> pi - lock;
  if (at_zero || at_pi) {
    // Only the sum or the difference is defined; the angle that comes third in the caller's order is set to 0.
    const double free = at_zero ? 2 * half_sum : (order.intrinsic ? 2 : -2) * half_difference;
    (order.intrinsic ? third : first) = free;
  } else {
    first = half_sum - half_difference;
    third = half_sum + half_difference;
  }
  if (!proper) {
    third *= parity;
    middle -= pi / 2;
  }
  Vec3 angles = order.intrinsic ? Vec3(third, middle, first) : Vec3(first, middle, third);
  for (int n = 0; n < 3; ++n) {
    if (angles[n] < -pi) angles[n] += 2 * pi;
    if (angles[n] > pi) angles[n] -= 2 * pi;
  }
  return angles;
}

}  // namespace tweenfall
