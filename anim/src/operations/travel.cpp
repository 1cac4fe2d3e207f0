#include "operations/travel.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::graphs {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The next end of a step: 480 times a second from an instant on, and half as often each time that twice 4096 s have
/// passed, so that nobody waits for whoever looks a million years ahead.
double next_stop(double instant, double after) noexcept {
  const double since = after - instant;
  double size = 1.0 / 480;
  for (double reach = 4096; since >= reach; reach *= 2) size *= 2;
  const double passed = std::floor(since / size);
  const double stop = instant + (passed + 1) * size;
  return stop > after ? stop : instant + (passed + 2) * size;
}

Motion standing() noexcept {
  return {};
}

/// Steps as seen half way through their turns, where those that turn evenly go straight; their mean and its rates.
class MeanStep {
 public:
  void add(const Motion& step, double share, double share_rate) noexcept {
    const Vec3 turn = log_map(step.pose.rotation);
    const Vec3 turn_rate = right_jacobian_inverse(Vec3(-turn)) * step.twist.angular;
    const Quat back = exp_map(Vec3(-0.5 * turn));
    const Vec3 spin = right_jacobian(Vec3(0.5 * turn)) * Vec3(-0.5 * turn_rate);  // of `back`
    const Vec3 way = back * step.pose.position;
    const Vec3 way_rate = back * step.twist.linear + spin.cross(way);
    turn_ += share * turn;
    turn_rate_ += share * turn_rate + share_rate * turn;
    way_ += share * way;
    way_rate_ += share * way_rate + share_rate * way;
  }

  [[nodiscard]] Motion mean() const noexcept {
    Motion mean;
    const Quat half = exp_map(Vec3(0.5 * turn_));
    const Vec3 spin = right_jacobian(Vec3(-0.5 * turn_)) * Vec3(0.5 * turn_rate_);
    mean.pose.rotation = exp_map(turn_);
    mean.twist.angular = right_jacobian(Vec3(-turn_)) * turn_rate_;
    mean.pose.position = half * way_;
    mean.twist.linear = half * way_rate_ + spin.cross(mean.pose.position);
    return mean;
  }

 private:
  Vec3 turn_{0, 0, 0}, turn_rate_{0, 0, 0}, way_{0, 0, 0}, way_rate_{0, 0, 0};
};

bool same(const Bearer& a, const Bearer& b) noexcept {
  return a.operation == b.operation && a.clip == b.clip && a.start == b.start;
}

}  // namespace

Travel::Travel(const Hierarchy& nodes, RootMotion root, const Operation* base, std::size_t number)
    : nodes_(nodes), root_(std::move(root)), base_(base), number_(number) {
  for (std::size_t i = root_.node(); i != no_node; i = nodes[i].parent) chain_.push_back(i);
  if (base_) know(*base_);
}

void Travel::know(const Operation& operation) {
  if (std::ranges::find(known_, &operation, &Known::operation) != known_.end()) return;
  const std::vector<const pose::BoundClip*> clips = operation.own_clips();
  std::vector<Motion> room(nodes_.size());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    Known known{&operation, i, clips[i], {}};
    const double duration = clips[i]->clip().duration;
    if (std::isfinite(duration)) {
      ClipClock first, last;
      last.time = duration;
      last.side = Side::in;
      known.travel = RootTravel(carried(*clips[i], first, room).pose, carried(*clips[i], last, room).pose);
    }
    known_.push_back(std::move(known));
  }
  for (const Operation* operand : operation.operands()) know(*operand);
}

Bearers Travel::bearers_at(const Log& log, const Moment& moment) const noexcept {
  Bearers bearers;
  if (base_) base_->bearers(log, moment, root_.node(), {1, 0, 0}, bearers);
  return bearers;
}

Motion Travel::carried(const pose::BoundClip& clip, const ClipClock& clock, std::span<Motion> room) const noexcept {
  for (const std::size_t node : chain_) {
    room[node] = Motion();
    room[node].pose = nodes_[node].rest;
    if (const std::uint32_t entry = clip.entry_of(node); entry != pose::BoundClip::no_entry)
      clip.sample_entry(entry, nodes_, clock, room[node]);
  }
  return root_.carried(room);
}

std::vector<Travel::Known>::const_iterator Travel::known_of(const Bearer& bearer) const noexcept {
  return std::ranges::find_if(
      known_, [&](const Known& each) { return each.operation == bearer.operation && each.clip == bearer.clip; });
}

