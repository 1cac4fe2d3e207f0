#include <cstddef>

#include "blocks/contact_block.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::blocks {

namespace {

/// Two bodies in each lane. Along the normal and the tangents their relative speed is kept by itself, so that a row
/// changes numbers and not vectors; in the end their velocities get the sum of what the rows gave.
struct Pair {
  Lanes3 linear_a, angular_a, linear_b, angular_b;
  Lanes along, slip1, slip2;         ///< of the linear velocities, b against a
  Lanes pushed, dragged1, dragged2;  ///< N s
};

TWEENFALL_LANES Lanes load(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
TWEENFALL_LANES void store(double* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

/// Four vectors from rows of x, y, z and nothing.
TWEENFALL_LANES Lanes3 gathered(const double* r0, const double* r1, const double* r2, const double* r3) {
  const Lanes a = load(r0), b = load(r1), c = load(r2), d = load(r3);
  const Lanes even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {__builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5), __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5),
          __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7)};
}

/// Back to rows of x, y, z and `last`.
TWEENFALL_LANES void scatter(const Lanes3& v, const Lanes& last, double* r0, double* r1, double* r2, double* r3) {
  const Lanes low_xy = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6),
              high_xy = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
  const Lanes low_z = __builtin_shufflevector(v.z, last, 0, 4, 2, 6),
              high_z = __builtin_shufflevector(v.z, last, 1, 5, 3, 7);
  store(r0, __builtin_shufflevector(low_xy, low_z, 0, 1, 4, 5));
  store(r1, __builtin_shufflevector(high_xy, high_z, 0, 1, 4, 5));
  store(r2, __builtin_shufflevector(low_xy, low_z, 2, 3, 6, 7));
  store(r3, __builtin_shufflevector(high_xy, high_z, 2, 3, 6, 7));
}

TWEENFALL_LANES Lanes3 linear(const BodyLanes* bodies, const std::uint32_t* at) {
  return gathered(bodies[at[0]].linear, bodies[at[1]].linear, bodies[at[2]].linear, bodies[at[3]].linear);
}
TWEENFALL_LANES Lanes3 angular(const BodyLanes* bodies, const std::uint32_t* at) {
  return gathered(bodies[at[0]].angular, bodies[at[1]].angular, bodies[at[2]].angular, bodies[at[3]].angular);
}
TWEENFALL_LANES void put_linear(const Lanes3& v, BodyLanes* bodies, const std::uint32_t* at) {
  scatter(v, all(0), bodies[at[0]].linear, bodies[at[1]].linear, bodies[at[2]].linear, bodies[at[3]].linear);
}
TWEENFALL_LANES void put_angular(const Lanes3& v, BodyLanes* bodies, const std::uint32_t* at) {
  scatter(v, all(0), bodies[at[0]].angular, bodies[at[1]].angular, bodies[at[2]].angular, bodies[at[3]].angular);
}

TWEENFALL_LANES Pair pair_of(const BodyLanes* bodies, const ContactBlock& block) {
  Pair pair;
  pair.linear_a = linear(bodies, block.a);
  pair.angular_a = angular(bodies, block.a);
  pair.linear_b = linear(bodies, block.b);
  pair.angular_b = angular(bodies, block.b);
  const Lanes3 slip = pair.linear_b - pair.linear_a;
  pair.along = dot(block.normal, slip);
  pair.slip1 = dot(block.tangent1, slip);
  pair.slip2 = dot(block.tangent2, slip);
  pair.pushed = pair.dragged1 = pair.dragged2 = all(0);
  return pair;
}

TWEENFALL_LANES void put_back(const Pair& pair, BodyLanes* bodies, const ContactBlock& block) {
  const Lanes3 impulse = pair.pushed * block.normal + (pair.dragged1 * block.tangent1 + pair.dragged2 * block.tangent2);
  put_linear(pair.linear_a - block.inverse_mass_a * impulse, bodies, block.to_a);
  put_angular(pair.angular_a, bodies, block.to_a);
  put_linear(pair.linear_b + block.inverse_mass_b * impulse, bodies, block.to_b);
  put_angular(pair.angular_b, bodies, block.to_b);
}

