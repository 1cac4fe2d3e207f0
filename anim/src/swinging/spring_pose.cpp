#include <tweenfall/anim/node_spring.h>
#include <tweenfall/curves/number_text.h>

#include "operations/account.h"
#include "swinging/swing.h"

#include <algorithm>

namespace tweenfall::graphs {

namespace {

class SpringyNode : public Swing<NodeSpringState> {
 public:
  SpringyNode(Changed changed, std::size_t number, double step, NodeSpring spring)
      : Swing(std::move(changed), number, step), spring_(std::move(spring)) {}

 protected:
  void rest(NodeSpringState& state) const noexcept override { state = {}; }
  void show(NodeSpringState& state, double time, const ClockSight&, const PoseAt& pose_at, const Sample<double>& weight,
            std::span<Motion> scratch, std::span<Motion> pose) const noexcept override {
    follow(spring_, state, time, pose_at, weight, scratch, pose);
  }
  void begin_again(NodeSpringState& state, double time, const ClockSight&, const PoseAt& pose_at,
                   std::span<Motion> scratch, std::span<const Motion> before,
                   std::span<const Motion> after) const noexcept override {
    state = begun_anew(spring_, state, time, pose_at, scratch, before, after);
  }

 private:
  NodeSpring spring_;
};

std::string words_of(const SpringSettings& spring) {
  return brief_text(spring.hz) + " Hz, damping " + brief_text(spring.damping);
}

void tell(const SpringSettings& spring, Account& account) {
  account.tell(spring.hz, spring.damping, spring.gravity, spring.steps_per_second);
}

}  // namespace

void tell(const SpringPose& pose, Account& account) {
  account.words = pose.node + " on a spring";
  if (pose.position) account.words += ", place " + words_of(*pose.position);
  if (pose.rotation) account.words += ", rotation " + words_of(*pose.rotation);
  account.words += share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.node, pose.position.has_value(), pose.rotation.has_value(), pose.weight);
  if (pose.position) tell(*pose.position, account);
  if (pose.rotation) tell(*pose.rotation, account);
}

std::unique_ptr<Operation> bound(const SpringPose& described, Binder& binder) {
  Changed changed = bound_change(described, "spring", binder);
  const std::size_t node = binder.node(described.node, {"spring", "node"});
  if (node == no_node) return nullptr;
  std::optional<NodeSpring> spring;
  binder.attempt({"spring"}, [&] {
    spring.emplace(binder.nodes(), NodeSpringSettings{node, described.position, described.rotation});
  });
  if (!spring || !changed.whole) return nullptr;
  binder.moves(node);
  double step = 0;
  for (const std::optional<SpringSettings>& each : {described.position, described.rotation})
    if (each) step = std::max(step, 1 / each->steps_per_second);
  auto operation = std::make_unique<SpringyNode>(std::move(changed), binder.new_swing(step), step, *std::move(spring));
  operation->set_rooms(SpringyNode::own_rooms);
  return operation;
}

}  // namespace tweenfall::graphs
