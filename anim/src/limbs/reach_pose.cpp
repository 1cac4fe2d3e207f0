#include <tweenfall/anim/joint_chain.h>

#include "chains/chain_follow.h"
#include "limbs/place.h"
#include "operations/account.h"
#include "swinging/swing.h"

#include <algorithm>
#include <optional>

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

/// A chain with limits that goes on from where it was: on a grid of times, so that it is the same at any frame rate.
class FollowingChain : public Swing<ReachState> {
 public:
  static constexpr double steps_per_second = 60;

  FollowingChain(Changed changed, std::size_t number, JointChain chain, BoundPlace target)
      : Swing(std::move(changed), number, 1 / steps_per_second), chain_(std::move(chain)), target_(std::move(target)) {}

 protected:
  void rest(ReachState& state) const noexcept override {
    state.step = -1;
    state.memory.turns.assign(chain_.joints().size(), Quat(1, 0, 0, 0));
    state.memory.since_search = std::numeric_limits<double>::infinity();
  }
  void show(ReachState& state, double time, const ClockSight& sight, const PoseAt& pose_at,
            const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) const noexcept override {
    go_to(state, time, sight, pose_at, scratch.first(pose.size()));
    const Sample<Vec3> target = target_.sample(sight.log, sight.at(time, sight.side), chain_.nodes(), pose);
    const double since = std::clamp(time - time_of(state.step), 0.0, 1 / steps_per_second);
    // Where it begins, no way there tells its rates.
    const std::span<const Quat> turns(state.memory.turns.data(), since > 0 ? state.memory.turns.size() : 0);
    chains::follow_from(chain_, target, since, weight, turns, {}, state.memory.since_search, pose);
  }
  void begin_again(ReachState& state, double time, const ClockSight& sight, const PoseAt& pose_at,
                   std::span<Motion> scratch, std::span<const Motion> before,
                   std::span<const Motion>) const noexcept override {
    const std::span<Motion> room = scratch.first(before.size());
    go_to(state, time, sight, pose_at, room);
    std::ranges::copy(before, room.begin());
    advance(state, time, std::clamp(time - time_of(state.step), 0.0, 1 / steps_per_second), sight, Side::in, room);
    state.step = 0;
  }

 private:
  static double time_of(std::int64_t step) noexcept { return static_cast<double>(step) / steps_per_second; }

  /// @param seconds  since the pose that is remembered; none: it begins
  void advance(ReachState& state, double time, std::optional<double> seconds, const ClockSight& sight, Side side,
               std::span<Motion> pose) const noexcept {
    const Sample<Vec3> target = target_.sample(sight.log, sight.at(time, side), chain_.nodes(), pose);
    const std::span<Quat> turns = state.memory.turns;
    state.memory.since_search =
        chains::follow_from(chain_, target, seconds.value_or(0), {0, 0, 0}, seconds ? turns : turns.first(0), turns,
                            state.memory.since_search, pose);
  }
  void begin_at(ReachState& state, std::int64_t step, double time, const ClockSight& sight, const PoseAt& pose_at,
                std::span<Motion> room) const noexcept {
    rest(state);
    pose_at(time, room);
    advance(state, time, std::nullopt, sight, Side::out, room);
    state.step = step;
  }
  /// To the last point of the grid before `time`: from there the way to it tells its rates, as which joints leave their
  /// limits. Every ten minutes it begins anew, whoever asks for which times: so
  /// none takes longer to find than ten minutes of following.
  void go_to(ReachState& state, double time, const ClockSight& sight, const PoseAt& pose_at,
             std::span<Motion> room) const noexcept {
    constexpr double spell = 600;       // s
    constexpr double countable = 1e13;  // s; later, the points of the grid are no longer apart
    if (state.memory.turns.size() != chain_.joints().size() || !(time_of(state.step) <= time)) rest(state);
    if (!(time < countable)) return begin_at(state, most_steps, time, sight, pose_at, room);
    constexpr auto steps_per_spell = static_cast<std::int64_t>(spell * steps_per_second);
    const std::int64_t first = static_cast<std::int64_t>(time / spell) * steps_per_spell;
    if (state.step < first) begin_at(state, first, time_of(first), sight, pose_at, room);
    while (time_of(state.step + 1) < time) {
      const double next = time_of(state.step + 1);
      pose_at(next, room);
      advance(state, next, 1 / steps_per_second, sight, Side::out, room);
      ++state.step;
    }
  }

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
  if (pose.follows) account.tell(pose.follows);
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
  if (described.follows && chain->limited()) {
    auto operation = std::make_unique<FollowingChain>(std::move(changed), binder.new_swing(0), *std::move(chain),
                                                      *std::move(target));
    operation->set_rooms(FollowingChain::own_rooms);
    return operation;
  }
  return std::make_unique<Reaching>(std::move(changed), *std::move(chain), *std::move(target));
}

}  // namespace tweenfall::graphs