Motion Travel::step_of(const Log& log, const Bearer& bearer, double from, double to, Side side,
                       std::span<Motion> room) const noexcept {
  const auto known = known_of(bearer);
  if (known == known_.end()) return standing();
  const auto clock_at = [&](double time, Side of) {
    ClipClock clock = bearer.operation->clock_of(log, bearer.clip, {time, of, bearer.start});
    clock.climbs = false;  // the travel does
    return clock;
  };
  const LoopMode mode = known->bound->clip().loop.mode;
  const bool goes_on = mode == LoopMode::repeat || mode == LoopMode::repeat_offset;
  const ClipClock first = clock_at(from, Side::out), last = clock_at(to, side);
  const Pose begin = carried(*known->bound, first, room).pose;
  const Motion end = carried(*known->bound, last, room);
  return known->travel.step(begin, goes_on ? first.cycle : 0, end, goes_on ? last.cycle : 0);
}

Motion Travel::step(const Log& log, const Bearers& first, double start, double from, double to, Side side,
                    std::span<Motion> room) const noexcept {
  if (first.count == 1 && !first.flow && is_whole(first.list[0].weight))
    return step_of(log, first.list[0], from, to, side, room);
  const Bearers last = bearers_at(log, {to, side, start});
  MeanStep mean;
  const auto add = [&](const Bearer& bearer, double before, const Sample<double>& after) {
    mean.add(step_of(log, bearer, from, to, side, room), 0.5 * (before + after.value), 0.5 * after.rate);
  };
  for (std::size_t i = 0; i < first.count; ++i) {
    const auto* const end = last.list.data() + last.count;
    const auto* const found =
        std::find_if(last.list.data(), end, [&](const Bearer& b) { return same(b, first.list[i]); });
    add(first.list[i], first.list[i].weight.value, found == end ? Sample<double>{0, 0, 0} : found->weight);
  }
  for (std::size_t i = 0; i < last.count; ++i) {
    const auto* const end = first.list.data() + first.count;
    if (std::find_if(first.list.data(), end, [&](const Bearer& b) { return same(b, last.list[i]); }) == end)
      add(last.list[i], 0, last.list[i].weight);
  }
  return mean.mean();
}

Pose Travel::place_at_start(const Log& log, double start, std::span<Motion> room) const noexcept {
  const Bearers bearers = bearers_at(log, {start, Side::out, start});
  MeanStep mean;
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    const auto known = known_of(each);
    if (known == known_.end()) continue;
    const ClipClock clock = each.operation->clock_of(log, each.clip, {start, Side::out, each.start});
    const Motion frame = carried(*known->bound, clock, room);
    if (bearers.count == 1 && is_whole(each.weight)) return frame.pose;
    mean.add(frame, each.weight.value, 0);
  }
  return mean.mean().pose;
}

Motion Travel::at(const Log& log, const Moment& moment, std::span<Motion> room) const noexcept {
  // What is not seen has not happened, and what is marked beyond it counts for nothing.
  const double unseen = log.until < never ? next_instant(log, log.until) : never;
  auto& trail = log.travels[number_].since(moment.start);
  const double sure = std::nextafter(unseen, -1.0);
  const double limit = std::min(moment.time, sure);
  const auto* const mark = trail.last_mark(limit, limit < moment.time || moment.side == Side::out);
  const double began = mark ? mark->time : moment.start;
  double here = began;
  Pose reached = mark ? mark->place : place_at_start(log, moment.start, room);
  for (;;) {
    const Bearers bearers = bearers_at(log, {here, Side::out, moment.start});
    double next = next_instant(log, here);
    if (next >= unseen) next = never;
    const bool alone = bearers.count == 0 || (bearers.count == 1 && is_whole(bearers.list[0].weight));
    if (bearers.flow || !alone) {
      next = std::min(next, next_stop(last_instant(log, moment.start, here, Side::out), here));
    }
    if (next > moment.time || (next == moment.time && moment.side == Side::in)) {
      if (here > began && here <= sure) trail.stay(here, reached);
      Motion from;
      from.pose = reached;
      return compose(from, step(log, bearers, moment.start, here, moment.time, moment.side, room));
    }
    reached = compose(reached, step(log, bearers, moment.start, here, next, Side::in, room).pose);
    here = next;
    if (here <= sure) trail.pass(here, reached);
  }
}

}  // namespace tweenfall::graphs