template <bool even>
TWEENFALL_LANES void turn(Pair& pair, const ContactBlock& block, const InertiaRow* inertia, const Lanes3& turn_a,
                          const Lanes3& turn_b) {
  if constexpr (even) {
    pair.angular_a = pair.angular_a - block.inverse_moment_a * turn_a;
    pair.angular_b = pair.angular_b + block.inverse_moment_b * turn_b;
  } else {
    pair.angular_a = pair.angular_a - inertia->inverse_a * turn_a;
    pair.angular_b = pair.angular_b + inertia->inverse_b * turn_b;
  }
}

template <bool even>
TWEENFALL_LANES void warm_start_block(const Rows& rows, ContactBlock& block) {
  const Lanes3 turned_a = angular(rows.displacements, block.a), turned_b = angular(rows.displacements, block.b);
  const Lanes drift = dot(block.normal, linear(rows.displacements, block.b) - linear(rows.displacements, block.a));
  Lanes3 turn_a{all(0), all(0), all(0)}, turn_b = turn_a;
  Pair pair = pair_of(rows.velocities, block);
  for (int i = 0; i < block.points; ++i) {
    PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(i)];
    point.gap = point.base + (drift + (dot(point.turn_b, turned_b) - dot(point.turn_a, turned_a)));
    pair.pushed = pair.pushed + point.impulse;
    turn_a = turn_a + point.impulse * point.turn_a;
    turn_b = turn_b + point.impulse * point.turn_b;
  }
  for (int i = 0; i < block.frictions; ++i) {
    const FrictionRow& row = rows.frictions[block.friction + static_cast<std::uint32_t>(i)];
    pair.dragged1 = pair.dragged1 + row.first;
    pair.dragged2 = pair.dragged2 + row.second;
    turn_a = turn_a + (row.first * row.first_a + row.second * row.second_a);
    turn_b = turn_b + (row.first * row.first_b + row.second * row.second_b);
  }
  if (block.central()) {
    turn_a = turn_a + block.twist * block.normal;
    turn_b = turn_b + block.twist * block.normal;
  }
  turn<even>(pair, block, rows.inertias + block.inertia, turn_a, turn_b);
  put_back(pair, rows.velocities, block);
}

template <bool even>
TWEENFALL_LANES void solve_friction(Pair& pair, const ContactBlock& block, const InertiaRow* inertia,
                                    const Lanes& inverse_mass, FrictionRow& row, const DriftRow* drift,
                                    const Lanes& limit) {
  Lanes slip1 = pair.slip1 + (dot(row.first_b, pair.angular_b) - dot(row.first_a, pair.angular_a));
  Lanes slip2 = pair.slip2 + (dot(row.second_b, pair.angular_b) - dot(row.second_a, pair.angular_a));
  if (drift) {
    slip1 = slip1 + drift->first;
    slip2 = slip2 + drift->second;
  }
  Lanes next1 = row.first - (row.inverse11 * slip1 + row.inverse12 * slip2);
  Lanes next2 = row.second - (row.inverse12 * slip1 + row.inverse22 * slip2);
  const Lanes most = limit * limit;
  const Mask outside = next1 * next1 + next2 * next2 > most;
  if (any(outside)) {
    // A step along the slip brought back to the cone's edge: in the end friction opposes the slip exactly.
    const Lanes edge1 = row.first - row.firm * slip1;
    const Lanes edge2 = row.second - row.firm * slip2;
    const Lanes square = edge1 * edge1 + edge2 * edge2;
    const Lanes share = select(square > most, limit / root(square), all(1));
    next1 = select(outside, share * edge1, next1);
    next2 = select(outside, share * edge2, next2);
  }
  const Lanes change1 = next1 - row.first;
  const Lanes change2 = next2 - row.second;
  row.first = next1;
  row.second = next2;
  pair.dragged1 = pair.dragged1 + change1;
  pair.dragged2 = pair.dragged2 + change2;
  pair.slip1 = pair.slip1 + inverse_mass * change1;
  pair.slip2 = pair.slip2 + inverse_mass * change2;
  turn<even>(pair, block, inertia, change1 * row.first_a + change2 * row.second_a,
             change1 * row.first_b + change2 * row.second_b);
}

