#include <cstddef>

#include "blocks/contact_block.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::blocks {

namespace {

struct Pair {
  Lanes3 linear_a, angular_a, linear_b, angular_b;
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

TWEENFALL_LANES void scatter(const Lanes3& v, double* r0, double* r1, double* r2, double* r3) {
  const Lanes zero = all(0);
  const Lanes low_xy = __builtin_shufflevector(v.x, v.y, 0, 4, 1, 5),
              high_xy = __builtin_shufflevector(v.x, v.y, 2, 6, 3, 7);
  const Lanes low_z = __builtin_shufflevector(v.z, zero, 0, 4, 1, 5),
              high_z = __builtin_shufflevector(v.z, zero, 2, 6, 3, 7);
  store(r0, __builtin_shufflevector(low_xy, low_z, 0, 1, 4, 5));
  store(r1, __builtin_shufflevector(low_xy, low_z, 2, 3, 6, 7));
  store(r2, __builtin_shufflevector(high_xy, high_z, 0, 1, 4, 5));
  store(r3, __builtin_shufflevector(high_xy, high_z, 2, 3, 6, 7));
}

TWEENFALL_LANES Lanes3 linear(const BodyLanes* bodies, const std::uint32_t* at) {
  return gathered(bodies[at[0]].linear, bodies[at[1]].linear, bodies[at[2]].linear, bodies[at[3]].linear);
}
TWEENFALL_LANES Lanes3 angular(const BodyLanes* bodies, const std::uint32_t* at) {
  return gathered(bodies[at[0]].angular, bodies[at[1]].angular, bodies[at[2]].angular, bodies[at[3]].angular);
}

TWEENFALL_LANES Pair pair_of(const BodyLanes* bodies, const ContactBlock& block) {
  return {linear(bodies, block.a), angular(bodies, block.a), linear(bodies, block.b), angular(bodies, block.b)};
}

TWEENFALL_LANES void put_back(const Pair& pair, BodyLanes* bodies, const ContactBlock& block) {
  const auto put = [bodies](const Lanes3& linear, const Lanes3& angular, const std::uint32_t* at) {
    scatter(linear, bodies[at[0]].linear, bodies[at[1]].linear, bodies[at[2]].linear, bodies[at[3]].linear);
    scatter(angular, bodies[at[0]].angular, bodies[at[1]].angular, bodies[at[2]].angular, bodies[at[3]].angular);
  };
  put(pair.linear_a, pair.angular_a, block.a);
  put(pair.linear_b, pair.angular_b, block.b);
}

TWEENFALL_LANES void push(Pair& pair, const ContactBlock& block, const Lanes3& impulse, const Lanes3& turn_a,
                          const Lanes3& turn_b) {
  pair.linear_a = pair.linear_a - block.inverse_mass_a * impulse;
  pair.angular_a = pair.angular_a - block.inverse_inertia_a * turn_a;
  pair.linear_b = pair.linear_b + block.inverse_mass_b * impulse;
  pair.angular_b = pair.angular_b + block.inverse_inertia_b * turn_b;
}

TWEENFALL_LANES void warm_start_block(const Rows& rows, ContactBlock& block) {
  const Pair moved = pair_of(rows.displacements, block);
  const Lanes drift = dot(block.normal, moved.linear_b - moved.linear_a);
  Lanes3 impulse{all(0), all(0), all(0)}, turn_a = impulse, turn_b = impulse;
  Lanes sum = all(0);
  for (int i = 0; i < block.points; ++i) {
    PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(i)];
    point.gap = point.base + (drift + dot(point.turn_b, moved.angular_b) - dot(point.turn_a, moved.angular_a));
    sum = sum + point.impulse;
    turn_a = turn_a + point.impulse * point.turn_a;
    turn_b = turn_b + point.impulse * point.turn_b;
  }
  impulse = sum * block.normal;
  for (int i = 0; i < block.frictions; ++i) {
    const FrictionRow& row = rows.frictions[block.friction + static_cast<std::uint32_t>(i)];
    impulse = impulse + row.first * block.tangent1 + row.second * block.tangent2;
    turn_a = turn_a + row.first * row.first_a + row.second * row.second_a;
    turn_b = turn_b + row.first * row.first_b + row.second * row.second_b;
  }
  if (block.central()) {
    turn_a = turn_a + block.twist * block.normal;
    turn_b = turn_b + block.twist * block.normal;
  }
  Pair pair = pair_of(rows.velocities, block);
  push(pair, block, impulse, turn_a, turn_b);
  put_back(pair, rows.velocities, block);
}

TWEENFALL_LANES void solve_friction(Pair& pair, const ContactBlock& block, FrictionRow& row, const Lanes& limit) {
  const Lanes3 slip = pair.linear_b - pair.linear_a;
  const Lanes slip1 = dot(block.tangent1, slip) + (dot(row.first_b, pair.angular_b) - dot(row.first_a, pair.angular_a));
  const Lanes slip2 =
      dot(block.tangent2, slip) + (dot(row.second_b, pair.angular_b) - dot(row.second_a, pair.angular_a));
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
  push(pair, block, change1 * block.tangent1 + change2 * block.tangent2, change1 * row.first_a + change2 * row.second_a,
       change1 * row.first_b + change2 * row.second_b);
}

TWEENFALL_LANES void solve_twist(Pair& pair, ContactBlock& block, const Lanes& limit) {
  const Lanes speed = dot(block.normal, pair.angular_b - pair.angular_a);
  const Lanes next = greater(-limit, lesser(limit, block.twist - block.twist_mass * speed));
  const Lanes3 change = (next - block.twist) * block.normal;
  block.twist = next;
  pair.angular_a = pair.angular_a - block.inverse_inertia_a * change;
  pair.angular_b = pair.angular_b + block.inverse_inertia_b * change;
}

/// What friction holds, and what slides on the edge of the cone.
TWEENFALL_LANES void note_grip(const PointRow* points, const FrictionRow* frictions, ContactBlock& block) {
  const Lanes zero = all(0);
  Lanes pressing = zero;
  block.held = zero > zero;
  const auto inside = [&block](const FrictionRow& row, const Lanes& normal) -> Mask {
    const Lanes most = block.coefficient * normal;
    return row.first * row.first + row.second * row.second < all(0.999) * most * most;
  };
  for (int i = 0; i < block.points; ++i) {
    pressing = pressing + points[i].impulse;
    if (block.frictions == block.points) block.held = block.held | inside(frictions[i], points[i].impulse);
  }
  if (block.central()) block.held = inside(frictions[0], pressing);
  block.pressed = pressing > zero;
}

TWEENFALL_LANES void solve_block(const Rows& rows, ContactBlock& block, const PassRule& rule) {
  Pair pair = pair_of(rows.velocities, block);
  PointRow* points = rows.points + block.point;
  FrictionRow* frictions = rows.frictions + block.friction;
  if (block.central()) {
    Lanes pressing = all(0), twisting = all(0);
    for (int i = 0; i < block.points; ++i) {
      pressing = pressing + points[i].impulse;
      twisting = twisting + points[i].impulse * points[i].lever;
    }
    solve_twist(pair, block, block.coefficient * twisting);
    solve_friction(pair, block, frictions[0], block.coefficient * pressing);
  } else {
    for (int i = 0; i < block.frictions; ++i)
      solve_friction(pair, block, frictions[i], block.coefficient * points[i].impulse);
  }
  const Lanes zero = all(0);
  for (int i = 0; i < block.points; ++i) {
    PointRow& point = points[i];
    const Lanes speed = dot(block.normal, pair.linear_b - pair.linear_a) +
                        (dot(point.turn_b, pair.angular_b) - dot(point.turn_a, pair.angular_a));
    // A gap may close within the sub-step, but not further.
    const Mask apart = point.gap > zero;
    const Lanes wanted =
        select(apart, -point.gap * all(rule.inverse_h), lesser(-point.gap * all(rule.rate), all(rule.speed)));
    const Mask stiff = apart | block.hard;
    const Lanes keeping = select(stiff, all(1), all(rule.keeping));
    const Lanes firm = select(stiff, all(1), all(rule.firm));
    const Lanes next = greater(zero, keeping * point.impulse - firm * point.mass * (speed - wanted));
    const Lanes change = next - point.impulse;
    point.impulse = next;
    push(pair, block, change * block.normal, change * point.turn_a, change * point.turn_b);
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

TWEENFALL_LANES std::size_t find_all_meetings(const Rows& rows, const BodyLanes* starts, double h,
                                              std::uint32_t* found) {
  std::size_t count = 0;
  const Lanes zero = all(0);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const ContactBlock& block = rows.blocks[i];
    if (!any(block.restitution > zero)) continue;
    const Pair start = pair_of(starts, block);
    const Lanes along = dot(block.normal, start.linear_a - start.linear_b);
    const Lanes fall = all(0.5 * h * h) * greater(block.pull, zero);
    Mask meets = zero > zero;
    for (int k = 0; k < block.points; ++k) {
      const PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(k)];
      const Lanes closing = along + (dot(point.turn_a, start.angular_a) - dot(point.turn_b, start.angular_b));
      const Lanes gap = greater(point.gap, zero);
      const Mask arrives = all(h) * closing + fall >= all(1 - 1e-9) * gap;
      const Mask fast = closing * closing + all(2) * block.pull * gap > block.tremble * block.tremble;
      meets = meets | (arrives & fast & (point.mass > zero));
    }
    meets = meets & (block.restitution > zero);
    if (!any(meets)) continue;
    for (int lane = 0; lane < lane_count; ++lane)
      if (meets[lane] != 0)
        found[count++] = static_cast<std::uint32_t>(lane_count * i) + static_cast<std::uint32_t>(lane);
  }
  return count;
}

TWEENFALL_LANES void warm_start_all(const Rows& rows) {
  for (std::size_t i = 0; i < rows.count; ++i) warm_start_block(rows, rows.blocks[i]);
}
TWEENFALL_LANES void solve_all(const Rows& rows, const PassRule& rule) {
  for (std::size_t i = 0; i < rows.count; ++i) solve_block(rows, rows.blocks[i], rule);
}

// The same source for each instruction set. None of them has a fused multiply and add, so the bits are the same.
void warm_start_plain(const Rows& rows) {
  warm_start_all(rows);
}
void solve_plain(const Rows& rows, const PassRule& rule) {
  solve_all(rows, rule);
}
std::size_t find_meetings_plain(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found) {
  return find_all_meetings(rows, starts, h, found);
}

#if defined(__x86_64__) || defined(__i386__)
[[gnu::target("avx2")]] void warm_start_avx2(const Rows& rows) {
  warm_start_all(rows);
}
[[gnu::target("avx2")]] void solve_avx2(const Rows& rows, const PassRule& rule) {
  solve_all(rows, rule);
}
[[gnu::target("avx2")]] std::size_t find_meetings_avx2(const Rows& rows, const BodyLanes* starts, double h,
                                                       std::uint32_t* found) {
  return find_all_meetings(rows, starts, h, found);
}
#endif

constexpr Kernels plain = {warm_start_plain, solve_plain, find_meetings_plain};

}  // namespace

const Kernels& plain_kernels() {
  return plain;
}

const Kernels& fastest_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr Kernels avx2 = {warm_start_avx2, solve_avx2, find_meetings_avx2};
  if (__builtin_cpu_supports("avx2")) return avx2;
#endif
  return plain;
}

}  // namespace tweenfall::blocks
