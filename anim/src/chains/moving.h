#pragma once

// Numbers, vectors and rotations that move: each with its rate, so that results computed from them have exact rates.

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/reflection.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <type_traits>

// Small functions are always inlined: a solve is a few hundred operations, and calls would take half of its time.

namespace tweenfall::chains {

/// A number and its rate.
struct Dual {
  double v = 0, d = 0;

  constexpr Dual() = default;
  constexpr Dual(double value, double rate = 0) : v(value), d(rate) {}
};

[[gnu::always_inline]] inline Dual operator+(const Dual& a, const Dual& b) noexcept {
  return {a.v + b.v, a.d + b.d};
}
[[gnu::always_inline]] inline Dual operator-(const Dual& a, const Dual& b) noexcept {
  return {a.v - b.v, a.d - b.d};
}
[[gnu::always_inline]] inline Dual operator-(const Dual& a) noexcept {
  return {-a.v, -a.d};
}
[[gnu::always_inline]] inline Dual operator*(const Dual& a, const Dual& b) noexcept {
  return {a.v * b.v, a.d * b.v + a.v * b.d};
}
[[gnu::always_inline]] inline Dual operator/(const Dual& a, const Dual& b) noexcept {
  const double i = 1 / b.v, q = a.v * i;
  return {q, (a.d - q * b.d) * i};
}
[[gnu::always_inline]] inline Dual operator*(const Dual& a, double b) noexcept {
  return {a.v * b, a.d * b};
}
[[gnu::always_inline]] inline Dual operator*(double a, const Dual& b) noexcept {
  return {a * b.v, a * b.d};
}
/// Square root; 0 at rest for numbers that are not positive.
[[gnu::always_inline]] inline Dual root(const Dual& a) noexcept {
  if (!(a.v > 0)) return {};
  const double r = std::sqrt(a.v);
  return {r, a.d / (2 * r)};
}
inline Dual exponential(const Dual& a) noexcept {
  const double e = elementary::exp(a.v);
  return {e, e * a.d};
}
inline Dual angle_of(const Dual& y, const Dual& x) noexcept {
  const double square = x.v * x.v + y.v * y.v;
  return {elementary::atan2(y.v, x.v), square > 0 ? (x.v * y.d - y.v * x.d) / square : 0};
}
/// From 0 at x <= 0 to 1 at x >= 1, with a slope of 0 at both.
inline Dual smooth_step(const Dual& x) noexcept {
  if (!(x.v > 0)) return {};
  if (x.v >= 1) return {1};
  return {x.v * x.v * (3 - 2 * x.v), 6 * x.v * (1 - x.v) * x.d};
}

/// A vector and its rate.
struct Arrow {
  Vec3 v{0, 0, 0}, d{0, 0, 0};
};

[[gnu::always_inline]] inline Arrow operator+(const Arrow& a, const Arrow& b) noexcept {
  return {a.v + b.v, a.d + b.d};
}
[[gnu::always_inline]] inline Arrow operator-(const Arrow& a, const Arrow& b) noexcept {
  return {a.v - b.v, a.d - b.d};
}
[[gnu::always_inline]] inline Arrow operator-(const Arrow& a) noexcept {
  return {-a.v, -a.d};
}
[[gnu::always_inline]] inline Arrow operator*(const Dual& s, const Arrow& a) noexcept {
  return {s.v * a.v, s.d * a.v + s.v * a.d};
}
[[gnu::always_inline]] inline Dual dot(const Arrow& a, const Arrow& b) noexcept {
  return {a.v.dot(b.v), a.d.dot(b.v) + a.v.dot(b.d)};
}
[[gnu::always_inline]] inline Arrow cross(const Arrow& a, const Arrow& b) noexcept {
  return {a.v.cross(b.v), a.d.cross(b.v) + a.v.cross(b.d)};
}
[[gnu::always_inline]] inline Dual length(const Arrow& a) noexcept {
  const double l = std::sqrt(a.v.squaredNorm());
  return {l, l > 0 ? a.v.dot(a.d) / l : 0};
}
/// a / l, l being its length and not 0.
[[gnu::always_inline]] inline Arrow unit(const Arrow& a, const Dual& l) noexcept {
  const double i = 1 / l.v;
  const Vec3 u = i * a.v;
  return {u, i * (a.d - l.d * u)};
}
[[gnu::always_inline]] inline Arrow unit(const Arrow& a) noexcept {
  return unit(a, length(a));
}
// Vectors at rest are used without rates, where that saves time.
template <std::same_as<Dual> Number>
[[gnu::always_inline]] inline Arrow operator*(const Number& s, const Vec3& a) noexcept {
  return {s.v * a, s.d * a};
}
[[gnu::always_inline]] inline Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return a.cross(b);
}

