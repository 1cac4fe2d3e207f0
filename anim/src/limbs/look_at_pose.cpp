#include <tweenfall/anim/look_at.h>

#include "chains/problems.h"
#include "limbs/place.h"
#include "operations/account.h"

namespace tweenfall::graphs {

namespace {

class Looking : public Changing {
 public:
  Looking(Changed changed, LookAtChain chain, BoundPlace target, const std::optional<Vec3>& upright)
      : Changing(std::move(changed)), chain_(std::move(chain)), target_(std::move(target)), upright_(upright) {}

 protected:
  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch&,
              std::span<Motion> pose) const noexcept override {
    LookAtGoal goal{.target = target_.sample(log, moment, chain_.nodes(), pose)};
    if (upright_) goal.up = {*upright_, Vec3(0, 0, 0), Vec3(0, 0, 0)};
    look_at(chain_, goal, weight, pose);
  }

 private:
  LookAtChain chain_;
  BoundPlace target_;
  std::optional<Vec3> upright_;
};

}  // namespace

void tell(const LookAtPose& pose, Account& account) {
  account.words = "look at " + words_of(pose.target) + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  for (const LookAtPose::Joint& joint : pose.joints) account.tell(joint.node, joint.share);
  account.tell(pose.target, pose.forward, pose.up, pose.upright, pose.eye, pose.limit, pose.ease, pose.weight);
}

std::unique_ptr<Operation> bound(const LookAtPose& described, Binder& binder) {
  Changed changed = bound_change(described, "look_at", binder);
  bool known = true;
  std::vector<LookAtJoint> joints;
  joints.reserve(described.joints.size());
  for (std::size_t i = 0; i < described.joints.size(); ++i) {
    const std::size_t node = binder.node(described.joints[i].node, {"look_at", "joints", std::to_string(i)});
    known = known && node != no_node;
    joints.push_back({node, described.joints[i].share});
  }
  const std::size_t first = known && !joints.empty() ? *joints.front().node.in(binder.nodes()) : no_node;
  std::optional<BoundPlace> target = bound_place(described.target, {"look_at", "target"}, first, binder);
  if (described.upright && !(described.upright->norm() > 0 && described.upright->norm() <= chains::largest))
    binder.fault({"look_at", "upright"}, "a direction has a length, of 1e15 at most");
  if (joints.empty()) binder.fault({"look_at", "joints"}, "there is none; at least one joint looks");
  if (!known || joints.empty()) return nullptr;
  std::optional<LookAtChain> chain;
  binder.attempt({"look_at"}, [&] {
    chain.emplace(binder.nodes(), LookAtSettings{joints, described.forward, described.up, described.eye,
                                                 described.limit, described.ease});
  });
  if (!chain || !changed.whole || !target) return nullptr;
  for (const LookAtChain::Joint& joint : chain->joints()) binder.moves(joint.node);
  return std::make_unique<Looking>(std::move(changed), *std::move(chain), *std::move(target), described.upright);
}

}  // namespace tweenfall::graphs
