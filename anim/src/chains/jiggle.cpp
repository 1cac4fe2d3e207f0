#include <tweenfall/anim/jiggle.h>

#include "chains/angle_limit.h"
#include "chains/problems.h"
#include "chains/spring_forcing.h"
#include "chains/state_bytes.h"

namespace tweenfall {
namespace chains {
namespace {

// Walks along the joints of a chain in one pose: the position of each, carried by the swinging joints before it.
class Walk {
 public:
  Walk(const JiggleChain& chain, std::span<const Motion> pose) noexcept
      : chain_(chain),
        pose_(pose),
        carrier_(in_world(chain.nodes(), chain.nodes()[chain.joints().front()].parent, pose)) {
    stand();
  }

  [[nodiscard]] const Arrow& joint() const noexcept { return joint_; }
  [[nodiscard]] const Arrow& tail() const noexcept { return tail_; }  ///< its place in the script
  /// The rotation of the joint's parent.
  [[nodiscard]] Turning outer() const noexcept { return rotation_of(carrier_); }

  /// Turns the joint so that its tail is in the direction of `tail_ + offset`. @returns its own rotation, in its
  /// parent's axes
  Turning swing(const Arrow& offset) noexcept {
    const Measured arm = measured(tail_ - joint_), away = measured(tail_ + offset - joint_);
    Turning swung = rotation_of(here_);
    if (arm.any && away.any) {
      const Arrow to = within_angle(away.unit, arm.unit, chain_.limit(), chain_.ease());
      swung = arc(arm.unit, to, any_across(arm.unit.v)) * swung;
    }
    const Turning local = reflected_by(pose::reflection_of(carrier_.pose.scale), chains::inverse(outer()) * swung);
    here_.pose.rotation = swung.v;
    here_.twist.angular = swung.w;
    return local;
  }

  /// Goes on to the next joint.
  void go_on() noexcept {
    const std::size_t before = chain_.joints()[number_], now = chain_.joints()[++number_];
    carrier_ = here_;
    const std::size_t parent = chain_.nodes()[now].parent;
    if (parent != before) carrier_ = compose(here_, seen_from(chain_.nodes(), before, parent, pose_));
    stand();
  }

 private:
  void stand() noexcept {
    const std::size_t node = chain_.joints()[number_];
    const bool last = number_ + 1 == chain_.joints().size();
    const std::size_t next = last ? chain_.tail() : chain_.joints()[number_ + 1];
    here_ = compose(carrier_, pose_[node]);
    joint_ = position_of(here_);
    Motion tip;
    tip.pose.position = chain_.tip();
    tail_ = position_of(compose(here_, next == no_node ? tip : seen_from(chain_.nodes(), node, next, pose_)));
  }

  const JiggleChain& chain_;
  std::span<const Motion> pose_;
  std::size_t number_ = 0;
  Motion carrier_, here_;
  Arrow joint_, tail_;
};

// The offset of a tail after it is moved to its distance from the joint, keeping its direction and the rate of that.
Arrow held(const Arrow& offset, const Walk& walk) noexcept {
  const Measured arm = measured(walk.tail() - walk.joint()), away = measured(walk.tail() + offset - walk.joint());
  if (!arm.any || !away.any) return {};
  return walk.joint() + arm.length * away.unit - walk.tail();
}

// The effect of the bone on the tail within a step: it holds the tail at its distance, which cancels the outward part
// of all other accelerations, and the centrifugal one, with their values at the start of the step. `held` corrects the
// remaining error of the distance; without this function that error would be of first order, and would damp a swing
// under gravity.
void pull_back(Forcing& push, const SpringFollower& spring, const Walk& before, const Walk& after,
               const Arrow& offset) noexcept {
  const SpringSettings& settings = spring.settings();
  const double w = 2 * std::numbers::pi * settings.hz, drag = 2 * settings.damping * w;
  const double h = 1 / settings.steps_per_second;
  // A stiff spring comes to rest before the step ends: the values at its start do not apply to all of it.
  if (drag * h + w * h > 1) return;
  const Arrow &joint = before.joint(), &later = after.joint();
  const Measured away = measured(before.tail() + offset - joint);
  if (!away.any) return;
  const Vec3 joint_acceleration = (6 * (later.v - joint.v) - h * (4 * joint.d + 2 * later.d)) / (h * h);
  const Vec3 free = settings.gravity - drag * offset.d - (w * w) * offset.v - joint_acceleration;
  const double length = away.length.v, most = 0.5 * length / (h * h);
  const double turning = length * away.unit.d.squaredNorm();
  const double pull = std::clamp(away.unit.v.dot(free) + turning, -most, most);
  push.parts[0] -= pull * away.unit.v;
  push.parts[1] -= pull * away.unit.d;
}

}  // namespace
}  // namespace chains

std::vector<std::byte> JiggleState::bytes() const {
  chains::StateWriter out;
  out.number(step);
  out.number(static_cast<std::int64_t>(offsets.size()));
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    out.vector(offsets[i]);
    out.vector(rates[i]);
  }
  return out.bytes;
}

