#include "operations/travel.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::graphs {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The next end of a step: 480 times per second from an instant on, and half as often whenever the time since then has
/// doubled from 4096 s on, so that looking a million years ahead is fast.
/// @param round  s, after which what moves comes around: steps stay short beside it
double next_stop(double instant, double round, double after) noexcept {
  const double since = after - instant;
  double size = 1.0 / 480;
  for (double reach = 4096; since >= reach && 2 * size * steps_per_round <= round; reach *= 2) size *= 2;
  const double passed = std::floor(since / size);
  const double stop = instant + (passed + 1) * size;
  return stop > after ? stop : instant + (passed + 2) * size;
}

/// The least multiple of the longest of these rounds that is one of all; infinity where there is none up to 128.
double common_multiple(std::span<const double> rounds) noexcept {
  const double longest = *std::ranges::max_element(rounds);
  for (int times = 1; times <= 128; ++times) {
    const double whole = times * longest;
    const auto fits = [&](double round) {
      const double count = whole / round;
      return round == 0 || std::abs(count - std::round(count)) <= 1e-14 * count;
    };
    if (std::ranges::all_of(rounds, fits)) return longest > 0 ? whole : 1;
  }
  return never;
}

Motion standing() noexcept {
  return {};
}

/// A step, or a sum of parts of steps, in the axes half way through its turn, in which a steady turn moves straight.
struct Stride {
  Vec3 turn{0, 0, 0}, way{0, 0, 0};

  friend Stride operator+(const Stride& a, const Stride& b) noexcept { return {a.turn + b.turn, a.way + b.way}; }
  friend Stride operator-(const Stride& a, const Stride& b) noexcept { return {a.turn - b.turn, a.way - b.way}; }
  friend Stride operator*(double factor, const Stride& a) noexcept { return {factor * a.turn, factor * a.way}; }
};
struct MovingStride {
  Stride at, rate;

  void add(const MovingStride& other) noexcept {
    at = at + other.at;
    rate = rate + other.rate;
  }
};

MovingStride stride_of(const Motion& step) noexcept {
  MovingStride stride;
  const Vec3 turn = log_map(step.pose.rotation);
  const Quat back = exp_map(Vec3(-0.5 * turn));
  stride.at = {turn, back * step.pose.position};
  stride.rate.turn = right_jacobian_inverse(Vec3(-turn)) * step.twist.angular;
  const Vec3 spin = right_jacobian(Vec3(0.5 * turn)) * Vec3(-0.5 * stride.rate.turn);  // of `back`
  stride.rate.way = back * step.twist.linear + spin.cross(stride.at.way);
  return stride;
}

/// The velocity in the motion's own axes.
Stride own_velocity(const Motion& motion) noexcept {
  const Quat back = motion.pose.rotation.conjugate();
  return {back * motion.twist.angular, back * motion.twist.linear};
}

Motion motion_of(const MovingStride& stride) noexcept {
  Motion motion;
  const Vec3& turn = stride.at.turn;
  const Quat half = exp_map(Vec3(0.5 * turn));
  const Vec3 spin = right_jacobian(Vec3(-0.5 * turn)) * Vec3(0.5 * stride.rate.turn);
  motion.pose.rotation = exp_map(turn);
  motion.twist.angular = right_jacobian(Vec3(-turn)) * stride.rate.turn;
  motion.pose.position = half * stride.at.way;
  motion.twist.linear = half * stride.rate.way + spin.cross(motion.pose.position);
  return motion;
}

/// A cubic from 0 at 0 s, by its rates at 0 s and at h and its value at h: first x + second x^2 + third x^3.
template <class Value>
struct Cubic {
  Value first, second, third;

  Cubic(const Value& rate, const Value& last, const Value& last_rate, double h) noexcept
      : first(rate),
        second((1 / h) * ((3 / h) * last - 2 * rate - last_rate)),
        third((1 / (h * h)) * (rate + last_rate - (2 / h) * last)) {}
};

/// The contribution of a clip to a step from 0 to h: the integral of its weight over its stride d, by parts (W(0) +
/// W)/2 d plus 1/2 of the integral of (W - W(0)) d' - W' d, where W is the cubic from the weights and their rates at
/// both ends. The second integral, which is 0 while the weight is constant, uses a cubic for d too. So the rate is W d'
/// at both ends, and everywhere the exact derivative.
MovingStride part_of(const Sample<double>& before, const Sample<double>& after, const Stride& first_rate,
                     const MovingStride& last, const MovingStride& now, double x, double h) noexcept {
  const Cubic<double> weight(before.rate, after.value - before.value, after.rate, h);
  const Cubic<Stride> way(first_rate, last.at, last.rate, h);
  const double mean = before.value + 0.5 * x * (weight.first + x * (weight.second + x * weight.third));
  const double mean_rate = 0.5 * (weight.first + x * (2 * weight.second + x * (3 * weight.third)));
  const Stride second = weight.first * way.second - weight.second * way.first,
               third = weight.first * way.third - weight.third * way.first,
               fourth = weight.second * way.third - weight.third * way.second;
  const double x2 = x * x;
  return {mean * now.at + (0.5 * x2 * x) * ((1. / 3) * second + (0.5 * x) * third + (0.2 * x2) * fourth),
          mean * now.rate + mean_rate * now.at + (0.5 * x2) * (second + (2 * x) * third + x2 * fourth)};
}

