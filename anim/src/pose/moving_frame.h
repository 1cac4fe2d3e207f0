#pragma once

// From the frame of a parent, with its rates, to that of its child: without branches, all numbers of a vector at once,
// with the instruction set of the function it is inlined into. The bits do not depend on that set.

#include <tweenfall/curves/pose.h>

namespace tweenfall::pose {

#define TWEENFALL_POSE_INLINED [[gnu::always_inline, nodiscard]] inline

// How vectors are passed to functions does not matter here: all are inlined.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// x, y and z, and an unused number.
using Lanes = double __attribute__((vector_size(32)));

TWEENFALL_POSE_INLINED Lanes all(double number) noexcept {
  return Lanes{number, number, number, number};
}

/// As `all`, for a number in memory: one instruction instead of two or three.
TWEENFALL_POSE_INLINED Lanes splat(const double& number) noexcept {
  double numbers[4];
  for (double& lane : numbers) lane = number;
  Lanes lanes;
  __builtin_memcpy(&lanes, numbers, sizeof lanes);
  return lanes;
}

/// A vector with its rate.
struct MovingColumn {
  Lanes value, rate;

  /// @param from, from_rate  three numbers each
  [[gnu::always_inline]] static MovingColumn read(const double* from, const double* from_rate) noexcept {
    return {Lanes{from[0], from[1], from[2], 0}, Lanes{from_rate[0], from_rate[1], from_rate[2], 0}};
  }
  [[gnu::always_inline]] void write(double* to, double* to_rate) const noexcept {
    for (int i = 0; i < 3; ++i) {
      to[i] = value[i];
      to_rate[i] = rate[i];
    }
  }
};

TWEENFALL_POSE_INLINED MovingColumn operator*(const MovingColumn& c, const Lanes& factor) noexcept {
  return {c.value * factor, c.rate * factor};
}

TWEENFALL_POSE_INLINED MovingColumn operator+(const MovingColumn& a, const MovingColumn& b) noexcept {
  return {a.value + b.value, a.rate + b.rate};
}

/// The axes of a space, the columns of its matrix with scale and shear, and its origin.
struct MovingFrame {
  MovingColumn axes[3], origin;
};

/// With the parent's matrix M and the child's rotation R and scale S, the child's matrix is M R S; its rate is (M' + M
/// [w]x) R S + M R S', where w is the child's angular velocity.
TWEENFALL_POSE_INLINED MovingFrame child_frame(const MovingFrame& parent, const Motion& local) noexcept {
  const MovingColumn* axes = parent.axes;

  MovingFrame child;
  const Vec3 &position = local.pose.position, &velocity = local.twist.linear;
  child.origin =
      ((axes[0] * all(position[0]) + axes[1] * all(position[1])) + axes[2] * all(position[2])) + parent.origin;
  child.origin.rate +=
      (axes[0].value * all(velocity[0]) + axes[1].value * all(velocity[1])) + axes[2].value * all(velocity[2]);

  const Vec3& spin = local.twist.angular;
  const Lanes w[3] = {all(spin[0]), all(spin[1]), all(spin[2])};
  MovingColumn spun[3];
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3, last = (i + 2) % 3;
    spun[i].value = axes[i].value;
    spun[i].rate = axes[i].rate + (axes[next].value * w[last] - axes[last].value * w[next]);
  }

  const Quat& q = local.pose.rotation;
  const double x = q.x(), y = q.y(), z = q.z(), s = q.w();
  const double x2 = x + x, y2 = y + y, z2 = z + z;
  const double sx = s * x2, sy = s * y2, sz = s * z2, xx = x * x2, xy = x * y2, xz = x * z2, yy = y * y2, yz = y * z2,
               zz = z * z2;
  const double turn[3][3] = {{1 - (yy + zz), xy + sz, xz - sy},
                             {xy - sz, 1 - (xx + zz), yz + sx},
                             {xz + sy, yz - sx, 1 - (xx + yy)}};  // its columns
  for (int i = 0; i < 3; ++i) {
    const MovingColumn turned = (spun[0] * all(turn[i][0]) + spun[1] * all(turn[i][1])) + spun[2] * all(turn[i][2]);
    child.axes[i] = turned * all(local.pose.scale[i]);
    child.axes[i].rate += turned.value * all(local.scale_rate[i]);
  }
  return child;
}

#pragma GCC diagnostic pop

}  // namespace tweenfall::pose
