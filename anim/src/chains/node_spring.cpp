#include <tweenfall/anim/node_spring.h>

#include "chains/problems.h"
#include "chains/spring_forcing.h"
#include "chains/state_bytes.h"

#include <array>

namespace tweenfall {
namespace chains {
namespace {

std::optional<SpringFollower> spring_of(const std::optional<SpringSettings>& settings) {
  return settings ? std::optional<SpringFollower>(SpringFollower(*settings)) : std::nullopt;
}

}  // namespace
}  // namespace chains

NodeSpring::NodeSpring(const Hierarchy& nodes, const NodeSpringSettings& settings) : nodes_(nodes), node_(no_node) {
  chains::Problems problems("node spring");
  node_ = problems.at({"node"}).node(nodes, settings.node, "node");
  problems.at({}).require(settings.position || settings.rotation, "it has neither a position nor a rotation to follow");
  problems.at({"position"}).include([&] { position_ = chains::spring_of(settings.position); }, "position");
  problems.at({"rotation"}).include([&] { rotation_ = chains::spring_of(settings.rotation); }, "rotation");
  problems.report();
}

NodeSpringState NodeSpring::at_rest(double time) const noexcept {
  NodeSpringState state;
  if (position_) state.position = position_->at_rest(time);
  if (rotation_) state.rotation = rotation_->at_rest(time);
  return state;
}

namespace chains {
namespace {

/// The offsets of the springs from the node in the script.
struct Away {
  Arrow place, turn;
};

// Caches the script's motion of the node: at a point of the grid and the next, for both springs.
class Script {
 public:
  Script(const NodeSpring& spring, const PoseAt& pose_at, std::span<Motion> scratch) noexcept
      : spring_(spring), pose_at_(pose_at), scratch_(scratch.first(spring.nodes().size())) {}

  const Motion& at(double time) noexcept {
    for (const Seen& each : seen_)
      if (each.any && each.time == time) return each.motion;
    Seen& next = seen_[next_];
    next_ = (next_ + 1) % seen_.size();
    pose_at_(time, scratch_);
    next = {true, time, in_world(spring_.nodes(), spring_.node(), scratch_)};
    return next.motion;
  }

 private:
  struct Seen {
    bool any = false;
    double time = 0;
    Motion motion{};
  };
  const NodeSpring& spring_;
  const PoseAt& pose_at_;
  std::span<Motion> scratch_;
  std::array<Seen, 4> seen_{};
  std::size_t next_ = 0;
};

Away away_at(const NodeSpring& spring, NodeSpringState& state, double time, const PoseAt& pose_at,
             std::span<Motion> scratch) noexcept {
  Script script(spring, pose_at, scratch);
  const auto world_at = [&](double t) { return script.at(t); };
  const auto place_forcing = [&](const Motion& from, const Motion& to) {
    const SpringSettings& settings = spring.position()->settings();
    return forcing(position_of(from), position_of(to), 1 / settings.steps_per_second, settings.gravity);
  };
  const Vec3 none(0, 0, 0);
  const auto turn_forcing = [&](const Motion& from, const Motion& to) {
    const Vec3 way = log_map(to.pose.rotation * from.pose.rotation.conjugate());
    return forcing(Arrow{none, from.twist.angular}, Arrow{way, to.twist.angular},
                   1 / spring.rotation()->settings().steps_per_second, none);
  };
  // Both advance together, so that the script is sampled once for each point.
  if (spring.position() && spring.rotation()) {
    constexpr std::int64_t most = 1'000'000;
    const std::int64_t last = spring.position()->step_at(time);
    if (state.position.step < last && last - state.position.step < most)
      for (std::int64_t step = state.position.step + 1; step <= last; ++step) {
        const double point = spring.position()->time_of(step);
        bring_to(*spring.position(), state.position, point, world_at, place_forcing);
        if (point >= spring.rotation()->time_of(state.rotation.step))
          bring_to(*spring.rotation(), state.rotation, point, world_at, turn_forcing);
      }
  }
  const auto offset = [&](const SpringFollower& follower, SpringState& of, const auto& forcing) {
    bring_to(follower, of, time, world_at, forcing);
    // At a point of the grid the next step does not matter yet.
    if (seconds_into(follower, of.step, time) == 0) return Arrow{of.offset, of.rate};
    return offset_at(follower, of, time, world_at, forcing);
  };
  Away away;
  if (spring.position()) away.place = offset(*spring.position(), state.position, place_forcing);
  if (spring.rotation()) away.turn = offset(*spring.rotation(), state.rotation, turn_forcing);
  return away;
}

}  // namespace
}  // namespace chains

std::vector<std::byte> NodeSpringState::bytes() const {
  std::vector<std::byte> bytes = position.bytes();
  for (const std::byte byte : rotation.bytes()) bytes.push_back(byte);
  return bytes;
}

NodeSpringState NodeSpringState::from_bytes(std::span<const std::byte> bytes) {
  chains::StateReader{bytes, "node spring state"}.require_size(112);
  return {SpringState::from_bytes(bytes.first(56)), SpringState::from_bytes(bytes.subspan(56))};
}

void follow(const NodeSpring& spring, NodeSpringState& state, double time, const PoseAt& pose_at,
            const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) noexcept {
  using namespace chains;
  const Hierarchy& nodes = spring.nodes();
  const auto [place, turn] = away_at(spring, state, time, pose_at, scratch);
  if (is_nothing(weight)) return;

  const WorldMotion parent = above(nodes, spring.node(), pose);
  const Inward inward(parent);
  Motion& motion = pose[spring.node()];
  if (spring.position() && !inward.flat()) {
    const Arrow local = Dual(weight.value, weight.rate) * inward.direction(place);
    motion.pose.position += local.v;
    motion.twist.linear += local.d;
  }
  if (spring.rotation()) {
    const Motion carrier = in_world(nodes, nodes[spring.node()].parent, pose);
    const Turning outer = rotation_of(carrier);
    const Vec3 reflection = tweenfall::pose::reflection_of(carrier.pose.scale);
    const Turning own = reflected_by(reflection, rotation_of(motion));
    turn_to(motion, reflected_by(reflection, chains::inverse(outer) * exp_turn(turn) * outer * own), weight);
  }
}

NodeSpringState begun_anew(const NodeSpring& spring, NodeSpringState state, double time, const PoseAt& pose_at,
                           std::span<Motion> scratch, std::span<const Motion> before,
                           std::span<const Motion> after) noexcept {
  using namespace chains;
  const auto [place, turn] = away_at(spring, state, time, pose_at, scratch);
  const auto world_in = [&](std::span<const Motion> pose) { return in_world(spring.nodes(), spring.node(), pose); };
  const Motion from = world_in(before), to = world_in(after);
  const Arrow way = place + position_of(from) - position_of(to);
  const Arrow left = log_turn(exp_turn(turn) * rotation_of(from) * chains::inverse(rotation_of(to)));
  NodeSpringState anew;
  if (spring.position()) anew.position = {0, way.v, way.d};
  if (spring.rotation()) anew.rotation = {0, left.v, left.d};
  return anew;
}

}  // namespace tweenfall
