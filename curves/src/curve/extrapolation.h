#pragma once

// How a curve goes on beyond its knots, for every type of value.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

#include "curve/components.h"

namespace tweenfall::spans {

template <class T>
Sample<T> at_rest(const T& value) noexcept {
  return {value, zero_rate<Rate<T>>(), zero_rate<Rate<T>>()};
}

// `from`, continued for `seconds` at its rate.
template <class T>
Sample<T> straight_on(const Sample<T>& from, double seconds) noexcept {
  if constexpr (std::is_same_v<T, Quat>) {
    const Quat turn = exp_map(seconds * from.rate);
    return {turn * from.value, from.rate, Vec3::Zero()};
  } else if constexpr (std::is_same_v<T, Color>) {
    return {Color{from.value.rgba + seconds * from.rate}, from.rate, Vec4::Zero()};
  } else {
    return {from.value + seconds * from.rate, from.rate, zero_rate<Rate<T>>()};
  }
}

// `sample` moved to a later play of a curve that leads from `start` to `end`, each play starting where the last ended.
template <class T>
Sample<T> offset_by_plays(const Sample<T>& sample, const T& start, const T& end, double plays) noexcept {
  if constexpr (std::is_same_v<T, Quat>) {
    const Quat turn = exp_map(plays * log_map(end * start.conjugate()));
    return {turn * sample.value, turn * sample.rate, turn * sample.acceleration};
  } else if constexpr (std::is_same_v<T, Color>) {
    return {Color{sample.value.rgba + plays * (end.rgba - start.rgba)}, sample.rate, sample.acceleration};
  } else {
    return {sample.value + plays * (end - start), sample.rate, sample.acceleration};
  }
}

inline bool loops(Outside rule) noexcept {
  return rule != Outside::hold && rule != Outside::linear;
}

// The time at which a limited number of plays is over and the curve comes to rest; none where it goes on for ever.
template <class T>
std::optional<double> last_play(const OutsideRule<T>& rule, double start, double end, bool early) noexcept {
  if (!loops(rule.rule) || !(rule.plays > 0)) return std::nullopt;
  const double beyond = rule.plays * (end - start);
  return early ? start - beyond : end + beyond;
}

// Whether `time` lies further out than `end`; at `end` itself, whether `side` faces away from the curve.
inline bool is_beyond(double time, Side side, double end, bool early) noexcept {
  return time == end ? side == (early ? Side::in : Side::out) : early ? time < end : time > end;
}

// A time that is start + plays * duration + local, with 0 <= local < duration, or 0 < local <= duration on arrival.
struct PlayedTime {
  double local, plays;
};
inline PlayedTime played_time(double time, double start, double duration, bool arriving) noexcept {
  double local = std::fmod(time - start, duration);  // exact
  if (local < 0) local += duration;
  double plays = std::floor((time - start - local) / duration + 0.5);
  if (local >= duration) {
    local = 0;
    plays += 1;
  }
  if (local == 0 && arriving) {
    local = duration;
    plays -= 1;
  }
  return {local, plays};
}

// Whether a play of a loop goes backwards.
inline bool is_backward(Outside rule, double plays) noexcept {
  return rule == Outside::pingpong && std::fmod(plays, 2) != 0;
}

// The sample beyond the ends by `rule`; `inside(time, side)` samples from start to end, and `end_value(early)` gives
// the value arriving at the first knot or leaving the last one.
template <class T, class Inside, class EndValue>
Sample<T> sample_outside(Outside rule, double start, double end, double time, Side side, const Inside& inside,
                         const EndValue& end_value) noexcept {
  const bool early = time < start || (time == start && side == Side::in);
  const double duration = end - start;
  if (rule == Outside::hold || !(duration > 0)) return at_rest<T>(end_value(early));
  if (rule == Outside::linear) {
    Sample<T> from = early ? inside(start, Side::out) : inside(end, Side::in);
    from.value = end_value(early);
    return straight_on(from, time - (early ? start : end));
  }

  const auto [local, plays] = played_time(time, start, duration, side == Side::in);
  // Arriving at a seam counts as the end of the play before.
  const bool arriving = local == duration;
  if (is_backward(rule, plays)) {
    // The difference may round to before the start.
    const double mirrored = arriving ? start : std::max(start, end - local);
    Sample<T> s = inside(mirrored, side == Side::in ? Side::out : Side::in);
    s.rate = -s.rate;
    return s;
  }
  const Sample<T> s = inside(arriving ? end : start + local, side);
  if (rule != Outside::repeat_offset) return s;
  return offset_by_plays(s, end_value(true), end_value(false), plays);
}

}  // namespace tweenfall::spans
