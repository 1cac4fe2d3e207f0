#include "machine/condition.h"

#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tweenfall::graphs {

namespace {

using Kind = GraphCondition::Kind;

bool compares(Kind kind, double value, double level) noexcept {
  if (kind == Kind::above) return value > level;
  return kind == Kind::below ? value < level : value == level;
}

// Bisects until the two times are adjacent doubles; returns the first at which the comparison holds.
double first_between(const Curve<double>& curve, Kind kind, double level, double no, double yes) {
  for (;;) {
    const double middle = no + (yes - no) / 2;
    if (!(middle > no && middle < yes)) return yes;
    (compares(kind, curve.value(middle), level) ? yes : no) = middle;
  }
}

/// How a curve goes on beyond one end of its keys, where that comes around.
struct Around {
  double duration = 0;  // of a round, s; 0: it does not come around
  double gain = 0;      // what each round adds to the one before
  bool turns = false;   // every other one is played backwards

  Around(const Curve<double>& curve, Outside rule) {
    if (rule == Outside::hold || rule == Outside::linear) return;
    if (!(curve.duration() > 0) || !std::isfinite(curve.duration())) return;
    duration = curve.duration();
    turns = rule == Outside::pingpong;
    if (rule == Outside::repeat_offset) gain = curve.value(curve.end(), Side::in) - curve.value(curve.start());
  }
};

// Times in (from, to) at which a curve may come from one side of a level to the other, in a stretch of few rounds
// beyond one end: told of the keys' own round, for far away sums of lengths are not exact.
void add_of_rounds(const Curve<double>& curve, const Around& around, double level, double from, double to,
                   std::vector<double>& times) {
  const double start = curve.start(), first = std::floor((from - start) / around.duration) - 1;
  const double last = std::floor((to - start) / around.duration) + 1;
  // By their count: where numbers are great, one more is the same number.
  for (double count = 0; count <= last - first; ++count) {
    const double round = first + count;
    std::vector<double> own = solve(curve, level - round * around.gain, start, curve.end());
    own.insert(own.end(), curve.knots().begin(), curve.knots().end());
    const bool is_backwards = around.turns && std::fmod(round, 2) != 0;
    for (const double time : own) {
      const double passed = is_backwards ? around.duration - (time - start) : time - start;
      if (const double met = start + round * around.duration + passed; met > from && met < to) times.push_back(met);
    }
  }
}

// The first time in (at, until] at which a curve compares that did not just before; both on one side of each end of the
// keys.
std::optional<double> first_within(const Curve<double>& curve, const Around& around, Kind kind, double level, double at,
                                   double until) {
  constexpr double longest = 16, most_rounds = 64;  // s and rounds, looked at at once
  const bool comes_around = around.duration > 0;
  if (comes_around && around.gain == 0) {
    // Once there and back shows all that ever comes.
    until = std::min(until, at + 3 * around.duration);
  } else if (comes_around) {
    // The level is within reach of few rounds.
    const Range reach = range(curve, curve.start(), curve.end());
    const double one = (level - reach.low) / around.gain, other = (level - reach.high) / around.gain;
    at = std::max(at, curve.start() + (std::floor(std::min(one, other)) - 1) * around.duration);
    until = std::min(until, curve.start() + (std::ceil(std::max(one, other)) + 2) * around.duration);
  }
  const double stretch = comes_around ? std::min(longest, most_rounds * around.duration) : longest;
  bool before = compares(kind, curve.value(at), level);
  std::vector<double> times;
  while (at < until) {
    const double end = std::min(until, at + stretch);
    if (!(end > at)) return std::nullopt;
    times.clear();
    if (comes_around) {
      add_of_rounds(curve, around, level, at, end, times);
    } else {
      times = solve(curve, level, at, end);
      for (const double knot : curve.knots())
        if (knot > at && knot < end) times.push_back(knot);
    }
    std::ranges::sort(times);
    times.push_back(end);
    for (const double next : times) {
      if (!(next > at)) continue;
      // Between two crossings the curve stays on one side.
      const double middle = at + (next - at) / 2;
      for (const double time : {middle, next}) {
        if (!(time > at)) continue;
        const bool now = compares(kind, curve.value(time), level);
        if (now && !before) return first_between(curve, kind, level, at, time);
        before = now;
        at = time;
      }
    }
    at = end;
    if (curve.knots().empty() && std::isfinite(curve.end()) && at > curve.end()) return std::nullopt;
  }
  return std::nullopt;
}

// The same across the ends of the keys.
std::optional<double> first_compared(const Curve<double>& curve, Kind kind, double level, double after, double until) {
  const Around earlier(curve, curve.before()), later(curve, curve.after()), keyed(curve, Outside::hold);
  const double start = earlier.duration > 0 ? curve.start() : after, end = later.duration > 0 ? curve.end() : until;
  for (const auto& [around, limit] : {std::pair{&earlier, start}, std::pair{&keyed, end}, std::pair{&later, until}}) {
    const double to = std::min(until, limit);
    if (!(after < to)) continue;
    if (const auto found = first_within(curve, *around, kind, level, after, to)) return found;
    after = to;
  }
  return std::nullopt;
}

}  // namespace

bool Condition::holds(const Log& log, const GraphDescription& description, const Standing& state, double time,
                      std::optional<std::string_view> told) const {
  switch (kind) {
    case Kind::above:
    case Kind::below:
    case Kind::equals:
      return compares(kind, value_of(log, description, parameter, time, Side::out), value);
    case Kind::time_in_state:
      return time >= state.since + value;
    case Kind::clip_end:
      return time >= state.pose.end(log, state.since);
    case Kind::event:
      if (told) return *told == event;
      return state.pose.next_event(log, event, state.since, std::nextafter(time, -1.0), time).has_value();
  }
  return false;
}

std::optional<double> Condition::next(const Log& log, const GraphDescription& description, const Standing& state,
                                      double after, double until) const {
  const auto later = [&](double time) { return time > after && time <= until ? std::optional(time) : std::nullopt; };
  switch (kind) {
    case Kind::above:
    case Kind::below:
    case Kind::equals:
      if (const auto& curve = description.parameters[parameter].curve)
        return first_compared(*curve, kind, value, after, until);
      return std::nullopt;  // changes only by an input
    case Kind::time_in_state:
      return later(state.since + value);
    case Kind::clip_end:
      return later(state.pose.end(log, state.since));
    case Kind::event:
      return state.pose.next_event(log, event, state.since, after, until);
  }
  return std::nullopt;
}

std::optional<Condition> bound(const GraphCondition& condition, const Place& place, Binder& binder) {
  if (!std::isfinite(condition.value)) binder.fault(place, "this is compared with a finite number");
  switch (condition.kind) {
    case Kind::above:
    case Kind::below:
    case Kind::equals:
      if (const auto found = binder.parameter(condition.name, place))
        return Condition{condition.kind, {}, *found, condition.value};
      return std::nullopt;
    case Kind::event:
      if (condition.name.empty()) binder.fault(place, "an event has a name");
      break;
    case Kind::time_in_state:
      if (!(condition.value >= 0))
        binder.fault(place, "a time in the state is 0 s or more; it is " + number_text(condition.value) + " s");
      break;
    case Kind::clip_end:
      break;
  }
  return Condition{condition.kind, condition.name, 0, condition.value};
}

}  // namespace tweenfall::graphs
