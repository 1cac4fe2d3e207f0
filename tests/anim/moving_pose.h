#pragma once

// Whole poses that move with known rates, and whether the rates of results are their derivatives.

#include <tweenfall/curves/pose.h>
#include <tweenfall/curves/rotation.h>

#include "support.h"

#include <vector>

namespace tweenfall::test {

inline constexpr std::size_t pose_size = 6;  ///< joints of a pose in these tests

/// A smooth function of time with a known rate.
inline Motion moving_joint(Random& random, double time) {
  const Vec3 place = random.vector(1), drift = random.vector(2), spin = random.vector(2), stretch = random.vector(0.3);
  const Quat start = random.rotation();
  Motion motion;
  motion.pose.position = place + time * drift;
  motion.pose.rotation = exp_map(time * spin) * start;
  motion.pose.scale = Vec3(1, 1.2, 0.9) + time * stretch;
  motion.twist = {drift, spin};
  motion.scale_rate = stretch;
  return motion;
}

inline std::vector<Motion> moving_pose(std::uint64_t seed, std::size_t count, double time) {
  Random random(seed);
  std::vector<Motion> pose;
  pose.reserve(count);
  for (std::size_t i = 0; i < count; ++i) pose.push_back(moving_joint(random, time));
  return pose;
}

/// The same with rotations near those of one pose, so that a mean of many is unique.
inline std::vector<Motion> moving_near(std::uint64_t seed, std::size_t count, double time) {
  std::vector<Motion> pose = moving_pose(seed, count, time);
  Random random(seed + 1000), common(4711);
  for (Motion& motion : pose) {
    const Vec3 spin = random.vector(1), away = random.vector(0.3);
    motion.pose.rotation = exp_map(time * spin) * (common.rotation() * exp_map(away));
    motion.twist.angular = spin;
  }
  return pose;
}

/// A weight that moves, 0 to 1.
inline Sample<double> moving_weight(double time, double start = 0.4) {
  return {start + 0.7 * time - 0.5 * time * time, 0.7 - time, -1};
}

/// f'(t) by differences of the sixth order: (45 (f1 - f-1) - 9 (f2 - f-2) + (f3 - f-3)) / (60 h).
template <class F>
auto slope(const F& f, double t, double h = 2e-3) {
  using V = std::decay_t<decltype(f(t))>;
  return V((45 * (f(t + h) - f(t - h)) - 9 * (f(t + 2 * h) - f(t - 2 * h)) + (f(t + 3 * h) - f(t - 3 * h))) / (60 * h));
}

/// Whether the rates of `at(t)`, a Motion, are the derivatives of its pose.
template <class At>
void check_rates(const At& at, double t, double tolerance = 1e-9, double h = 2e-3) {
  const Motion here = at(t);
  CHECK(near(here.twist.linear, slope([&](double x) { return Vec3(at(x).pose.position); }, t, h), tolerance));
  CHECK(near(here.scale_rate, slope([&](double x) { return Vec3(at(x).pose.scale); }, t, h), tolerance));
  const Quat back = here.pose.rotation.conjugate();
  CHECK(
      near(here.twist.angular, slope([&](double x) { return log_map(at(x).pose.rotation * back); }, t, h), tolerance));
}

inline bool same_bits(const Motion& a, const Motion& b) {
  return a.pose.position == b.pose.position && a.pose.rotation.coeffs() == b.pose.rotation.coeffs() &&
         a.pose.scale == b.pose.scale && a.twist.linear == b.twist.linear && a.twist.angular == b.twist.angular &&
         a.scale_rate == b.scale_rate;
}

inline bool near(const Motion& a, const Motion& b, double tolerance) {
  return near(a.pose.position, b.pose.position, tolerance) && near(a.pose.rotation, b.pose.rotation, tolerance) &&
         near(a.pose.scale, b.pose.scale, tolerance) && near(a.twist.linear, b.twist.linear, tolerance) &&
         near(a.twist.angular, b.twist.angular, tolerance) && near(a.scale_rate, b.scale_rate, tolerance);
}

}  // namespace tweenfall::test
