#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/root_motion.h>

#include "chains/problems.h"
#include "operations/account.h"
#include "operations/changing.h"
#include "operations/travel.h"

namespace tweenfall::graphs {

namespace {

class OnTheSpot : public Changing {
 public:
  OnTheSpot(Changed changed, RootMotion root, std::optional<RootMotion> onto)
      : Changing(std::move(changed)), root_(std::move(root)), onto_(std::move(onto)) {}

  void accumulate(const Hierarchy& nodes, std::size_t number) { travel_.emplace(nodes, root_, base(), number); }

 protected:
  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch& scratch,
              std::span<Motion> pose) const noexcept override {
    const std::span<Motion> changed = scratch.pose();
    Motion frame;
    if (travel_) frame = travel_->at(log, moment, changed);
    std::ranges::copy(pose, changed.begin());
    const Motion taken = root_.take_out(changed);
    if (!travel_) frame = taken;
    if (onto_)
      onto_->put_back(changed, frame);
    else if (travel_)
      root_.put_back(changed, frame);
    cross_fade(pose, changed, weight, pose);
  }

 private:
  RootMotion root_;
  std::optional<RootMotion> onto_;
  std::optional<Travel> travel_{};
};

}  // namespace

void tell(const RootMotionPose& pose, Account& account) {
  const std::string on_the_spot = pose.accumulates ? " travels on" : " on the spot";
  account.words = pose.onto.empty() ? pose.node + on_the_spot : pose.onto + " carries the movement of " + pose.node;
  account.words += share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.node, pose.parts.horizontal, pose.parts.vertical, pose.parts.turn, pose.parts.up, pose.onto,
               pose.weight, pose.accumulates);
}

std::unique_ptr<Operation> bound(const RootMotionPose& described, Binder& binder) {
  Changed changed = bound_change(described, "root_motion", binder);
  const std::size_t node = binder.node(described.node, {"root_motion", "node"});
  std::size_t onto = no_node;
  if (!described.onto.empty()) onto = binder.node(described.onto, {"root_motion", "onto"});
  if (node == no_node || (!described.onto.empty() && onto == no_node)) return nullptr;
  if (onto != no_node && !chains::is_below(binder.nodes(), node, onto)) {
    binder.fault({"root_motion", "onto"}, "\"" + described.onto + "\" does not carry \"" + described.node + "\"");
    return nullptr;
  }
  std::optional<RootMotion> root, carrier;
  binder.attempt({"root_motion"}, [&] {
    root.emplace(binder.nodes(), described.node, described.parts);
    if (onto != no_node) carrier.emplace(binder.nodes(), described.onto, described.parts);
  });
  if (!root || !changed.whole) return nullptr;
  binder.moves(node);
  if (onto != no_node) binder.moves(onto);
  auto operation = std::make_unique<OnTheSpot>(std::move(changed), *std::move(root), std::move(carrier));
  if (described.accumulates) operation->accumulate(binder.nodes(), binder.new_travel());
  operation->set_rooms(1);
  return operation;
}

}  // namespace tweenfall::graphs
