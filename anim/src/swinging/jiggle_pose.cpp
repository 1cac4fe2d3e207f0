#include <tweenfall/anim/jiggle.h>
#include <tweenfall/curves/number_text.h>

#include "operations/account.h"
#include "swinging/swing.h"

namespace tweenfall::graphs {

namespace {

class SwingingChain : public Swing<JiggleState> {
 public:
  SwingingChain(Changed changed, std::size_t number, double step, JiggleChain chain)
      : Swing(std::move(changed), number, step), chain_(std::move(chain)) {}

 protected:
  void rest(JiggleState& state) const noexcept override {
    state.step = 0;
    state.offsets.assign(chain_.joints().size(), Vec3(0, 0, 0));
    state.rates.assign(chain_.joints().size(), Vec3(0, 0, 0));
  }
  void show(JiggleState& state, double time, const ClockSight&, const PoseAt& pose_at, const Sample<double>& weight,
            std::span<Motion> scratch, std::span<Motion> pose) const noexcept override {
    jiggle(chain_, state, time, pose_at, weight, scratch, pose);
  }
  void begin_again(JiggleState& state, double time, const ClockSight&, const PoseAt& pose_at, std::span<Motion> scratch,
                   std::span<const Motion> before, std::span<const Motion> after) const noexcept override {
    begin_anew(chain_, state, time, pose_at, scratch, before, after);
  }

 private:
  JiggleChain chain_;
};

}  // namespace

void tell(const JigglePose& pose, Account& account) {
  account.words = (pose.joints.empty() ? std::string("a chain") : pose.joints.front()) + " swings, " +
                  brief_text(pose.spring.hz) + " Hz, damping " + brief_text(pose.spring.damping) +
                  share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.joints, pose.tip, pose.spring.hz, pose.spring.damping, pose.spring.gravity,
               pose.spring.steps_per_second, pose.limit, pose.ease, pose.weight);
}

std::unique_ptr<Operation> bound(const JigglePose& described, Binder& binder) {
  Changed changed = bound_change(described, "jiggle", binder);
  bool known = true;
  JiggleSettings settings{
      .joints = {}, .tip = described.tip, .spring = described.spring, .limit = described.limit, .ease = described.ease};
  settings.joints.reserve(described.joints.size());
  for (std::size_t i = 0; i < described.joints.size(); ++i) {
    const std::size_t node = binder.node(described.joints[i], {"jiggle", "joints", std::to_string(i)});
    known = known && node != no_node;
    settings.joints.emplace_back(node);
  }
  if (!known) return nullptr;
  std::optional<JiggleChain> chain;
  binder.attempt({"jiggle"}, [&] { chain.emplace(binder.nodes(), settings); });
  if (!chain || !changed.whole) return nullptr;
  for (const std::size_t node : chain->joints()) binder.moves(node);
  const double step = 1 / described.spring.steps_per_second;
  auto operation = std::make_unique<SwingingChain>(std::move(changed), binder.new_swing(step), step, *std::move(chain));
  operation->set_rooms(SwingingChain::own_rooms);
  return operation;
}

}  // namespace tweenfall::graphs
