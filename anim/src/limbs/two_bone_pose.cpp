#include <tweenfall/anim/two_bone.h>

#include "limbs/place.h"
#include "operations/account.h"

namespace tweenfall::graphs {

namespace {

class TwoBones : public Changing {
 public:
  TwoBones(Changed changed, TwoBoneChain chain, BoundPlace target, std::optional<BoundPlace> pole, double softness)
      : Changing(std::move(changed)),
        chain_(std::move(chain)),
        target_(std::move(target)),
        pole_(std::move(pole)),
        softness_(softness) {}

 protected:
  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch&,
              std::span<Motion> pose) const noexcept override {
    const Hierarchy& nodes = chain_.nodes();
    TwoBoneGoal goal{.target = target_.sample(log, moment, nodes, pose), .softness = softness_};
    if (pole_) {
      const Sample<Vec3> place = pole_->sample(log, moment, nodes, pose);
      const Motion start = world_of(chain_.start(), nodes, pose).motion;
      goal.pole = {place.value - start.pose.position, place.rate - start.twist.linear, Vec3(0, 0, 0)};
    }
    reach(chain_, goal, weight, pose);
  }

 private:
  TwoBoneChain chain_;
  BoundPlace target_;
  std::optional<BoundPlace> pole_;
  double softness_;
};

}  // namespace

void tell(const TwoBonePose& pose, Account& account) {
  account.words = "two bones, " + pose.end + " to " + words_of(pose.target) + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.start, pose.middle, pose.end, pose.target, pose.pole, pose.axis, pose.softness, pose.weight);
}

std::unique_ptr<Operation> bound(const TwoBonePose& described, Binder& binder) {
  const Place here = {"two_bone"};
  const auto at = [](const char* part) { return Place{"two_bone", part}; };
  Changed changed = bound_change(described, "two_bone", binder);
  const std::size_t start = binder.node(described.start, at("start"));
  const std::size_t middle = binder.node(described.middle, at("middle")), end = binder.node(described.end, at("end"));
  std::optional<BoundPlace> target = bound_place(described.target, at("target"), start, binder), pole;
  if (described.pole) pole = bound_place(*described.pole, at("pole"), start, binder);
  if (!(described.softness >= 0 && described.softness <= 0.5))
    binder.fault(at("softness"), "the softness of two bones is 0 to 0.5");
  if (start == no_node || middle == no_node || end == no_node) return nullptr;
  std::optional<TwoBoneChain> chain;
  binder.attempt(here, [&] { chain.emplace(binder.nodes(), TwoBoneSettings{start, middle, end, described.axis}); });
  if (!chain || !changed.whole || !target || (described.pole && !pole)) return nullptr;
  for (const std::size_t node : {start, middle}) binder.moves(node);
  return std::make_unique<TwoBones>(std::move(changed), *std::move(chain), *std::move(target), std::move(pole),
                                    described.softness);
}

}  // namespace tweenfall::graphs