JiggleState JiggleState::from_bytes(std::span<const std::byte> bytes) {
  chains::StateReader in{bytes, "jiggle state"};
  if (bytes.size() < 16 || (bytes.size() - 16) % 48 != 0) in.require_size(16);
  JiggleState state;
  state.step = in.number();
  const std::size_t count = (bytes.size() - 16) / 48;
  const std::int64_t told = in.number();
  if (told != static_cast<std::int64_t>(count))
    throw std::invalid_argument("jiggle state: it says that it has " + std::to_string(told) + " joints and has " +
                                std::to_string(count));
  state.offsets.reserve(count);
  state.rates.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    state.offsets.push_back(in.vector());
    state.rates.push_back(in.vector());
  }
  return state;
}

JiggleChain::JiggleChain(const Hierarchy& nodes, const JiggleSettings& settings)
    : nodes_(nodes), spring_(SpringSettings{}), tip_(settings.tip), limit_(settings.limit), ease_(settings.ease) {
  chains::Problems problems("jiggle chain");
  const bool with_tip = !settings.tip.isZero(0);
  const std::size_t least = with_tip ? 1 : 2;
  problems.at({"joints"})
      .require(settings.joints.size() >= least, "it has " + std::to_string(settings.joints.size()) +
                                                    (settings.joints.size() == 1 ? " joint" : " joints") +
                                                    "; it needs two, or one and a tip");
  joints_ = problems.chain(nodes, settings.joints);
  problems.include([&] { spring_ = SpringFollower(settings.spring); }, "each joint's");
  problems.at({"tip"}).require_finite(tip_, "tip");
  problems.at({"limit"}).require_in(limit_, 0, std::numbers::pi, "limit");
  problems.at({"ease"}).require_in(ease_, 0, chains::largest, "ease");
  problems.report();
  if (!with_tip) {
    tail_ = joints_.back();
    joints_.pop_back();
  }
}

JiggleState JiggleChain::at_rest(double time) const {
  JiggleState state;
  state.step = spring_.step_at(time);
  state.offsets.assign(joints_.size(), Vec3(0, 0, 0));
  state.rates = state.offsets;
  return state;
}

namespace chains {
namespace {

// A chain in motion: at a point of the grid, and then at a time after it.
class Swinging {
 public:
  Swinging(const JiggleChain& chain, JiggleState& state, const PoseAt& pose_at, std::span<Motion> scratch) noexcept
      : chain_(chain),
        state_(state),
        pose_at_(pose_at),
        from_(scratch.first(chain.nodes().size())),
        to_(scratch.subspan(chain.nodes().size())) {}