/// A vector's length and direction, at once.
struct Measured {
  Arrow unit;
  Dual length;
  bool any = false;  ///< whether it has a direction
};
[[gnu::always_inline]] inline Measured measured(const Arrow& a) noexcept {
  const double l = std::sqrt(a.v.squaredNorm());
  if (!(l > 0)) return {};
  const double i = 1 / l;
  const Vec3 u = i * a.v;
  const double rate = u.dot(a.d);
  return {{u, i * (a.d - rate * u)}, {l, rate}, true};
}
/// The part of `a` perpendicular to the unit vector `along`.
[[gnu::always_inline]] inline Arrow across(const Arrow& a, const Arrow& along) noexcept {
  return a - dot(a, along) * along;
}
[[gnu::always_inline]] inline Arrow componentwise(const Arrow& a, const Arrow& b) noexcept {
  return {a.v.cwiseProduct(b.v), a.d.cwiseProduct(b.v) + a.v.cwiseProduct(b.d)};
}

/// A unit vector perpendicular to the unit vector `u`, at rest.
inline Vec3 any_across(const Vec3& u) noexcept {
  const double x = std::abs(u.x()), y = std::abs(u.y()), z = std::abs(u.z());
  const Vec3 least = x <= y && x <= z ? Vec3(1, 0, 0) : y <= z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 c = u.cross(least);
  return c / std::sqrt(c.squaredNorm());
}

/// A rotation and its angular velocity, about the axes of the space that it maps into.
struct Turning {
  Quat v{1, 0, 0, 0};
  Vec3 w{0, 0, 0};
};

/// a b, of unit length again.
[[gnu::always_inline]] inline Turning operator*(const Turning& a, const Turning& b) noexcept {
  Quat q = a.v * b.v;
  q.coeffs() *= 1.5 - 0.5 * q.squaredNorm();
  return {q, a.w + a.v * b.w};
}
[[gnu::always_inline]] inline Turning inverse(const Turning& a) noexcept {
  const Quat back = a.v.conjugate();
  return {back, -(back * a.w)};
}
[[gnu::always_inline]] inline Arrow operator*(const Turning& a, const Arrow& u) noexcept {
  const Vec3 turned = a.v * u.v;
  return {turned, a.w.cross(turned) + a.v * u.d};
}
inline Turning exp_turn(const Arrow& r) noexcept {
  return {exp_map(r.v), right_jacobian(-r.v) * r.d};
}
inline Arrow log_turn(const Turning& q) noexcept {
  const Vec3 r = log_map(q.v);
  return {r, right_jacobian_inverse(-r) * q.w};
}

/// The shortest rotation from unit `u` to unit `v`; where they are opposite, by half a turn about `axis`, a unit vector
/// perpendicular to them. With x = u x v and c = u . v, the quaternion is along (1 + c, x).
[[gnu::always_inline]] inline Turning arc(const Arrow& u, const Arrow& v, const Vec3& axis) noexcept {
  const Arrow x = cross(u, v);
  const Dual c = dot(u, v);
  const double s = 1 + c.v;
  if (s < 1e-14) return {Quat(0, axis.x(), axis.y(), axis.z()), Vec3(0, 0, 0)};
  const double i = 1 / std::sqrt(s * s + x.v.squaredNorm());
  Turning turn;
  turn.v = Quat(s * i, x.v.x() * i, x.v.y() * i, x.v.z() * i);
  turn.w = (s * x.d - c.d * x.v + x.v.cross(x.d)) * (2 * i * i);
  return turn;
}

/// Three unit vectors at right angles to each other, of a type that moves or is at rest.
template <class Vector>
struct Axes {
  Vector x, y, z;
};

/// @param x, y  unit, at right angles
template <class Vector>
[[gnu::always_inline]] inline Axes<Vector> axes(const Vector& x, const Vector& y) noexcept {
  return {x, y, cross(x, y)};
}

[[gnu::always_inline]] inline const Vec3& place_of(const Arrow& a) noexcept {
  return a.v;
}
[[gnu::always_inline]] inline const Vec3& place_of(const Vec3& a) noexcept {
  return a;
}
[[gnu::always_inline]] inline Vec3 spin_of(const Axes<Arrow>& a) noexcept {
  return a.x.v.cross(a.x.d) + a.y.d.dot(a.z.v) * a.x.v;
}

/// The rotation from `a` to `b`.
/// Source of the quaternion: Shepperd, "Quaternion from rotation matrix", 1978.
[[gnu::always_inline]] inline Quat rotation_between(const Axes<Vec3>& a, const Axes<Vec3>& b) noexcept {
  double m[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = b.x[i] * a.x[j] + b.y[i] * a.y[j] + b.z[i] * a.z[j];
  const double trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) {
    const double square = 1 + trace, r = std::sqrt(square), s = r * (0.5 / square);
    return Quat(0.5 * r, (m[2][1] - m[1][2]) * s, (m[0][2] - m[2][0]) * s, (m[1][0] - m[0][1]) * s);
  }
  const int i = m[0][0] >= m[1][1] ? (m[0][0] >= m[2][2] ? 0 : 2) : (m[1][1] >= m[2][2] ? 1 : 2);
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const double r = std::sqrt(std::max(0.0, 1 + m[i][i] - m[j][j] - m[k][k])), s = 0.5 / r;
  Vec3 part;
  part[i] = 0.5 * r;
  part[j] = (m[j][i] + m[i][j]) * s;
  part[k] = (m[k][i] + m[i][k]) * s;
  return Quat((m[k][j] - m[j][k]) * s, part.x(), part.y(), part.z());
}

