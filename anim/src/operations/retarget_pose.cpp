#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/retarget.h>

#include "chains/problems.h"
#include "operations/account.h"
#include "operations/changing.h"
#include "operations/figure.h"

#include <algorithm>
#include <map>

namespace tweenfall::graphs {

namespace {

class Retargeted : public Changing {
 public:
  Retargeted(Changed changed, Figure source, Figure target, Retarget map)
      : Changing(std::move(changed)), source_(std::move(source)), target_(std::move(target)), map_(std::move(map)) {}

 protected:
  void change(const Log&, const Moment&, const Sample<double>& weight, const Scratch& scratch,
              std::span<Motion> pose) const noexcept override {
    const std::size_t size = target_.joints().size();
    const std::span<Motion> source = scratch.pose().first(source_.joints().size());
    const Scratch rest = scratch.rest();
    const std::span<Motion> own = rest.pose().first(size), other = rest.rest().pose().first(size);
    source_.take(pose, source);
    map_.apply(source, other);
    target_.take(pose, own);
    cross_fade(own, other, weight, other);
    target_.put(other, pose);
  }

 private:
  Figure source_, target_;
  Retarget map_;
};

/// The local poses of a figure in its stance; empty where that is the rest pose.
std::vector<Pose> stance_of(const Figure& figure, const std::map<std::size_t, const RetargetStance*>& told) {
  std::vector<Pose> poses;
  bool differs = false;
  for (const Node& node : figure.nodes().nodes()) {
    Pose& pose = poses.emplace_back(node.rest);
    const auto found = told.find(figure.joints()[poses.size() - 1]);
    if (found == told.end()) continue;
    differs = true;
    pose.position = found->second->position.value_or(pose.position);
    pose.rotation = found->second->rotation.value_or(pose.rotation);
  }
  return differs ? poses : std::vector<Pose>();
}

}  // namespace

void tell(const RetargetPose& pose, Account& account) {
  account.words = pose.target + " does as " + pose.source + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.source, pose.target);
  for (const RetargetPair& pair : pose.pairs) account.tell(pair.source, pair.target, pair.moves);
  account.tell(pose.pairs.size(), pose.scale, pose.up, pose.weight, pose.turn);
  for (const RetargetStance& each : pose.stance) account.tell(each.node, each.position, each.rotation);
}

std::unique_ptr<Operation> bound(const RetargetPose& described, Binder& binder) {
  Changed changed = bound_change(described, "retarget", binder);
  const std::size_t from = binder.node(described.source, {"retarget", "source"}),
                    to = binder.node(described.target, {"retarget", "target"});
  if (from == no_node || to == no_node) return nullptr;
  const Hierarchy& nodes = binder.nodes();
  if (from == to || chains::is_below(nodes, from, to) || chains::is_below(nodes, to, from)) {
    binder.fault({"retarget", "target"}, "a figure does what another figure does, but \"" + described.target +
                                             "\" and \"" + described.source + "\" share nodes");
    return nullptr;
  }
  Figure source(nodes, from), target(nodes, to);
  std::map<std::size_t, const RetargetStance*> told;
  for (const RetargetStance& each : described.stance) {
    const Place place = {"retarget", "stance", each.node};
    const std::size_t node = binder.node(each.node, place);
    if (node == no_node) return nullptr;
    const auto is_part = [&](const Figure& figure) { return std::ranges::count(figure.joints(), node) > 0; };
    if (!is_part(source) && !is_part(target))
      binder.fault(place, "\"" + each.node + "\" belongs to neither figure, \"" + described.source + "\" or \"" +
                              described.target + "\"");
    if (!told.emplace(node, &each).second) binder.fault(place, "\"" + each.node + "\" has two stances");
  }
  std::optional<Retarget> map;
  binder.attempt({"retarget"}, [&] {
    map.emplace(source.nodes(), target.nodes(), described.pairs,
                RetargetSettings{.scale = described.scale,
                                 .up = described.up,
                                 .turn = described.turn,
                                 .source_stance = stance_of(source, told),
                                 .target_stance = stance_of(target, told)});
  });
  if (!map || !changed.whole) return nullptr;
  for (const std::size_t node : target.joints()) binder.moves(node);
  auto operation =
      std::make_unique<Retargeted>(std::move(changed), std::move(source), std::move(target), *std::move(map));
  operation->set_rooms(3);
  return operation;
}

}  // namespace tweenfall::graphs
