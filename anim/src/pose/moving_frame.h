#pragma once

// From the points of a parent's space, and how fast they move, to those of its child's: straight on, two numbers at a
// time, which every processor of 64 bits does in one go and in which no bit depends on the compiler.

#include <tweenfall/curves/pose.h>

#include <cstring>

namespace tweenfall::pose {

using Pair = double __attribute__((vector_size(16)));

[[nodiscard]] inline Pair both(double number) noexcept {
  return Pair{number, number};
}

/// (0, a) of (a, b).
[[nodiscard]] inline Pair moved_up(Pair p) noexcept {
  return __builtin_shufflevector(Pair{0, 0}, p, 0, 2);
}

/// Three numbers that change: x and y, their rates, and z beside its rate.
struct MovingColumn {
  Pair xy, xy_rate, z;

  static MovingColumn read(const double* value, const double* rate) noexcept {
    MovingColumn column{};
    std::memcpy(&column.xy, value, sizeof(Pair));
    std::memcpy(&column.xy_rate, rate, sizeof(Pair));
    column.z = Pair{value[2], rate[2]};
    return column;
  }
  void write(double* value, double* rate) const noexcept {
    std::memcpy(value, &xy, sizeof(Pair));
    std::memcpy(rate, &xy_rate, sizeof(Pair));
    value[2] = z[0];
    rate[2] = z[1];
  }
};

[[nodiscard]] inline MovingColumn operator*(const MovingColumn& c, Pair factor) noexcept {
  return {c.xy * factor, c.xy_rate * factor, c.z * factor};
}

[[nodiscard]] inline MovingColumn operator+(const MovingColumn& a, const MovingColumn& b) noexcept {
  return {a.xy + b.xy, a.xy_rate + b.xy_rate, a.z + b.z};
}

/// The axes of a space as its matrix has them, stretched and sheared, and its origin.
struct MovingFrame {
  MovingColumn axes[3], origin;
};

/// With the parent's matrix M, and R and S the child's rotation and scale, the child's is M R S; its rate is
/// (M' + M [w]x) R S + M R S', w being the child's angular velocity.
[[nodiscard]] inline MovingFrame child_frame(const MovingFrame& parent, const Motion& local) noexcept {
  const MovingColumn* axes = parent.axes;
  const Pair z[3] = {moved_up(axes[0].z), moved_up(axes[1].z), moved_up(axes[2].z)};

  MovingFrame child;
  const Vec3 &position = local.pose.position, &velocity = local.twist.linear;
  const Pair v[3] = {both(velocity[0]), both(velocity[1]), both(velocity[2])};
  child.origin =
      ((axes[0] * both(position[0]) + axes[1] * both(position[1])) + axes[2] * both(position[2])) + parent.origin;
  child.origin.xy_rate += (axes[0].xy * v[0] + axes[1].xy * v[1]) + axes[2].xy * v[2];
  child.origin.z += (z[0] * v[0] + z[1] * v[1]) + z[2] * v[2];

  const Vec3& spin = local.twist.angular;
  const Pair w[3] = {both(spin[0]), both(spin[1]), both(spin[2])};
  MovingColumn spun[3];
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3, last = (i + 2) % 3;
    spun[i].xy = axes[i].xy;
    spun[i].xy_rate = axes[i].xy_rate + (axes[next].xy * w[last] - axes[last].xy * w[next]);
    spun[i].z = axes[i].z + (z[next] * w[last] - z[last] * w[next]);
  }

  const Quat& q = local.pose.rotation;
  const double x = q.x(), y = q.y(), zq = q.z(), s = q.w();
  const double x2 = x + x, y2 = y + y, z2 = zq + zq;
  const double sx = s * x2, sy = s * y2, sz = s * z2, xx = x * x2, xy = x * y2, xz = x * z2, yy = y * y2, yz = y * z2,
               zz = zq * z2;
  const double turn[3][3] = {{1 - (yy + zz), xy + sz, xz - sy},
                             {xy - sz, 1 - (xx + zz), yz + sx},
                             {xz + sy, yz - sx, 1 - (xx + yy)}};  // its columns
  for (int i = 0; i < 3; ++i) {
    const MovingColumn turned = (spun[0] * both(turn[i][0]) + spun[1] * both(turn[i][1])) + spun[2] * both(turn[i][2]);
    const Pair scale = both(local.pose.scale[i]), rate = both(local.scale_rate[i]);
    child.axes[i] = turned * scale;
    child.axes[i].xy_rate += turned.xy * rate;
    child.axes[i].z += moved_up(turned.z) * rate;
  }
  return child;
}

}  // namespace tweenfall::pose