template <bool even>
TWEENFALL_LANES void solve_twist(Pair& pair, ContactBlock& block, const InertiaRow* inertia, const DriftRow* drift,
                                 const Lanes& limit) {
  Lanes speed = dot(block.normal, pair.angular_b - pair.angular_a);
  if (drift) speed = speed + drift->twist;
  const Lanes next = greater(-limit, lesser(limit, block.twist - block.twist_mass * speed));
  const Lanes3 change = (next - block.twist) * block.normal;
  block.twist = next;
  turn<even>(pair, block, inertia, change, change);
}

TWEENFALL_LANES Mask inside(const FrictionRow& row, const Lanes& most) {
  return row.first * row.first + row.second * row.second < all(0.999) * most * most;
}

/// What friction holds, and what slides on the edge of the cone.
TWEENFALL_LANES void note_grip(const PointRow* points, const FrictionRow* frictions, ContactBlock& block) {
  const Lanes zero = all(0);
  Lanes pressing = zero;
  block.held = zero > zero;
  for (int i = 0; i < block.points; ++i) {
    pressing = pressing + points[i].impulse;
    if (block.frictions == block.points)
      block.held = block.held | inside(frictions[i], block.coefficient * points[i].impulse);
  }
  if (block.central()) block.held = inside(frictions[0], block.coefficient * pressing);
  block.pressed = pressing > zero;
}

/// The impulse along the normal by which two bodies with this gap and closing speed get on.
TWEENFALL_LANES Lanes next_normal(const Lanes& gap, const Lanes& impulse, const Lanes& mass, const Mask& hard,
                                  const Lanes& speed, const PassRule& rule) {
  const Lanes zero = all(0);
  // A gap may close within the sub-step, but not further.
  const Mask apart = gap > zero;
  const Lanes wanted = select(apart, -gap * all(rule.inverse_h), lesser(-gap * all(rule.rate), all(rule.speed)));
  const Mask stiff = apart | hard;
  const Lanes keeping = select(stiff, all(1), all(rule.keeping));
  const Lanes firm = select(stiff, all(1), all(rule.firm));
  return greater(zero, keeping * impulse - firm * mass * (speed - wanted));
}

