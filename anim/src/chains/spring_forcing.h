#pragma once

// How a spring is driven by its target within a step, and the resulting state.

#include <tweenfall/anim/spring.h>

#include "chains/moving.h"

#include <utility>

namespace tweenfall::chains {

/// An acceleration as a polynomial of the seconds since the step began.
struct Forcing {
  Vec3 parts[4] = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
};

/// `gravity` minus the acceleration of the cubic from `from` to `to` in `h` seconds.
inline Forcing forcing(const Arrow& from, const Arrow& to, double h, const Vec3& gravity) noexcept {
  const Vec3 p = to.v - from.v - h * from.d, q = to.d - from.d;
  Forcing forcing;
  forcing.parts[0] = gravity - (2 / (h * h)) * (3 * p - h * q);
  forcing.parts[1] = (6 / (h * h * h)) * (2 * p - h * q);
  return forcing;
}

/// The same for the quintic that has their accelerations too.
inline Forcing forcing(const Sample<Vec3>& from, const Sample<Vec3>& to, double h, const Vec3& gravity) noexcept {
  const Vec3 p = to.value - from.value - h * from.rate - (0.5 * h * h) * from.acceleration,
             q = to.rate - from.rate - h * from.acceleration, r = to.acceleration - from.acceleration;
  const double h2 = h * h;
  Forcing forcing;
  forcing.parts[0] = gravity - from.acceleration;
  forcing.parts[1] = (-6 / (h2 * h)) * (10 * p - (4 * h) * q + (0.5 * h2) * r);
  forcing.parts[2] = (-12 / (h2 * h2)) * (-15 * p + (7 * h) * q - h2 * r);
  forcing.parts[3] = (-20 / (h2 * h2 * h)) * (6 * p - (3 * h) * q + (0.5 * h2) * r);
  return forcing;
}

/// An offset and its rate after a time, by its shares.
inline Arrow carried(const SpringShares& shares, const Arrow& offset, const Forcing& forcing) noexcept {
  Arrow result{shares.offset * offset.v + shares.rate * offset.d,
               shares.offset_in_rate * offset.v + shares.rate_in_rate * offset.d};
  for (int i = 0; i < 4; ++i) {
    result.v += shares.forced[i] * forcing.parts[i];
    result.d += shares.forced_in_rate[i] * forcing.parts[i];
  }
  return result;
}

/// Advances a state to the last point of the grid up to `time`: step by step, or by a reset to rest where its point is
/// later or too long ago. @param advance called with the number of the point from which it advances by one
template <class Rest, class Advance>
void advance_to(const SpringFollower& spring, std::int64_t& step, double time, const Rest& rest,
                const Advance& advance) noexcept {
  constexpr std::int64_t most = 4'000'000;
  const std::int64_t last = spring.step_at(time);
  if (last < step || last - step > most) {
    step = last;
    rest();
  }
  for (; step < last; ++step) advance(step);
}

/// Seconds since the point of the grid; at most one step, for times too large to be exact.
inline double seconds_into(const SpringFollower& spring, std::int64_t step, double time) noexcept {
  return std::clamp(time - spring.time_of(step), 0.0, 1 / spring.settings().steps_per_second);
}

/// Advances a state to the last point of the grid up to `time`. @param at, forcing as
/// below
template <class At, class ForcingOf>
void bring_to(const SpringFollower& spring, SpringState& state, double time, const At& at,
              const ForcingOf& forcing) noexcept {
  const auto rest = [&] { state.offset = state.rate = Vec3(0, 0, 0); };
  advance_to(spring, state.step, time, rest, [&](std::int64_t step) {
    const auto from = at(spring.time_of(step));
    const Arrow next =
        carried(spring.of_step(), {state.offset, state.rate}, forcing(from, at(spring.time_of(step + 1))));
    state.offset = next.v;
    state.rate = next.d;
  });
}

/// The offset of a spring at `time`, after its state was advanced to the point before.
/// @param at       the target at a time
/// @param forcing the forcing of the spring from two targets one step apart
template <class At, class ForcingOf>
Arrow offset_at(const SpringFollower& spring, SpringState& state, double time, const At& at,
                const ForcingOf& forcing) noexcept {
  auto from = at(spring.time_of(state.step));
  std::int64_t known = state.step;
  const auto driven = [&](std::int64_t step) {
    if (known != step) from = at(spring.time_of(step));
    const auto to = at(spring.time_of(step + 1));
    const Forcing result = forcing(from, to);
    from = to;
    known = step + 1;
    return result;
  };
  const auto rest = [&] { state.offset = state.rate = Vec3(0, 0, 0); };
  advance_to(spring, state.step, time, rest, [&](std::int64_t step) {
    const Arrow next = carried(spring.of_step(), {state.offset, state.rate}, driven(step));
    state.offset = next.v;
    state.rate = next.d;
  });
  return carried(spring.shares(seconds_into(spring, state.step, time)), {state.offset, state.rate}, driven(state.step));
}

}  // namespace tweenfall::chains
