#include <tweenfall/anim/mirror.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "chains/problems.h"
#include "pose/name_patterns.h"
#include "pose/rest.h"

namespace tweenfall {

namespace pose {
namespace {

Vec3 reflected(const Vec3& v, const Vec3& normal) noexcept {
  return v - (2 * normal.dot(v)) * normal;
}

// Reflects the axis of a turn: the reflected turn goes the other way.
Vec3 reflected_turn(const Vec3& v, const Vec3& normal) noexcept {
  return (2 * normal.dot(v)) * normal - v;
}

Quat reflected(const Quat& q, const Vec3& normal) noexcept {
  const Vec3 v = reflected_turn(q.vec(), normal);
  return {q.w(), v[0], v[1], v[2]};
}

/// The partner of each joint, and the pair that says so: `no_node` where none does.
struct Partners {
  std::vector<std::size_t> of, by_pair;

  Partners(const Hierarchy& nodes, std::span<const MirrorPair> pairs, std::vector<chains::Problem>& problems)
      : of(nodes.size(), no_node), by_pair(nodes.size(), no_node) {
    for (std::size_t i = 0; i < pairs.size(); ++i) add(nodes, pairs[i], i, problems);
    for (std::size_t i = 0; i < of.size(); ++i)
      if (of[i] == no_node) of[i] = i;
  }

 private:
  void add(const Hierarchy& nodes, const MirrorPair& pair, std::size_t number, std::vector<chains::Problem>& problems) {
    const auto fault = [&](std::string text) {
      problems.push_back({{"pairs", std::to_string(number)}, std::move(text)});
    };
    if (stars_in(pair.left) != stars_in(pair.right))
      return fault("\"" + pair.left + "\" and \"" + pair.right + "\" must have the same number of *");
    bool any = false;
    const auto meet_all = [&](const std::string& from, const std::string& to) {
      const std::optional<std::size_t> alone = stars_in(from) == 0 ? nodes.find(from) : std::nullopt;
      const std::size_t end = alone ? *alone + 1 : stars_in(from) == 0 ? 0 : nodes.size();
      for (std::size_t i = alone.value_or(0); i < end; ++i) {
        const std::optional<std::string> name = renamed(nodes[i].name, from, to);
        if (!name) continue;
        any = true;
        const auto other = nodes.find(*name);
        if (!other) {
          fault("\"" + nodes[i].name + "\" has no partner, for there is no \"" + *name + "\"");
        } else if (of[i] == no_node) {
          of[i] = *other;
          by_pair[i] = number;
        } else if (of[i] != *other) {
          fault("\"" + nodes[i].name + "\" has two partners, \"" + nodes[of[i]].name + "\" and \"" +
                nodes[*other].name + "\"");
        }
      }
    };
    meet_all(pair.left, pair.right);
    meet_all(pair.right, pair.left);
    if (!any) fault("no joint matches \"" + pair.left + "\" or \"" + pair.right + "\"");
  }
};

using AxisOrder = std::array<int, 3>;

// For each axis of a joint the nearest of its partner's axes, no two the same.
// @param seen  row by row the axes of the joint in the mirrored axes of its partner
// @param own_partner whether the joint is its own partner: then two axes may only be exchanged
AxisOrder nearest_axes(const Mat3& seen, bool own_partner) noexcept {
  constexpr std::array<AxisOrder, 6> orders{{{0, 1, 2}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}}};
  AxisOrder nearest = orders[0];
  double most = -1;
  for (std::size_t i = 0; i < (own_partner ? 4 : orders.size()); ++i) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += tidied(std::pow(seen(axis, orders[i][axis]), 2));
    if (!(sum > most)) continue;
    most = sum;
    nearest = orders[i];
  }
  return nearest;
}

AxisOrder inverse(const AxisOrder& order) noexcept {
  AxisOrder result{};
  for (int axis = 0; axis < 3; ++axis) result[order[axis]] = axis;
  return result;
}

}  // namespace
}  // namespace pose

std::vector<MirrorPair> usual_sides(const Hierarchy& nodes) {
  static const MirrorPair usual[]{
      {"*.L", "*.R"},        {"*.l", "*.r"},        {"*_L", "*_R"},     {"*_l", "*_r"},     {"*-L", "*-R"},
      {"*.L.*", "*.R.*"},    {"*.l.*", "*.r.*"},    {"*.L_*", "*.R_*"}, {"*.L#*", "*.R#*"}, {"*_L_*", "*_R_*"},
      {"*_l_*", "*_r_*"},    {"L_*", "R_*"},        {"l_*", "r_*"},     {"* L *", "* R *"}, {"*Left*", "*Right*"},
      {"*left*", "*right*"}, {"*LEFT*", "*RIGHT*"},
  };
  std::vector<MirrorPair> sides;
  for (const MirrorPair& pair : usual) {
    bool any = false, all = true;
    for (const Node& node : nodes.nodes()) {
      auto other = pose::renamed(node.name, pair.left, pair.right);
      if (!other) other = pose::renamed(node.name, pair.right, pair.left);
      if (!other) continue;
      const bool found = nodes.find(*other).has_value();
      any |= found;
      all &= found;
    }
    if (any && all) sides.push_back(pair);
  }
  return sides;
}