template <bool even>
TWEENFALL_LANES void solve_block(const Rows& rows, ContactBlock& block, const PassRule& rule) {
  Pair pair = pair_of(rows.velocities, block);
  PointRow* points = rows.points + block.point;
  FrictionRow* frictions = rows.frictions + block.friction;
  const DriftRow* drifts = block.drifts ? rows.drifts + block.friction : nullptr;
  const InertiaRow* inertia = rows.inertias + block.inertia;
  const Lanes inverse_mass = block.inverse_mass_a + block.inverse_mass_b;
  if (block.central()) {
    Lanes pressing = all(0), twisting = all(0);
    for (int i = 0; i < block.points; ++i) {
      pressing = pressing + points[i].impulse;
      twisting = twisting + points[i].impulse * points[i].lever;
    }
    solve_twist<even>(pair, block, inertia, drifts, block.coefficient * twisting);
    solve_friction<even>(pair, block, inertia, inverse_mass, frictions[0], drifts, block.coefficient * pressing);
  } else {
    for (int i = 0; i < block.frictions; ++i)
      solve_friction<even>(pair, block, inertia, inverse_mass, frictions[i], drifts ? drifts + i : nullptr,
                           block.coefficient * points[i].impulse);
  }
  for (int i = 0; i < block.points; ++i) {
    PointRow& point = points[i];
    const Lanes speed = pair.along + (dot(point.turn_b, pair.angular_b) - dot(point.turn_a, pair.angular_a));
    const Lanes next = next_normal(point.gap, point.impulse, point.mass, block.hard, speed, rule);
    const Lanes change = next - point.impulse;
    point.impulse = next;
    pair.pushed = pair.pushed + change;
    pair.along = pair.along + inverse_mass * change;
    turn<even>(pair, block, inertia, change * point.turn_a, change * point.turn_b);
  }
  put_back(pair, rows.velocities, block);
  if (rule.note) note_grip(points, frictions, block);
  if (!rule.sum_up) return;
  for (int i = 0; i < block.points; ++i) points[i].total = points[i].total + points[i].impulse;
  for (int i = 0; i < block.frictions; ++i) {
    frictions[i].total_first = frictions[i].total_first + frictions[i].first;
    frictions[i].total_second = frictions[i].total_second + frictions[i].second;
  }
  block.total_twist = block.total_twist + block.twist;
}

TWEENFALL_LANES void warm_start_balls(const Rows& rows, BallBlock& block) {
  block.gap = block.base + dot(block.normal, linear(rows.displacements, block.b) - linear(rows.displacements, block.a));
  const Lanes3 impulse = block.impulse * block.normal + block.friction;
  const Lanes3 turn = cross(block.normal, block.friction);
  put_linear(linear(rows.velocities, block.a) - block.inverse_mass_a * impulse, rows.velocities, block.to_a);
  put_angular(angular(rows.velocities, block.a) - block.spin_a * turn, rows.velocities, block.to_a);
  put_linear(linear(rows.velocities, block.b) + block.inverse_mass_b * impulse, rows.velocities, block.to_b);
  put_angular(angular(rows.velocities, block.b) - block.spin_b * turn, rows.velocities, block.to_b);
}

TWEENFALL_LANES void solve_balls(const Rows& rows, BallBlock& block, const PassRule& rule) {
  const Lanes3 linear_a = linear(rows.velocities, block.a), linear_b = linear(rows.velocities, block.b);
  const Lanes3 angular_a = angular(rows.velocities, block.a), angular_b = angular(rows.velocities, block.b);
  const Lanes3 relative = linear_b - linear_a;
  const Lanes along = dot(block.normal, relative);
  const Lanes3 slip =
      relative - along * block.normal - cross(block.arm_a * angular_a + block.arm_b * angular_b, block.normal);
  // What would stop the slip points against it: brought back to the cone's edge it opposes the slip exactly.
  Lanes3 friction = block.friction - block.slip_mass * slip;
  const Lanes limit = block.coefficient * block.impulse;
  const Lanes square = dot(friction, friction), most = limit * limit;
  const Mask outside = square > most;
  if (any(outside)) friction = select(outside, limit / root(square), all(1)) * friction;
  const Lanes next = next_normal(block.gap, block.impulse, block.mass, block.hard, along, rule);
  const Lanes3 dragged = friction - block.friction;
  const Lanes3 impulse = (next - block.impulse) * block.normal + dragged;
  const Lanes3 turn = cross(block.normal, dragged);
  block.friction = friction;
  block.impulse = next;
  put_linear(linear_a - block.inverse_mass_a * impulse, rows.velocities, block.to_a);
  put_angular(angular_a - block.spin_a * turn, rows.velocities, block.to_a);
  put_linear(linear_b + block.inverse_mass_b * impulse, rows.velocities, block.to_b);
  put_angular(angular_b - block.spin_b * turn, rows.velocities, block.to_b);
  if (rule.note) block.pressed = next > all(0);
  if (!rule.sum_up) return;
  block.total = block.total + next;
  block.total_friction = block.total_friction + friction;
}

