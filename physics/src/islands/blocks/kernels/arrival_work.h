#pragma once

#include <cstddef>
#include <cstdint>

#include "islands/blocks/kernels/lane_work.h"

namespace tweenfall::blocks {

/// Finds contacts that arrive within a sub-step, and how far pressed contacts hold their bodies.
template <class Register>
struct ArrivalWork : LaneWork<Register> {
  using Lanes = LaneWork<Register>;
  using Lanes::angular;
  using Lanes::linear;
  using Lanes::measure;
  using Lanes::which_of;
  using typename Lanes::Number;
  using typename Lanes::Vector;
  using typename Lanes::Which;

  /// Reduces lags of bodies by what a contact along the normal holds.
  TWEENFALL_LANES static void hold_lags(BodyLag* lags, const std::uint32_t* at, const std::uint32_t* to,
                                        const Vector& normal, const Which& pressed, const Which& wholly) {
    const double* from[lane_count];
    double* back[lane_count];
    for (int i = 0; i < lane_count; ++i) {
      from[i] = lags[at[i]].lanes;
      back[i] = lags[to[i]].lanes;
    }
    Vector lag;
    Number known;
    gather(from, lag.x.of, lag.y.of, lag.z.of, known.of);
    const Number zero(0.0);
    const Number along = select(pressed, dot(normal, lag), zero);
    lag = lag - along * normal;
    lag = {select(wholly, zero, lag.x), select(wholly, zero, lag.y), select(wholly, zero, lag.z)};
    scatter(lag.x.of, lag.y.of, lag.z.of, select(pressed, Number(1.0), known).of, back);
  }

  TWEENFALL_LANES static void hold_block(const Rows& rows, const ContactBlock& block) {
    const Which pressed = Which::in(block.pressed);
    if (!pressed.any()) return;
    const Which held = pressed & Which::in(block.held);
    hold_lags(rows.lags, block.a, block.to_a, block.normal, pressed, held & ~which_of(block.round_a));
    hold_lags(rows.lags, block.b, block.to_b, block.normal, pressed, held & ~which_of(block.round_b));
  }
  TWEENFALL_LANES static void hold_balls(const Rows& rows, const BallBlock& block) {
    const Which pressed = Which::in(block.pressed);
    if (!pressed.any()) return;
    const Which none = Number(0.0) > Number(0.0);
    hold_lags(rows.lags, block.a, block.to_a, block.normal, pressed, none);
    hold_lags(rows.lags, block.b, block.to_b, block.normal, pressed, none);
  }

  /// Which points arrive within the sub-step fast enough.
  TWEENFALL_LANES static Which meeting(const MeetingRow& row, const Number& gap, const Number& closing,
                                       const Number& mass, double h) {
    const Number zero(0.0), pull = row.pull, tremble = row.tremble;
    const Number open = greater(gap, zero);
    const Number fall = Number(0.5 * h * h) * greater(pull, zero);
    const Which arrives = Number(h) * closing + fall >= Number(1 - 1e-9) * open;
    const Which fast = closing * closing + Number(2.0) * pull * open > tremble * tremble;
    return arrives & fast & (mass > zero) & (Number(row.heeded) > zero);
  }

  TWEENFALL_LANES static std::size_t note_meetings(const Which& meets, std::size_t block, std::uint32_t* found) {
    std::size_t count = 0;
    if (!meets.any()) return 0;
    Mask mask;
    meets.put(mask);
    for (int lane = 0; lane < lane_count; ++lane)
      if (mask[lane] != 0)
        found[count++] = static_cast<std::uint32_t>(lane_count * block) + static_cast<std::uint32_t>(lane);
    return count;
  }

  TWEENFALL_LANES static std::size_t find_meetings(const Rows& rows, const BodyLanes* starts, double h,
                                                   std::uint32_t* found) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
      const ContactBlock& block = rows.blocks[i];
      const MeetingRow& meetings = rows.meetings[i];
      measure(rows, block);
      if (!(Number(meetings.heeded) > Number(0.0)).any()) continue;
      const Number along = dot(block.normal, linear(starts, block.a) - linear(starts, block.b));
      const Vector angular_a = angular(starts, block.a), angular_b = angular(starts, block.b);
      Which meets = along > along;
      for (int k = 0; k < block.points; ++k) {
        const PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(k)];
        const Number closing = along + (dot(point.turn_a, angular_a) - dot(point.turn_b, angular_b));
        meets = meets | meeting(meetings, point.gap, closing, point.mass, h);
      }
      count += note_meetings(meets, i, found + count);
    }
    for (std::size_t i = 0; i < rows.ball_count; ++i) {
      BallBlock& block = rows.balls[i];
      measure(rows, block);
      const Number along = dot(block.normal, linear(starts, block.a) - linear(starts, block.b));
      count +=
          note_meetings(meeting(rows.ball_meetings[i], block.gap, along, block.mass, h), rows.count + i, found + count);
    }
    return count;
  }
};

}  // namespace tweenfall::blocks
