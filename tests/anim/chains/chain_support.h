#pragma once

// Poses that move by closed forms, and differences of high order against which returned rates are checked.

#include "support.h"

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/curves/rotation.h>

#include <string>
#include <vector>

namespace tweenfall::test {

/// A number that oscillates, with its rates.
struct Swing {
  double middle = 0, size = 0, frequency = 1, phase = 0;

  [[nodiscard]] Sample<double> at(double t) const {
    const double a = frequency * t + phase;
    return {middle + size * std::sin(a), size * frequency * std::cos(a), -size * frequency * frequency * std::sin(a)};
  }
};

struct SwingingVector {
  Swing x, y, z;

  [[nodiscard]] Sample<Vec3> at(double t) const {
    const Sample<double> a = x.at(t), b = y.at(t), c = z.at(t);
    return {{a.value, b.value, c.value}, {a.rate, b.rate, c.rate}, {a.acceleration, b.acceleration, c.acceleration}};
  }
};

inline SwingingVector swinging(Random& random, const Vec3& middle, double size) {
  const auto swing = [&](double around) {
    const double amplitude = size * random.unit(), frequency = random.between(0.5, 3), phase = random.between(0, 6);
    return Swing{around, amplitude, frequency, phase};
  };
  const Swing x = swing(middle.x()), y = swing(middle.y()), z = swing(middle.z());
  return {x, y, z};
}

/// A node that swings about a place.
struct SwingingMotion {
  SwingingVector position, turn, scale;
  Quat rest{1, 0, 0, 0};

  [[nodiscard]] Motion at(double t) const {
    const Sample<Vec3> p = position.at(t), r = turn.at(t), s = scale.at(t);
    Motion motion;
    motion.pose = {p.value, exp_map(r.value) * rest, s.value};
    motion.twist = {p.rate, right_jacobian(-r.value) * r.rate};
    motion.scale_rate = s.rate;
    return motion;
  }
};

/// All nodes of a hierarchy, swinging about their rest poses.
struct SwingingPose {
  std::vector<SwingingMotion> nodes;

  SwingingPose(Random& random, const Hierarchy& hierarchy, double moved, double turned) {
    for (const Node& node : hierarchy.nodes()) {
      SwingingMotion motion;
      motion.position = swinging(random, node.rest.position, moved);
      motion.turn = swinging(random, {0, 0, 0}, turned);
      motion.scale = {{node.rest.scale.x()}, {node.rest.scale.y()}, {node.rest.scale.z()}};
      motion.rest = node.rest.rotation;
      nodes.push_back(motion);
    }
  }

  [[nodiscard]] std::vector<Motion> at(double t) const {
    std::vector<Motion> pose;
    for (const SwingingMotion& node : nodes) pose.push_back(node.at(t));
    return pose;
  }
};

/// A chain of nodes named "0", "1", ..., each one above the other along y, the first at the origin.
inline Hierarchy straight_chain(std::size_t count, double bone = 1) {
  Hierarchy nodes;
  for (std::size_t i = 0; i < count; ++i) {
    Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
    if (i > 0) node.rest.position = {0, bone, 0};
    nodes.add(node);
  }
  return nodes;
}

inline std::vector<Motion> rest_pose(const Hierarchy& nodes) {
  std::vector<Motion> pose(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) pose[i].pose = nodes[i].rest;
  return pose;
}

inline WorldMotion world_of_node(const Hierarchy& nodes, std::size_t node, std::span<const Motion> pose) {
  return nodes.world_motion(node, [&](std::size_t i) -> const Motion& { return pose[i]; });
}

/// Derivative of `f` at `t` by central differences of eighth order.
template <class F>
auto difference(const F& f, double t, double h = 2e-3) {
  using Value = std::decay_t<decltype(f(t))>;
  constexpr double shares[] = {0.8, -0.2, 4.0 / 105, -1.0 / 280};
  Value sum = f(t) * 0;
  for (int k = 1; k <= 4; ++k) sum = Value(sum + (f(t + k * h) - f(t - k * h)) * shares[k - 1]);
  return Value(sum * (1 / h));
}

/// The largest error of the rates in the poses of `f`, against differences: relative to the larger of 1
/// and the rate.
template <class F>
double worst_rate(const F& f, double t, double h = 2e-3) {
  const std::vector<Motion> now = f(t);
  double worst = 0;
  const auto compare = [&](const Eigen::VectorXd& expected, const Eigen::VectorXd& actual) {
    worst = std::max(worst, (expected - actual).norm() / std::max(1.0, expected.norm()));
    if (!(expected - actual).allFinite()) worst = INFINITY;
  };
  for (std::size_t i = 0; i < now.size(); ++i) {
    using Numbers = Eigen::Matrix<double, 10, 1>;
    const Numbers rate = difference(
        [&](double time) -> Numbers {
          const Motion motion = f(time)[i];
          const Quat q = hemisphere_aligned(motion.pose.rotation, now[i].pose.rotation);
          Numbers numbers;
          numbers << motion.pose.position, q.coeffs(), motion.pose.scale;
          return numbers;
        },
        t, h);
    const Quat turning(rate[6], rate[3], rate[4], rate[5]);
    const Vec3 angular = 2 * (turning * now[i].pose.rotation.conjugate()).vec();
    compare(rate.head(3), now[i].twist.linear);
    compare(angular, now[i].twist.angular);
    compare(rate.tail(3), now[i].scale_rate);
  }
  return worst;
}

/// How far two poses differ: the largest of all components, rotations up to sign.
inline double difference_of(std::span<const Motion> a, std::span<const Motion> b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, (a[i].pose.position - b[i].pose.position).cwiseAbs().maxCoeff());
    const Quat q = hemisphere_aligned(b[i].pose.rotation, a[i].pose.rotation);
    worst = std::max(worst, (a[i].pose.rotation.coeffs() - q.coeffs()).cwiseAbs().maxCoeff());
    worst = std::max(worst, (a[i].pose.scale - b[i].pose.scale).cwiseAbs().maxCoeff());
  }
  return worst;
}

inline bool finite(std::span<const Motion> pose) {
  for (const Motion& motion : pose)
    if (!motion.pose.position.allFinite() || !motion.pose.rotation.coeffs().allFinite() ||
        !motion.twist.linear.allFinite() || !motion.twist.angular.allFinite())
      return false;
  return true;
}

/// The same bits in value and rate.
inline bool same_bits(std::span<const Motion> a, std::span<const Motion> b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].pose.position != b[i].pose.position || a[i].pose.rotation.coeffs() != b[i].pose.rotation.coeffs() ||
        a[i].pose.scale != b[i].pose.scale || a[i].twist.linear != b[i].twist.linear ||
        a[i].twist.angular != b[i].twist.angular || a[i].scale_rate != b[i].scale_rate)
      return false;
  return a.size() == b.size();
}

/// A target that does not move, and one that does.
inline Sample<Vec3> still(const Vec3& place) {
  return {place, {0, 0, 0}, {0, 0, 0}};
}
inline Sample<Vec3> moving(const Vec3& place, const Vec3& velocity) {
  return {place, velocity, {0, 0, 0}};
}

}  // namespace tweenfall::test