/// The correction to the rate of a stride so that its velocity, in its own axes, is `own`.
Stride missing(const MovingStride& stride, const Stride& own) noexcept {
  const Vec3& turn = stride.at.turn;
  const Quat half = exp_map(Vec3(0.5 * turn)), whole = exp_map(turn);
  Stride rate;
  rate.turn = right_jacobian_inverse(Vec3(-turn)) * Vec3(whole * own.turn);
  const Vec3 spin = right_jacobian(Vec3(-0.5 * turn)) * Vec3(0.5 * rate.turn);
  rate.way = half.conjugate() * Vec3(whole * own.way - spin.cross(Vec3(half * stride.at.way)));
  return rate - stride.rate;
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

ClipClock Travel::clock_of(const Log& log, const Bearer& bearer, double time, Side side) const noexcept {
  ClipClock clock = bearer.operation->clock_of(log, bearer.clip, {time, side, bearer.start});
  clock.climbs = false;  // the travel adds the loops
  return clock;
}

Motion Travel::step_of(const Known& known, const Place& from, const Place& to) noexcept {
  const LoopMode mode = known.bound->clip().loop.mode;
  const bool goes_on = mode == LoopMode::repeat || mode == LoopMode::repeat_offset;
  return known.travel.step(from.motion.pose, goes_on ? from.cycle : 0, to.motion, goes_on ? to.cycle : 0);
}

Motion Travel::step(const Log& log, const Bearers& first, const Step& step, double to, Side side,
                    std::span<Motion> room) const noexcept {
  const auto place = [&](const Known& known, const Bearer& bearer, double time, Side of) {
    const ClipClock clock = clock_of(log, bearer, time, of);
    return Place{carried(*known.bound, clock, room), static_cast<double>(clock.cycle)};
  };
  if (step.alone) {
    const auto known = known_of(first.list[0]);
    if (first.count == 0 || known == known_.end()) return standing();
    return step_of(*known, place(*known, first.list[0], step.from, Side::out), place(*known, first.list[0], to, side));
  }
  // Planned to its end as if nothing more happened: the path until the next instant depends only on what is known here.
  const double h = step.end - step.from, x = to - step.from;
  const auto at_end = [&](const auto& ask) {
    const Blinkers blinkers(log, step.from);
    return ask();
  };
  const Bearers last = at_end([&] { return bearers_at(log, {step.end, Side::in, step.start}); });
  MovingStride sum, whole;
  Stride own;  // velocity at the end, in the axes there
  const auto add = [&](const Bearer& bearer, const Sample<double>& before, const Sample<double>& after) {
    const auto known = known_of(bearer);
    if (known == known_.end()) return;
    const Place begin = place(*known, bearer, step.from, Side::out);
    const Place finish = at_end([&] { return place(*known, bearer, step.end, Side::in); });
    const Motion done = step_of(*known, begin, finish);
    const MovingStride end = stride_of(done);
    const Stride velocity = own_velocity(begin.motion);
    own = own + after.value * own_velocity(done);
    whole.add(part_of(before, after, velocity, end, end, h, h));
    if (x < h)
      sum.add(part_of(before, after, velocity, end, stride_of(step_of(*known, begin, place(*known, bearer, to, side))),
                      x, h));
  };
  constexpr Sample<double> nothing{0, 0, 0};
  for (std::size_t i = 0; i < first.count; ++i) {
    const Bearer* const found = last.find(first.list[i]);
    add(first.list[i], first.list[i].weight, found ? found->weight : nothing);
  }
  for (std::size_t i = 0; i < last.count; ++i)
    if (!first.find(last.list[i])) add(last.list[i], nothing, last.list[i].weight);
  // Strides that turn differently are added in their half-way axes; the velocity at the end must be the mean of theirs.
  const Stride lag = missing(whole, own);
  if (!(x < h)) return motion_of({whole.at, whole.rate + lag});
  const double u = x / h;
  const Stride haste{step.haste.angular, step.haste.linear};
  return motion_of({sum.at + (x * u * (u - 1)) * lag + (x * (1 - u) * (1 - u)) * haste,
                    sum.rate + (u * (3 * u - 2)) * lag + ((1 - u) * (1 - 3 * u)) * haste});
}

Twist Travel::haste_at(const Log& log, double start, double time, const Motion& step,
                       std::span<Motion> room) const noexcept {
  Stride haste = own_velocity(step);
  const Bearers bearers = bearers_at(log, {time, Side::in, start});
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    const auto known = known_of(each);
    if (known == known_.end()) continue;
    const Motion motion = carried(*known->bound, clock_of(log, each, time, Side::in), room);
    haste = haste - each.weight.value * own_velocity(motion);
  }
  return {haste.way, haste.turn};
}

