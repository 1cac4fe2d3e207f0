#include <tweenfall/anim/look_at.h>

#include "chains/angle_limit.h"
#include "chains/moving.h"
#include "chains/problems.h"

namespace tweenfall {
namespace chains {
namespace {

// The line of sight relative to the joint that turns: the eye, the direction of sight, and the up direction.
struct Sight {
  Arrow eye, forward, up;
};

// The turn that brings the line of sight onto a point `to`, `distance` away.
Turning aimed(const Sight& sight, const Measured& to) noexcept {
  // The point of the line that is as far from the joint as the target is.
  const Dual lever = dot(sight.eye, sight.forward);
  const Dual along = root(lever * lever + to.length * to.length - dot(sight.eye, sight.eye)) - lever;
  const Measured from = measured(sight.eye + along * sight.forward);
  const Arrow start = from.any ? from.unit : sight.forward;
  return arc(start, to.unit, any_across(start.v));
}

// The angle about `axis`, the line to the target, that brings the eye's up direction into the plane of the line of
// sight and the `wanted` up; reduced where that is nearly along the axis. The sideways direction of the eye, which
// turns on a cone about the axis, must become perpendicular to the wanted up.
// @param released  whether an angle near half a turn, to either side, is given up the nearer it is
Dual roll_of(const Arrow& axis, const Sight& sight, const Arrow& wanted, bool released) noexcept {
  constexpr double fade = 0.05, lets_go = 1;
  const Dual height = length(across(wanted, axis));
  if (!(height.v > 0)) return {};
  const Arrow side = cross(sight.forward, sight.up);
  const Dual still = dot(side, axis) * dot(axis, wanted), cosine = dot(across(side, axis), wanted),
             sine = dot(cross(axis, side), wanted), square = cosine * cosine + sine * sine;
  if (!(square.v > 0)) return {};
  Dual angle = angle_of(sine, cosine) + angle_of(root(square - still * still), -still);
  if (angle.v > std::numbers::pi) angle.v -= 2 * std::numbers::pi;
  if (released) {
    const Dual left = Dual(std::numbers::pi) - (angle.v < 0 ? -angle : angle);
    angle = smooth_step(Dual(1 / lets_go) * left) * angle;
  }
  return smooth_step(height / (Dual(fade) * length(wanted))) * angle;
}

}  // namespace
}  // namespace chains

LookAtChain::LookAtChain(const Hierarchy& nodes, const LookAtSettings& settings)
    : nodes_(nodes),
      forward_(settings.forward),
      up_(settings.up),
      eye_(settings.eye),
      limit_(settings.limit),
      ease_(settings.ease) {
  chains::Problems problems("look-at chain");
  problems.at({"joints"}).require(!settings.joints.empty(), "it has no joint; it needs at least the one that looks");
  std::vector<NodeRef> told;
  told.reserve(settings.joints.size());
  for (const LookAtJoint& joint : settings.joints) told.push_back(joint.node);
  const std::vector<std::size_t> found = problems.chain(nodes, told);
  joints_.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    problems.at({"joints", std::to_string(i), "share"})
        .require_in(settings.joints[i].share, 0, 1, "share of joint " + std::to_string(i + 1));
    joints_.push_back({found[i], settings.joints[i].share});
  }
  problems.at({"forward"}).require_finite(forward_, "forward");
  problems.at({"up"}).require_finite(up_, "up");
  problems.at({"eye"}).require_finite(eye_, "eye");
  problems.at({"limit"}).require_in(limit_, 0, std::numbers::pi, "limit");
  problems.at({"ease"}).require_in(ease_, 0, chains::largest, "ease");
  problems.report();
  problems.at({"forward"}).require(forward_.norm() > 0, "forward is zero");
  problems.at({"up"}).require(up_.norm() > 0, "up is zero");
  problems.report();
  forward_ = forward_ / forward_.norm();
  up_ = up_ / up_.norm();
  problems.at({"up"}).require(up_.cross(forward_).norm() > 1e-6, "up is along forward; it must be across it");
  problems.report();
  up_ = up_ - up_.dot(forward_) * forward_;
  up_ = up_ / up_.norm();
}

void look_at(const LookAtChain& chain, const LookAtGoal& goal, const Sample<double>& weight,
             std::span<Motion> pose) noexcept {
  using namespace chains;
  if (is_nothing(weight)) return;
  const Hierarchy& nodes = chain.nodes();
  const std::span<const LookAtChain::Joint> joints = chain.joints();
  const std::size_t first = joints.front().node, last = joints.back().node;
  const WorldMotion parent = above(nodes, first, pose);
  const Inward inward(parent);
  if (inward.flat()) return;

  const Vec3 still(0, 0, 0);
  const auto sight_of = [&](const Motion& looking) {
    const Turning turn = rotation_of(looking);
    const Vec3 signs = tweenfall::pose::signs_of(looking.pose.scale);
    return Sight{position_of(looking) + turn * componentwise(scale_of(looking), {chain.eye(), still}),
                 turn * Arrow{signs.cwiseProduct(chain.forward()), still},
                 turn * Arrow{signs.cwiseProduct(chain.up()), still}};
  };
  const Motion looking = first == last ? pose[last] : compose(pose[first], seen_from(nodes, first, last, pose));
  const Sight before = sight_of(looking);
  const Measured way = measured(inward.point(arrow(goal.target)) - before.eye);
  if (!way.any) return;
  const Arrow target = before.eye + way.length * within_angle(way.unit, before.forward, chain.limit(), chain.ease());
  const Arrow up = goal.up ? inward.direction(arrow(*goal.up)) : Arrow{};

  Motion carrier;  // of the joint, in the space of the chain
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::size_t node = joints[i].node;
    if (i > 0 && nodes[node].parent != joints[i - 1].node)
      carrier = compose(carrier, seen_from(nodes, joints[i - 1].node, nodes[node].parent, pose));
    const Motion here = compose(carrier, pose[node]);
    const Arrow joint = position_of(here);
    Sight sight = sight_of(node == last ? here : compose(here, seen_from(nodes, node, last, pose)));
    sight.eye = sight.eye - joint;
    const Measured to = measured(target - joint);
    Motion turned = pose[node];
    if (to.any) {
      const Turning aim = aimed(sight, to);
      const bool wholly = joints[i].share == 1;
      const Dual share(joints[i].share);
      Turning correction = wholly ? aim : exp_turn(share * log_turn(aim));
      if (goal.up) {
        const Dual roll = roll_of(to.unit, {sight.eye, aim * sight.forward, aim * sight.up}, up, !wholly);
        // A part of the turning has brought the line to the target part of its way.
        const Arrow axis = wholly ? to.unit : correction * (chains::inverse(aim) * to.unit);
        correction = exp_turn((wholly ? roll : share * roll) * axis) * correction;
      }
      const Turning outer = rotation_of(carrier);
      const Turning local = reflected_by(tweenfall::pose::reflection_of(carrier.pose.scale),
                                         chains::inverse(outer) * correction * rotation_of(here));
      turned.pose.rotation = local.v;
      turned.twist.angular = local.w;
    }
    carrier = compose(carrier, turned);
    turn_to(pose[node], rotation_of(turned), weight);
  }
}

}  // namespace tweenfall
