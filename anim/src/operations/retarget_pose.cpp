#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/retarget.h>

#include "chains/problems.h"
#include "operations/account.h"
#include "operations/changing.h"
#include "operations/figure.h"

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

}  // namespace

void tell(const RetargetPose& pose, Account& account) {
  account.words = pose.target + " does as " + pose.source + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.source, pose.target);
  for (const RetargetPair& pair : pose.pairs) account.tell(pair.source, pair.target, pair.moves);
  account.tell(pose.pairs.size(), pose.scale, pose.up, pose.weight);
}

std::unique_ptr<Operation> bound(const RetargetPose& described, Binder& binder) {
  Changed changed = bound_change(described, "retarget", binder);
  const std::size_t from = binder.node(described.source, {"retarget", "source"}),
                    to = binder.node(described.target, {"retarget", "target"});
  if (from == no_node || to == no_node) return nullptr;
  const Hierarchy& nodes = binder.nodes();
  if (from == to || chains::is_below(nodes, from, to) || chains::is_below(nodes, to, from)) {
    binder.fault({"retarget", "target"}, "a figure takes over what another does, and \"" + described.target +
                                             "\" and \"" + described.source + "\" share nodes");
    return nullptr;
  }
  Figure source(nodes, from), target(nodes, to);
  std::optional<Retarget> map;
  binder.attempt({"retarget", "pairs"}, [&] {
    map.emplace(source.nodes(), target.nodes(), described.pairs,
                RetargetSettings{.scale = described.scale, .up = described.up});
  });
  if (!map || !changed.whole) return nullptr;
  for (const std::size_t node : target.joints()) binder.moves(node);
  auto operation =
      std::make_unique<Retargeted>(std::move(changed), std::move(source), std::move(target), *std::move(map));
  operation->set_rooms(3);
  return operation;
}

}  // namespace tweenfall::graphs