Mirror::Mirror(const Hierarchy& nodes, std::span<const MirrorPair> pairs, const Vec3& normal,
               std::span<const Pose> stance)
    : normal_(normal) {
  std::vector<chains::Problem> problems;
  if (!stance.empty() && stance.size() != nodes.size())
    problems.push_back({{"stance"},
                        "its stance needs a pose for each of the " + std::to_string(nodes.size()) + " joints; it has " +
                            std::to_string(stance.size())});
  const double largest = normal.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(normal.sum()))
    problems.push_back({{"normal"}, "the normal of its plane must have a length, and be finite"});
  else
    normal_ = Vec3(normal / largest) / std::sqrt(Vec3(normal / largest).squaredNorm());

  const std::size_t sound = problems.size();
  const pose::Partners paired(nodes, pairs, problems);
  const std::vector<std::size_t>& partners = paired.of;
  const bool paired_well = problems.size() == sound;
  for (std::size_t i = 0; i < nodes.size() && paired_well; ++i) {
    const std::size_t parent = nodes[i].parent, other = nodes[partners[i]].parent;
    const bool fits = parent == no_node || other == no_node ? parent == other : partners[parent] == other;
    if (fits || partners[i] < i) continue;
    const auto name = [&](std::size_t node) {
      return node == no_node ? std::string("no joint") : "\"" + nodes[node].name + "\"";
    };
    // A joint that no pair names is between the sides, where its parents should be.
    const std::size_t pair =
        paired.by_pair[i] != no_node || parent == no_node ? paired.by_pair[i] : paired.by_pair[parent];
    problems.push_back({pair == no_node ? chains::Member() : chains::Member{"pairs", std::to_string(pair)},
                        name(i) + " is below " + name(parent) + " and its partner " + name(partners[i]) + " below " +
                            name(other) + ", which are not partners"});
  }
  if (!problems.empty()) throw chains::Unfit("a mirror does not fit its joints:", std::move(problems));

  // In the figure's space, a joint is turned from rest by D = R B^-1, where R is its rotation and B that at rest. It
  // must get the mirror image m(D') of its partner's turn. With the same for the parents, its local rotation is (Bp^-1
  // m(Bp')) m(q') (m(B')^-1 B), where q is a local rotation, Bp the parent's rotation at rest, and ' marks those of the
  // partner.
  const std::vector<Pose> rest = pose::figure_poses(nodes, stance);
  joints_.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Joint& joint = joints_[i];
    joint.partner = partners[i];
    const std::size_t parent = nodes[i].parent, other = nodes[joint.partner].parent;
    if (parent != no_node)
      joint.before =
          pose::tidied(Quat(rest[parent].rotation.conjugate() * pose::reflected(rest[other].rotation, normal_)));
    joint.after =
        pose::tidied(Quat(pose::reflected(rest[joint.partner].rotation, normal_).conjugate() * rest[i].rotation));

    if (parent != no_node) {
      joint.own_signs = pose::signs_of(rest[parent].scale);
      joint.partner_signs = pose::signs_of(rest[other].scale);
    }
    const Pose &own = stance.empty() ? nodes[i].rest : stance[i],
               &theirs = stance.empty() ? nodes[joint.partner].rest : stance[joint.partner];
    joint.offset = own.position - mirrored_way(joint, theirs.position);
    const double size = std::max(own.position.cwiseAbs().maxCoeff(), theirs.position.cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k)
      if (std::abs(joint.offset[k]) <= 1e-12 * size) joint.offset[k] = 0;

    if (joint.partner < i) {
      joint.axes = pose::inverse(joints_[joint.partner].axes);
    } else {
      Mat3 seen;
      for (int axis = 0; axis < 3; ++axis)
        seen.row(axis) = pose::reflected(Vec3(joint.after * Vec3(Mat3::Identity().col(axis))), normal_);
      joint.axes = pose::nearest_axes(seen, joint.partner == i);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double at_rest = theirs.scale[joint.axes[axis]], ratio = at_rest == 0 ? 1 : own.scale[axis] / at_rest;
      if (ratio != 0) joint.sizes[axis] = pose::tidied(ratio);
    }
  }
}

Vec3 Mirror::mirrored_way(const Joint& joint, const Vec3& way) const noexcept {
  return joint.own_signs.cwiseProduct(joint.before *
                                      pose::reflected(Vec3(joint.partner_signs.cwiseProduct(way)), normal_));
}

Motion Mirror::mirrored(const Joint& joint, const Motion& partner) const noexcept {
  // What hangs below scales that mirror is turned the other way round there.
  const Vec3 own = pose::reflection_of(joint.own_signs), theirs = pose::reflection_of(joint.partner_signs);
  const auto along_axes = [&](const Vec3& scale) -> Vec3 {
    return joint.sizes.cwiseProduct(Vec3(scale[joint.axes[0]], scale[joint.axes[1]], scale[joint.axes[2]]));
  };
  Motion result;
  result.pose.position = mirrored_way(joint, partner.pose.position) + joint.offset;
  result.pose.rotation = pose::reflected_by(
      own, joint.before * pose::reflected(pose::reflected_by(theirs, partner.pose.rotation), normal_) * joint.after);
  result.pose.scale = along_axes(partner.pose.scale);
  result.twist.linear = mirrored_way(joint, partner.twist.linear);
  result.twist.angular =
      own.cwiseProduct(joint.before * pose::reflected_turn(Vec3(theirs.cwiseProduct(partner.twist.angular)), normal_));
  result.scale_rate = along_axes(partner.scale_rate);
  return result;
}

void Mirror::apply(std::span<const Motion> pose, std::span<Motion> out) const noexcept {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const std::size_t other = joints_[i].partner;
    if (other < i) continue;
    const Motion here = mirrored(joints_[i], pose[other]);
    if (other != i) out[other] = mirrored(joints_[other], pose[i]);
    out[i] = here;
  }
}

}  // namespace tweenfall