[[gnu::always_inline]] inline Turning rotation_of(const Motion& motion) noexcept {
  return {motion.pose.rotation, motion.twist.angular};
}
[[gnu::always_inline]] inline Arrow position_of(const Motion& motion) noexcept {
  return {motion.pose.position, motion.twist.linear};
}
[[gnu::always_inline]] inline Arrow scale_of(const Motion& motion) noexcept {
  return {motion.pose.scale, motion.scale_rate};
}
[[gnu::always_inline]] inline Arrow arrow(const Sample<Vec3>& sample) noexcept {
  return {sample.value, sample.rate};
}

/// A turning in the axes that a reflection mirrors, see `pose::reflection_of`.
[[gnu::always_inline]] inline Turning reflected_by(const Vec3& reflection, const Turning& a) noexcept {
  return {pose::reflected_by(reflection, a.v), reflection.cwiseProduct(a.w)};
}

/// The rotation of a local motion replaced; a weight of 0 leaves it as it is and 1 puts `to` there, bit for bit.
[[gnu::always_inline]] inline void turn_to(Motion& motion, const Turning& to, const Sample<double>& weight) noexcept {
  if (weight.value == 1 && weight.rate == 0) {
    motion.pose.rotation = to.v;
    motion.twist.angular = to.w;
    return;
  }
  const Turning from = rotation_of(motion);
  const Arrow way = log_turn(to * inverse(from));
  const Turning blended = exp_turn(Dual(weight.value, weight.rate) * way) * from;
  motion.pose.rotation = blended.v;
  motion.twist.angular = blended.w;
}

/// Whether the weight is 0 and stays so.
inline bool is_nothing(const Sample<double>& weight) noexcept {
  return weight.value == 0 && weight.rate == 0;
}

/// Converts points and directions from the world into a node's own space.
class Inward {
 public:
  /// @param world  which must outlive it
  explicit Inward(const WorldMotion& world) noexcept : world_(world) {
    const Vec3 a = world.linear.col(0), b = world.linear.col(1), c = world.linear.col(2);
    const Vec3 bc = b.cross(c);
    const double volume = a.dot(bc);
    inverse_ = 1 / volume;
    back_[0] = bc;
    back_[1] = c.cross(a);
    back_[2] = a.cross(b);
    const double box = a.squaredNorm() * b.squaredNorm() * c.squaredNorm();
    flat_ = !(volume * volume > 1e-60 * box) || !std::isfinite(inverse_);
  }

  explicit Inward(const WorldMotion&&) = delete;

  /// Whether the space cannot be inverted, because a scale is 0.
  [[nodiscard]] bool flat() const noexcept { return flat_; }

  [[gnu::always_inline, nodiscard]] Arrow point(const Arrow& world) const noexcept {
    return direction({world.v - world_.motion.pose.position, world.d - world_.motion.twist.linear});
  }
  [[gnu::always_inline, nodiscard]] Arrow direction(const Arrow& world) const noexcept {
    const Vec3 v = turned(world.v);
    return {v, turned(world.d - world_.linear_rate * v)};
  }

 private:
  [[gnu::always_inline, nodiscard]] Vec3 turned(const Vec3& v) const noexcept {
    return {inverse_ * back_[0].dot(v), inverse_ * back_[1].dot(v), inverse_ * back_[2].dot(v)};
  }

  const WorldMotion& world_;
  double inverse_;  // of the matrix's determinant
  Vec3 back_[3];    // rows of its inverse, multiplied by the determinant
  bool flat_;
};

/// World motion of the parent of a node; the identity for a root.
inline WorldMotion above(const Hierarchy& nodes, std::size_t node, std::span<const Motion> pose) noexcept {
  const std::size_t parent = nodes[node].parent;
  if (parent == no_node) return {};
  return nodes.world_motion(parent, [&](std::size_t i) -> const Motion& { return pose[i]; });
}

/// Motion of a node in the world, `no_node` for the world itself.
inline Motion in_world(const Hierarchy& nodes, std::size_t node, std::span<const Motion> pose) noexcept {
  if (node == no_node) return {};
  return nodes.world_motion(node, [&](std::size_t i) -> const Motion& { return pose[i]; }).motion;
}

/// Motion of `node` in the space of `top`, which is above it.
inline Motion seen_from(const Hierarchy& nodes, std::size_t top, std::size_t node,
                        std::span<const Motion> pose) noexcept {
  Motion motion = pose[node];
  for (std::size_t i = nodes[node].parent; i != top; i = nodes[i].parent) motion = compose(pose[i], motion);
  return motion;
}

}  // namespace tweenfall::chains