TWEENFALL_LANES Mask mask_of(const std::int8_t* lanes) {
  return Mask{lanes[0], lanes[1], lanes[2], lanes[3]};
}

/// Lags of four bodies, less what a contact along the normal holds.
TWEENFALL_LANES void hold_lags(BodyLag* lags, const std::uint32_t* at, const std::uint32_t* to, const Lanes3& normal,
                               const Mask& pressed, const Mask& wholly) {
  const double *r0 = lags[at[0]].lanes, *r1 = lags[at[1]].lanes, *r2 = lags[at[2]].lanes, *r3 = lags[at[3]].lanes;
  const Lanes known{r0[3], r1[3], r2[3], r3[3]};
  Lanes3 lag = gathered(r0, r1, r2, r3);
  const Lanes zero = all(0);
  const Lanes along = select(pressed, dot(normal, lag), zero);
  lag = lag - along * normal;
  lag = {select(wholly, zero, lag.x), select(wholly, zero, lag.y), select(wholly, zero, lag.z)};
  scatter(lag, select(pressed, all(1), known), lags[to[0]].lanes, lags[to[1]].lanes, lags[to[2]].lanes,
          lags[to[3]].lanes);
}

TWEENFALL_LANES void hold_block(const Rows& rows, const ContactBlock& block) {
  if (!any(block.pressed)) return;
  const Mask held = block.pressed & block.held;
  hold_lags(rows.lags, block.a, block.to_a, block.normal, block.pressed, held & ~mask_of(block.round_a));
  hold_lags(rows.lags, block.b, block.to_b, block.normal, block.pressed, held & ~mask_of(block.round_b));
}
TWEENFALL_LANES void hold_balls(const Rows& rows, const BallBlock& block) {
  if (!any(block.pressed)) return;
  const Mask none = all(0) > all(0);
  hold_lags(rows.lags, block.a, block.to_a, block.normal, block.pressed, none);
  hold_lags(rows.lags, block.b, block.to_b, block.normal, block.pressed, none);
}

/// Which points arrive within the sub-step, and fast enough.
TWEENFALL_LANES Mask meeting(const MeetingRow& row, const Lanes& gap, const Lanes& closing, const Lanes& mass,
                             double h) {
  const Lanes open = greater(gap, all(0));
  const Lanes fall = all(0.5 * h * h) * greater(row.pull, all(0));
  const Mask arrives = all(h) * closing + fall >= all(1 - 1e-9) * open;
  const Mask fast = closing * closing + all(2) * row.pull * open > row.tremble * row.tremble;
  return arrives & fast & (mass > all(0)) & (row.restitution > all(0));
}

TWEENFALL_LANES std::size_t note_meetings(const Mask& meets, std::size_t block, std::uint32_t* found) {
  std::size_t count = 0;
  if (!any(meets)) return 0;
  for (int lane = 0; lane < lane_count; ++lane)
    if (meets[lane] != 0)
      found[count++] = static_cast<std::uint32_t>(lane_count * block) + static_cast<std::uint32_t>(lane);
  return count;
}

TWEENFALL_LANES std::size_t find_all_meetings(const Rows& rows, const BodyLanes* starts, double h,
                                              std::uint32_t* found) {
  std::size_t count = 0;
  const Lanes zero = all(0);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const ContactBlock& block = rows.blocks[i];
    const MeetingRow& meetings = rows.meetings[i];
    if (!any(meetings.restitution > zero)) continue;
    const Lanes along = dot(block.normal, linear(starts, block.a) - linear(starts, block.b));
    const Lanes3 angular_a = angular(starts, block.a), angular_b = angular(starts, block.b);
    Mask meets = zero > zero;
    for (int k = 0; k < block.points; ++k) {
      const PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(k)];
      const Lanes closing = along + (dot(point.turn_a, angular_a) - dot(point.turn_b, angular_b));
      meets = meets | meeting(meetings, point.gap, closing, point.mass, h);
    }
    count += note_meetings(meets, i, found + count);
  }
  for (std::size_t i = 0; i < rows.ball_count; ++i) {
    const BallBlock& block = rows.balls[i];
    const Lanes along = dot(block.normal, linear(starts, block.a) - linear(starts, block.b));
    count +=
        note_meetings(meeting(rows.ball_meetings[i], block.gap, along, block.mass, h), rows.count + i, found + count);
  }
  return count;
}