std::optional<double> Travel::lap_of(const Log& log, const Bearers& bearers, double time) noexcept {
  if (bearers.flow || bearers.count == 0) return {};
  std::array<double, Bearers::most> rounds{};
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    if (each.weight.rate != 0) return {};
    rounds[i] = each.operation->round_of(log, each.clip, {time, Side::out, each.start});
    if (!std::isfinite(rounds[i])) return {};
  }
  return common_multiple({rounds.data(), bearers.count});
}

Pose Travel::place_at_start(const Log& log, double start, std::span<Motion> room) const noexcept {
  const Bearers bearers = bearers_at(log, {start, Side::out, start});
  MovingStride mean;
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    const auto known = known_of(each);
    if (known == known_.end()) continue;
    const ClipClock clock = each.operation->clock_of(log, each.clip, {start, Side::out, each.start});
    const Motion frame = carried(*known->bound, clock, room);
    if (bearers.count == 1 && is_whole(each.weight)) return frame.pose;
    mean.at = mean.at + each.weight.value * stride_of(frame).at;
  }
  return motion_of(mean).pose;
}

Motion Travel::lapped(const Log& log, const Moment& moment, const TravelPlace& reached,
                      std::span<Motion> room) const noexcept {
  // Whatever rounding does, what is asked of the first lap lies in it: another lap would be asked forever.
  const double since = reached.since, lap = reached.lap, end = since + lap;
  double laps = std::max(1.0, std::floor((moment.time - since) / lap));
  double time = std::clamp(moment.time - laps * lap, since, end);
  if (time == since && moment.side == Side::in) {
    laps -= 1;
    time = end;
  } else if (time == end && moment.side == Side::out) {
    laps += 1;
    time = since;
  }
  const Pose back = undone(reached.base), whole = compose(back, reached.pose);
  Motion ahead;
  ahead.pose = compose(compose(reached.base, repeated(whole, laps)), back);
  return compose(ahead, at(log, {time, moment.side, moment.start}, room));
}

Motion Travel::at(const Log& log, const Moment& moment, std::span<Motion> room) const noexcept {
  // Hidden inputs have not happened, and marks beyond them do not count.
  const double sure = last_sure(log);
  auto& trail = log.travels[number_].since(moment.start);
  const double limit = std::min(moment.time, sure);
  const auto* const mark = trail.last_mark(limit, limit < moment.time || moment.side == Side::out);
  const double began = mark ? mark->time : moment.start;
  double here = began;
  TravelPlace reached = mark ? mark->place : TravelPlace{place_at_start(log, moment.start, room), {}};
  for (;;) {
    const Bearers bearers = bearers_at(log, {here, Side::out, moment.start});
    double instant = next_instant(log, here);
    if (instant > sure) instant = never;
    instant = std::min(instant, bearers.flow_from);
    const bool happens = instant < moment.time || (instant == moment.time && moment.side == Side::out);
    double next = instant;
    Step own{moment.start, here, never, true, reached.haste};
    own.alone = !bearers.flow && (bearers.count == 0 || (bearers.count == 1 && is_whole(bearers.list[0].weight)));
    if (!own.alone) {
      // What a step was cut short by decays first, and is in no lap.
      if (reached.since < 0 && reached.haste.linear.isZero(0) && reached.haste.angular.isZero(0)) {
        const std::optional<double> lap = lap_of(log, bearers, here);
        if (lap) reached = {.pose = reached.pose, .since = here, .lap = *lap, .base = reached.pose};
      }
      const double lap_end = reached.since < 0 ? never : reached.since + reached.lap;
      if (here >= lap_end) {
        if (here > began && here <= sure) trail.stay(here, reached);
        if (!happens) return lapped(log, moment, reached, room);
        const Motion gone = lapped(log, {instant, Side::in, moment.start}, reached, room);
        reached = {.pose = gone.pose, .haste = haste_at(log, moment.start, instant, gone, room)};
        here = instant;
        if (here <= sure) trail.pass(here, reached);
        continue;
      }
      own.end =
          std::min(lap_end, next_stop(std::max(last_instant(log, moment.start, here, Side::out), bearers.flow_since),
                                      bearers.round, here));
      next = std::min(next, own.end);
    }
    if (next > moment.time || (next == moment.time && moment.side == Side::in)) {
      if (here > began && here <= sure) trail.stay(here, reached);
      Motion from;
      from.pose = reached.pose;
      return compose(from, step(log, bearers, own, moment.time, moment.side, room));
    }
    const Motion gone = step(log, bearers, own, next, Side::in, room);
    reached.pose = compose(reached.pose, gone.pose);
    reached.haste = {};
    if (!own.alone && next < own.end) reached.haste = haste_at(log, moment.start, next, gone, room);
    if (next == instant) reached.since = -1;
    here = next;
    if (here <= sure) trail.pass(here, reached);
  }
}

}  // namespace tweenfall::graphs
