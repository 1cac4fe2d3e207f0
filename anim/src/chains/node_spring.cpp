#include <tweenfall/anim/node_spring.h>

#include "chains/problems.h"
#include "chains/spring_forcing.h"

namespace tweenfall {
namespace chains {
namespace {

std::optional<SpringFollower> spring_of(const std::optional<SpringSettings>& settings) {
  return settings ? std::optional<SpringFollower>(SpringFollower(*settings)) : std::nullopt;
}

}  // namespace
}  // namespace chains

NodeSpring::NodeSpring(const Hierarchy& nodes, const NodeSpringSettings& settings) : nodes_(nodes), node_(no_node) {
  chains::Problems problems("node spring");
  node_ = problems.node(nodes, settings.node, "node");
  problems.require(settings.position || settings.rotation, "it has neither a position nor a rotation to follow");
  problems.include([&] { position_ = chains::spring_of(settings.position); }, "position");
  problems.include([&] { rotation_ = chains::spring_of(settings.rotation); }, "rotation");
  problems.report();
}

NodeSpringState NodeSpring::at_rest(double time) const noexcept {
  NodeSpringState state;
  if (position_) state.position = position_->at_rest(time);
  if (rotation_) state.rotation = rotation_->at_rest(time);
  return state;
}

void follow(const NodeSpring& spring, NodeSpringState& state, double time, const PoseAt& pose_at,
            const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) noexcept {
  using namespace chains;
  const Hierarchy& nodes = spring.nodes();
  const auto world_at = [&](double t) {
    pose_at(t, scratch.first(nodes.size()));
    return nodes.world_motion(spring.node(), [&](std::size_t i) -> const Motion& { return scratch[i]; }).motion;
  };
  const Vec3 none(0, 0, 0);
  Arrow place, turn;
  if (spring.position())
    place = offset_at(*spring.position(), state.position, time, world_at, [&](const Motion& from, const Motion& to) {
      const SpringSettings& settings = spring.position()->settings();
      return forcing(position_of(from), position_of(to), 1 / settings.steps_per_second, settings.gravity);
    });
  if (spring.rotation())
    turn = offset_at(*spring.rotation(), state.rotation, time, world_at, [&](const Motion& from, const Motion& to) {
      const Vec3 way = log_map(to.pose.rotation * from.pose.rotation.conjugate());
      return forcing(Arrow{none, from.twist.angular}, Arrow{way, to.twist.angular},
                     1 / spring.rotation()->settings().steps_per_second, none);
    });
  if (is_nothing(weight)) return;

  const WorldMotion parent = above(nodes, spring.node(), pose);
  const Inward inward(parent);
  Motion& motion = pose[spring.node()];
  if (spring.position() && !inward.flat()) {
    const Arrow local = Dual(weight.value, weight.rate) * inward.direction(place);
    motion.pose.position += local.v;
    motion.twist.linear += local.d;
  }
  if (spring.rotation()) {
    const Turning outer = rotation_of(parent.motion);
    turn_to(motion, chains::inverse(outer) * exp_turn(turn) * outer * rotation_of(motion), weight);
  }
}

}  // namespace tweenfall