struct WarmStart {
  const Rows& rows;
  TWEENFALL_LANES void operator()(ContactBlock& block) const {
    if (block.even)
      warm_start_block<true>(rows, block);
    else
      warm_start_block<false>(rows, block);
  }
  TWEENFALL_LANES void operator()(BallBlock& block) const { warm_start_balls(rows, block); }
};
struct Solve {
  const Rows& rows;
  const PassRule& rule;
  TWEENFALL_LANES void operator()(ContactBlock& block) const {
    if (block.even)
      solve_block<true>(rows, block, rule);
    else
      solve_block<false>(rows, block, rule);
  }
  TWEENFALL_LANES void operator()(BallBlock& block) const { solve_balls(rows, block, rule); }
};
struct Hold {
  const Rows& rows;
  TWEENFALL_LANES void operator()(const ContactBlock& block) const { hold_block(rows, block); }
  TWEENFALL_LANES void operator()(const BallBlock& block) const { hold_balls(rows, block); }
};

/// Balls and blocks of two movable bodies, then those of one.
template <class Work>
TWEENFALL_LANES void do_all(const Rows& rows, const Work& work) {
  for (std::size_t i = 0; i < rows.ball_pairs; ++i) work(rows.balls[i]);
  for (std::size_t i = 0; i < rows.pairs; ++i) work(rows.blocks[i]);
  for (std::size_t i = rows.ball_pairs; i < rows.ball_count; ++i) work(rows.balls[i]);
  for (std::size_t i = rows.pairs; i < rows.count; ++i) work(rows.blocks[i]);
}

// The same source for each instruction set. None of them has a fused multiply and add, so the bits are the same.
void warm_start_plain(const Rows& rows) {
  do_all(rows, WarmStart{rows});
}
void solve_plain(const Rows& rows, const PassRule& rule) {
  do_all(rows, Solve{rows, rule});
}
void hold_plain(const Rows& rows) {
  do_all(rows, Hold{rows});
}
std::size_t find_meetings_plain(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found) {
  return find_all_meetings(rows, starts, h, found);
}

#if defined(__x86_64__) || defined(__i386__)
[[gnu::target("avx2")]] void warm_start_avx2(const Rows& rows) {
  do_all(rows, WarmStart{rows});
}
[[gnu::target("avx2")]] void solve_avx2(const Rows& rows, const PassRule& rule) {
  do_all(rows, Solve{rows, rule});
}
[[gnu::target("avx2")]] void hold_avx2(const Rows& rows) {
  do_all(rows, Hold{rows});
}
[[gnu::target("avx2")]] std::size_t find_meetings_avx2(const Rows& rows, const BodyLanes* starts, double h,
                                                       std::uint32_t* found) {
  return find_all_meetings(rows, starts, h, found);
}
#endif

constexpr Kernels plain = {warm_start_plain, solve_plain, hold_plain, find_meetings_plain};

}  // namespace

const Kernels& plain_kernels() {
  return plain;
}

const Kernels& fastest_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr Kernels avx2 = {warm_start_avx2, solve_avx2, hold_avx2, find_meetings_avx2};
  if (__builtin_cpu_supports("avx2")) return avx2;
#endif
  return plain;
}

}  // namespace tweenfall::blocks
