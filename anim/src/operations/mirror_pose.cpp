#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/mirror.h>

#include "chains/problems.h"
#include "operations/account.h"
#include "operations/changing.h"
#include "operations/figure.h"

namespace tweenfall::graphs {

namespace {

class Mirrored : public Changing {
 public:
  Mirrored(Changed changed, Figure figure, Mirror mirror)
      : Changing(std::move(changed)), figure_(std::move(figure)), mirror_(std::move(mirror)) {}

 protected:
  void change(const Log&, const Moment&, const Sample<double>& weight, const Scratch& scratch,
              std::span<Motion> pose) const noexcept override {
    const std::size_t size = figure_.joints().size();
    const std::span<Motion> own = scratch.pose().first(size), other = scratch.rest().pose().first(size);
    figure_.take(pose, own);
    mirror_.apply(own, other);
    cross_fade(own, other, weight, other);
    figure_.put(other, pose);
  }

 private:
  Figure figure_;
  Mirror mirror_;
};

}  // namespace

void tell(const MirrorPose& pose, Account& account) {
  account.words = "mirror" + (pose.figure.empty() ? std::string() : " of " + pose.figure) + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  for (const MirrorPair& pair : pose.pairs) account.tell(pair.left, pair.right);
  account.tell(pose.pairs.size(), pose.normal, pose.figure, pose.weight);
}

std::unique_ptr<Operation> bound(const MirrorPose& described, Binder& binder) {
  Changed changed = bound_change(described, "mirror", binder);
  std::size_t root = no_node;
  if (!described.figure.empty()) {
    root = binder.node(described.figure, {"mirror", "figure"});
    if (root == no_node) return nullptr;
  }
  Figure figure(binder.nodes(), root);
  std::vector<MirrorPair> pairs = described.pairs;
  if (pairs.empty()) pairs = usual_sides(figure.nodes());
  if (pairs.empty())
    binder.fault({"mirror"},
                 "the names of these joints do not tell sides; give \"pairs\", such as "
                 "[\"*.L\", \"*.R\"]");
  std::optional<Mirror> mirror;
  binder.attempt({"mirror"}, [&] {
    try {
      mirror.emplace(figure.nodes(), pairs, described.normal);
    } catch (const chains::Unfit& unfit) {
      if (!described.pairs.empty()) throw;
      throw std::invalid_argument(unfit.what());  // nobody wrote the pairs
    }
  });
  if (!mirror || pairs.empty() || !changed.whole) return nullptr;
  for (const std::size_t node : figure.joints()) binder.moves(node);
  auto operation = std::make_unique<Mirrored>(std::move(changed), std::move(figure), *std::move(mirror));
  operation->set_rooms(2);
  return operation;
}

}  // namespace tweenfall::graphs
