#include "machine/condition.h"

#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::graphs {

namespace {

using Kind = GraphCondition::Kind;

bool compares(Kind kind, double value, double level) noexcept {
  if (kind == Kind::above) return value > level;
  return kind == Kind::below ? value < level : value == level;
}

// Halves until the two are neighbors among all numbers: the first at which the curve compares.
double first_between(const Curve<double>& curve, Kind kind, double level, double no, double yes) {
  for (;;) {
    const double middle = no + (yes - no) / 2;
    if (!(middle > no && middle < yes)) return yes;
    (compares(kind, curve.value(middle), level) ? yes : no) = middle;
  }
}

// Times at which a curve may come from one side of a level to the other, in order, in a stretch that is not long.
std::vector<double> crossings(const Curve<double>& curve, double level, double from, double to) {
  std::vector<double> times = solve(curve, level, from, to);
  const std::span<const double> knots = curve.knots();
  const double duration = curve.duration();
  const bool around = duration > 0 && std::isfinite(duration) &&
                      (curve.after() == Outside::repeat || curve.after() == Outside::repeat_offset);
  const double rounds = around ? std::floor((from - curve.start()) / duration) : 0;
  for (double round = std::max(0.0, rounds); round <= rounds + 1 + (to - from) / duration; ++round) {
    for (const double knot : knots)
      if (const double time = knot + round * duration; time > from && time < to) times.push_back(time);
    if (!around) break;
  }
  std::ranges::sort(times);
  times.push_back(to);
  return times;
}

// The first time in (after, until] at which a curve compares that did not just before.
std::optional<double> first_compared(const Curve<double>& curve, Kind kind, double level, double after, double until) {
  constexpr double stretch = 16;  // s, looked at at once
  bool before = compares(kind, curve.value(after), level);
  double at = after;
  while (at < until) {
    const double end = std::min(until, at + stretch);
    if (!(end > at)) return std::nullopt;
    for (const double next : crossings(curve, level, at, end)) {
      if (!(next > at)) continue;
      // Between two of them a curve stays on one side.
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
      return std::nullopt;  // when it is set
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
  if (!std::isfinite(condition.value)) binder.fault(place, "this is held against a finite number");
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
