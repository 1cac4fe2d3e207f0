#include <tweenfall/anim/joint_chain.h>

#include "limbs/place.h"
#include "operations/account.h"

namespace tweenfall::graphs {

namespace {

class Reaching : public Changing {
 public:
  Reaching(Changed changed, JointChain chain, BoundPlace target)
      : Changing(std::move(changed)), chain_(std::move(chain)), target_(std::move(target)) {}

 protected:
  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch&,
              std::span<Motion> pose) const noexcept override {
    reach(chain_, target_.sample(log, moment, chain_.nodes(), pose), weight, pose);
  }

 private:
  JointChain chain_;
  BoundPlace target_;
};

}  // namespace

void tell(const ReachPose& pose, Account& account) {
  account.words = (pose.joints.empty() ? std::string("reach") : pose.joints.back().node + " reaches") + " for " +
                  words_of(pose.target) + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  for (const ReachPose::Joint& joint : pose.joints) account.tell(joint.node, joint.limit);
  account.tell(pose.target, pose.method, pose.sweeps, pose.leaps, pose.weight);
}

std::unique_ptr<Operation> bound(const ReachPose& described, Binder& binder) {
  Changed changed = bound_change(described, "reach", binder);
  bool known = true;
  JointChainSettings settings{
      .links = {}, .method = described.method, .sweeps = described.sweeps, .leaps = described.leaps};
  settings.links.reserve(described.joints.size());
  for (std::size_t i = 0; i < described.joints.size(); ++i) {
    const std::size_t node = binder.node(described.joints[i].node, {"reach", "joints", std::to_string(i)});
    known = known && node != no_node;
    settings.links.push_back({node, described.joints[i].limit});
  }
  const std::size_t first =
      known && !settings.links.empty() ? *settings.links.front().node.in(binder.nodes()) : no_node;
  std::optional<BoundPlace> target = bound_place(described.target, {"reach", "target"}, first, binder);
  if (!known) return nullptr;
  std::optional<JointChain> chain;
  binder.attempt({"reach"}, [&] { chain.emplace(binder.nodes(), settings); });
  if (!chain || !changed.whole || !target) return nullptr;
  for (const JointChain::Joint& joint : chain->joints()) binder.moves(joint.node);
  return std::make_unique<Reaching>(std::move(changed), *std::move(chain), *std::move(target));
}

}  // namespace tweenfall::graphs
