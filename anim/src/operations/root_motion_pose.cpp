#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/root_motion.h>

#include <algorithm>
#include <vector>

#include "chains/problems.h"
#include "operations/account.h"
#include "operations/changing.h"
#include "operations/travel.h"

namespace tweenfall::graphs {

namespace {

/// Adds an operation and what it is made of, each once.
void gather(const Operation& operation, std::vector<const Operation*>& all) {
  if (std::ranges::find(all, &operation) != all.end()) return;
  all.push_back(&operation);
  for (const Operation* part : operation.operands()) gather(*part, all);
}

/// Whether any clip of the graph shows in a pose.
bool shows_clips(const Operation* base) {
  std::vector<const Operation*> all;
  if (base) gather(*base, all);
  return std::ranges::any_of(all, [](const Operation* operation) { return !operation->own_clips().empty(); });
}

/// What stands above a figure and is not moved by its clips, the nearest first: the figure rides on it. Nothing where
/// its clips move no node from `node` up.
std::vector<std::size_t> carriers_of(const Hierarchy& nodes, std::size_t node, const Operation* clips) {
  std::vector<const Operation*> all;
  if (clips) gather(*clips, all);
  const auto is_moved = [&](std::size_t joint) {
    return std::ranges::any_of(all, [joint](const Operation* operation) {
      return std::ranges::any_of(operation->own_clips(), [joint](const pose::BoundClip* clip) {
        return clip->entry_of(joint) != pose::BoundClip::no_entry;
      });
    });
  };
  std::vector<std::size_t> above;
  bool moved = false;
  for (std::size_t i = node; clips && i != no_node; i = nodes[i].parent) {
    above.push_back(i);
    if (!is_moved(i)) continue;
    moved = true;
    above.clear();
  }
  return moved ? above : std::vector<std::size_t>();
}

class OnTheSpot : public Changing {
 public:
  OnTheSpot(Changed changed, const Hierarchy& nodes, RootMotion root, std::optional<RootMotion> onto)
      : Changing(std::move(changed)),
        nodes_(nodes),
        root_(std::move(root)),
        onto_(std::move(onto)),
        carriers_(carriers_of(nodes, root_.node(), base())) {
    const auto found = onto_ ? std::ranges::find(carriers_, onto_->node()) : carriers_.end();
    if (found != carriers_.end()) moving_ = static_cast<std::size_t>(found - carriers_.begin()) + 1;
  }

  void accumulate(std::size_t number) { travel_.emplace(nodes_, root_, base(), number); }

 protected:
  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch& scratch,
              std::span<Motion> pose) const noexcept override {
    const std::span<Motion> changed = scratch.pose();
    Motion frame;
    if (travel_) frame = travel_->at(log, moment, changed);
    std::ranges::copy(pose, changed.begin());
    // In the space of what carries the figure, which rests meanwhile.
    for (const std::size_t node : carriers_) {
      changed[node] = {};
      changed[node].pose = nodes_[node].rest;
    }
    const auto move_on = [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) changed[carriers_[i]] = pose[carriers_[i]];
    };
    const Motion taken = root_.take_out(changed);
    if (!travel_) frame = taken;
    move_on(0, moving_);
    if (onto_)
      onto_->put_back(changed, frame);
    else if (travel_)
      root_.put_back(changed, frame);
    move_on(moving_, carriers_.size());
    cross_fade(pose, changed, weight, pose);
  }

 private:
  const Hierarchy& nodes_;
  RootMotion root_;
  std::optional<RootMotion> onto_;
  std::vector<std::size_t> carriers_;
  std::size_t moving_ = 0;  // of the carriers: those up to `onto`
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
  if (described.accumulates && !shows_clips(changed.base)) {
    binder.fault({"root_motion", "accumulate"},
                 "its base shows no clip of the graph whose steps could add up; plays below the graph do not count");
    return nullptr;
  }
  auto operation =
      std::make_unique<OnTheSpot>(std::move(changed), binder.nodes(), *std::move(root), std::move(carrier));
  if (described.accumulates) operation->accumulate(binder.new_travel());
  operation->set_rooms(1);
  return operation;
}

}  // namespace tweenfall::graphs