  /// Advances to the last point of the grid up to `time`.
  void go_to(double time) noexcept {
    const SpringFollower& spring = chain_.spring();
    const std::size_t count = chain_.joints().size();
    const auto rest = [&] {
      state_.offsets.assign(count, Vec3(0, 0, 0));
      state_.rates.assign(count, Vec3(0, 0, 0));
      pose_at_(spring.time_of(state_.step), from_);
    };
    if (state_.offsets.size() != count || state_.rates.size() != count) {
      state_.step = spring.step_at(time);
      rest();
    } else {
      pose_at_(spring.time_of(state_.step), from_);
    }
    advance_to(spring, state_.step, time, rest, [&](std::int64_t step) {
      pose_at_(spring.time_of(step + 1), to_);
      Walk before(chain_, from_), after(chain_, to_);
      for (std::size_t i = 0; i < count; ++i) {
        const Arrow offset{state_.offsets[i], state_.rates[i]};
        const Arrow next = held(carried(spring.of_step(), offset, pushed(before, after, offset)), after);
        state_.offsets[i] = next.v;
        state_.rates[i] = next.d;
        if (i + 1 == count) break;
        before.swing(offset);
        before.go_on();
        after.swing(next);
        after.go_on();
      }
      std::swap(from_, to_);
    });
  }

  /// Calls `visit(joint, offset)` in order with the offset of each tail at `time` from its place in the script, after
  /// the joints before it have swung.
  template <class Visit>
  void at(double time, const Visit& visit) noexcept {
    const SpringFollower& spring = chain_.spring();
    const std::size_t count = chain_.joints().size();
    const double seconds = seconds_into(spring, state_.step, time);
    if (seconds == 0) {
      // At a point of the grid the next step does not matter yet.
      for (std::size_t i = 0; i < count; ++i) visit(i, Arrow{state_.offsets[i], state_.rates[i]});
      return;
    }
    pose_at_(spring.time_of(state_.step + 1), to_);
    const SpringShares shares = spring.shares(seconds);
    Walk before(chain_, from_), after(chain_, to_);
    for (std::size_t i = 0; i < count; ++i) {
      const Arrow offset{state_.offsets[i], state_.rates[i]};
      const Forcing push = pushed(before, after, offset);
      if (i + 1 < count) {
        before.swing(offset);
        before.go_on();
        after.swing(held(carried(spring.of_step(), offset, push), after));
        after.go_on();
      }
      visit(i, carried(shares, offset, push));
    }
  }

 private:
  [[nodiscard]] Forcing pushed(const Walk& before, const Walk& after, const Arrow& offset) const noexcept {
    const SpringSettings& settings = chain_.spring().settings();
    Forcing push = forcing(before.tail(), after.tail(), 1 / settings.steps_per_second, settings.gravity);
    pull_back(push, chain_.spring(), before, after, offset);
    return push;
  }

  const JiggleChain& chain_;
  JiggleState& state_;
  const PoseAt& pose_at_;
  std::span<Motion> from_, to_;
};

}  // namespace
}  // namespace chains

void jiggle(const JiggleChain& chain, JiggleState& state, double time, const PoseAt& pose_at,
            const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) noexcept {
  using namespace chains;
  Swinging swinging(chain, state, pose_at, scratch);
  swinging.go_to(time);
  if (is_nothing(weight)) return;
  Walk now(chain, pose);
  swinging.at(time, [&](std::size_t i, const Arrow& offset) {
    const Turning local = now.swing(offset);
    if (i + 1 < chain.joints().size()) now.go_on();
    turn_to(pose[chain.joints()[i]], local, weight);
  });
}

void begin_anew(const JiggleChain& chain, JiggleState& state, double time, const PoseAt& pose_at,
                std::span<Motion> scratch, std::span<const Motion> before, std::span<const Motion> after) noexcept {
  using namespace chains;
  Swinging swinging(chain, state, pose_at, scratch);
  swinging.go_to(time);
  Walk arrives(chain, before), leaves(chain, after);
  swinging.at(time, [&](std::size_t i, const Arrow& offset) {
    const Arrow left = held(arrives.tail() + offset - leaves.tail(), leaves);
    if (i + 1 < chain.joints().size()) {
      arrives.swing(offset);
      arrives.go_on();
      leaves.swing(left);
      leaves.go_on();
    }
    state.offsets[i] = left.v;
    state.rates[i] = left.d;
  });
  state.step = 0;
}

}  // namespace tweenfall
