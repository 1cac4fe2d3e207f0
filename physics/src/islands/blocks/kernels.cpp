#include <array>
#include <cstddef>

#include "islands/blocks/registers.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::blocks {

namespace {

/// Of a speed, the part that what is added to it and taken away again may leave.
constexpr double rounding_of_speed = 1e-15;

/// What is done with blocks, in registers of one kind.
template <class Register>
struct RowWork {
  using Number = Wide<Register>;
  using Vector = Wide3<Register>;
  using Which = typename Number::Which;

  /// Two bodies in each lane. Along the normal and the tangents their relative speed is kept by itself, so that a row
  /// changes numbers and not vectors; in the end their velocities get the sum of what the rows gave.
  struct Pair {
    Vector linear_a, angular_a, linear_b, angular_b;
    Number along, slip1, slip2;         ///< of the linear velocities, b against a
    Number pushed, dragged1, dragged2;  ///< N s
  };

  TWEENFALL_LANES static Vector gathered(const double* const* rows) {
    Vector v;
    Number nothing;
    gather(rows, v.x.of, v.y.of, v.z.of, nothing.of);
    return v;
  }
  TWEENFALL_LANES static Vector linear(const BodyLanes* bodies, const std::uint32_t* at) {
    const double* rows[lane_count];
    for (int i = 0; i < lane_count; ++i) rows[i] = bodies[at[i]].linear;
    return gathered(rows);
  }
  TWEENFALL_LANES static Vector angular(const BodyLanes* bodies, const std::uint32_t* at) {
    const double* rows[lane_count];
    for (int i = 0; i < lane_count; ++i) rows[i] = bodies[at[i]].angular;
    return gathered(rows);
  }
  TWEENFALL_LANES static void put_linear(const Vector& v, BodyLanes* bodies, const std::uint32_t* at) {
    double* rows[lane_count];
    for (int i = 0; i < lane_count; ++i) rows[i] = bodies[at[i]].linear;
    scatter(v.x.of, v.y.of, v.z.of, Number(0.0).of, rows);
  }
  TWEENFALL_LANES static void put_angular(const Vector& v, BodyLanes* bodies, const std::uint32_t* at) {
    double* rows[lane_count];
    for (int i = 0; i < lane_count; ++i) rows[i] = bodies[at[i]].angular;
    scatter(v.x.of, v.y.of, v.z.of, Number(0.0).of, rows);
  }

  TWEENFALL_LANES static Pair pair_of(const BodyLanes* bodies, const ContactBlock& block) {
    Pair pair;
    pair.linear_a = linear(bodies, block.a);
    pair.angular_a = angular(bodies, block.a);
    pair.linear_b = linear(bodies, block.b);
    pair.angular_b = angular(bodies, block.b);
    const Vector slip = pair.linear_b - pair.linear_a;
    pair.along = dot(block.normal, slip);
    pair.slip1 = dot(block.tangent1, slip);
    pair.slip2 = dot(block.tangent2, slip);
    pair.pushed = pair.dragged1 = pair.dragged2 = Number(0.0);
    return pair;
  }

  TWEENFALL_LANES static void put_back(const Pair& pair, BodyLanes* bodies, const ContactBlock& block) {
    const Vector impulse =
        pair.pushed * block.normal + (pair.dragged1 * block.tangent1 + pair.dragged2 * block.tangent2);
    put_linear(pair.linear_a - Number(block.inverse_mass_a) * impulse, bodies, block.to_a);
    put_angular(pair.angular_a, bodies, block.to_a);
    put_linear(pair.linear_b + Number(block.inverse_mass_b) * impulse, bodies, block.to_b);
    put_angular(pair.angular_b, bodies, block.to_b);
  }

  template <bool even>
  TWEENFALL_LANES static void turn(Pair& pair, const ContactBlock& block, const InertiaRow* inertia,
                                   const Vector& turn_a, const Vector& turn_b) {
    if constexpr (even) {
      pair.angular_a = pair.angular_a - Number(block.inverse_moment_a) * turn_a;
      pair.angular_b = pair.angular_b + Number(block.inverse_moment_b) * turn_b;
    } else {
      pair.angular_a = pair.angular_a - inertia->inverse_a * turn_a;
      pair.angular_b = pair.angular_b + inertia->inverse_b * turn_b;
    }
  }

  TWEENFALL_LANES static Number sum_of_sizes(const Vector& v) {
    return greater(v.x, -v.x) + (greater(v.y, -v.y) + greater(v.z, -v.z));
  }

  /// Looks on while rows change: of a single pass nothing is asked.
  struct Unwatched {
    TWEENFALL_LANES Number keep(const Number& next, const Number&) const { return next; }
    TWEENFALL_LANES void note(const Number&, const Number&) const {}
  };
  /// Of several passes, what has settled stays as it is.
  struct Watched {
    Number enough;
    Which stirs, changed;

    /// @param given  the speed that the impulses at the start have given
    /// @param speed  the greatest there is, or more
    TWEENFALL_LANES Watched(const PassRule& rule, const Number& given, const Number& speed)
        : enough(rule.enough * given + Number(rounding_of_speed) * speed) {
      const Number zero(0.0);
      stirs = zero >= zero;
      changed = zero > zero;
    }
    TWEENFALL_LANES Number keep(const Number& next, const Number& before) const { return select(stirs, next, before); }
    /// @param change  of an impulse
    /// @param mass  what a unit of speed takes
    TWEENFALL_LANES void note(const Number& change, const Number& mass) {
      changed = changed | (greater(change, -change) > enough * mass);
    }
    /// After a pass. @return whether there is anything left to do
    TWEENFALL_LANES bool goes_on() {
      stirs = stirs & changed;
      changed = enough > enough;
      return stirs.any();
    }
  };

  template <bool even>
  TWEENFALL_LANES static void warm_start_block(const Rows& rows, ContactBlock& block) {
    const Vector turned_a = angular(rows.displacements, block.a), turned_b = angular(rows.displacements, block.b);
    const Number drift = dot(block.normal, linear(rows.displacements, block.b) - linear(rows.displacements, block.a));
    Vector turn_a{Number(0.0), Number(0.0), Number(0.0)}, turn_b = turn_a;
    Pair pair = pair_of(rows.velocities, block);
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(i)];
      const Number impulse = point.impulse;
      const Vector its_a = point.turn_a, its_b = point.turn_b;
      (point.base + (drift + (dot(its_b, turned_b) - dot(its_a, turned_a)))).put(point.gap);
      pair.pushed = pair.pushed + impulse;
      turn_a = turn_a + impulse * its_a;
      turn_b = turn_b + impulse * its_b;
    }
    for (int i = 0; i < block.frictions; ++i) {
      const FrictionRow& row = rows.frictions[block.friction + static_cast<std::uint32_t>(i)];
      const Number first = row.first, second = row.second;
      pair.dragged1 = pair.dragged1 + first;
      pair.dragged2 = pair.dragged2 + second;
      turn_a = turn_a + (first * row.first_a + second * row.second_a);
      turn_b = turn_b + (first * row.first_b + second * row.second_b);
    }
    if (block.central()) {
      const Vector twist = Number(block.twist) * block.normal;
      turn_a = turn_a + twist;
      turn_b = turn_b + twist;
    }
    turn<even>(pair, block, rows.inertias + block.inertia, turn_a, turn_b);
    put_back(pair, rows.velocities, block);
  }

  template <bool even, class Watch>
  TWEENFALL_LANES static void solve_friction(Pair& pair, const ContactBlock& block, const InertiaRow* inertia,
                                             const Number& inverse_mass, FrictionRow& row, const DriftRow* drift,
                                             const Number& limit, Watch& watch) {
    Number slip1 = pair.slip1 + (dot(row.first_b, pair.angular_b) - dot(row.first_a, pair.angular_a));
    Number slip2 = pair.slip2 + (dot(row.second_b, pair.angular_b) - dot(row.second_a, pair.angular_a));
    if (drift) {
      slip1 = slip1 + drift->first;
      slip2 = slip2 + drift->second;
    }
    const Number first = row.first, second = row.second;
    Number next1 = first - (row.inverse11 * slip1 + row.inverse12 * slip2);
    Number next2 = second - (row.inverse12 * slip1 + row.inverse22 * slip2);
    const Number most = limit * limit;
    const Which outside = next1 * next1 + next2 * next2 > most;
    if (outside.any()) {
      // A step along the slip brought back to the cone's edge: in the end friction opposes the slip exactly.
      const Number edge1 = first - row.firm * slip1;
      const Number edge2 = second - row.firm * slip2;
      const Number square = edge1 * edge1 + edge2 * edge2;
      const Number share = select(square > most, limit / root(square), Number(1.0));
      next1 = select(outside, share * edge1, next1);
      next2 = select(outside, share * edge2, next2);
    }
    next1 = watch.keep(next1, first);
    next2 = watch.keep(next2, second);
    const Number change1 = next1 - first;
    const Number change2 = next2 - second;
    watch.note(change1, row.firm);
    watch.note(change2, row.firm);
    next1.put(row.first);
    next2.put(row.second);
    pair.dragged1 = pair.dragged1 + change1;
    pair.dragged2 = pair.dragged2 + change2;
    pair.slip1 = pair.slip1 + inverse_mass * change1;
    pair.slip2 = pair.slip2 + inverse_mass * change2;
    turn<even>(pair, block, inertia, change1 * row.first_a + change2 * row.second_a,
               change1 * row.first_b + change2 * row.second_b);
  }

  template <bool even, class Watch>
  TWEENFALL_LANES static void solve_twist(Pair& pair, ContactBlock& block, const InertiaRow* inertia,
                                          const DriftRow* drift, const Number& limit, Watch& watch) {
    Number speed = dot(block.normal, pair.angular_b - pair.angular_a);
    if (drift) speed = speed + drift->twist;
    const Number twist = block.twist;
    const Number next = watch.keep(greater(-limit, lesser(limit, twist - block.twist_mass * speed)), twist);
    watch.note(next - twist, block.twist_mass);
    const Vector change = (next - twist) * block.normal;
    next.put(block.twist);
    turn<even>(pair, block, inertia, change, change);
  }

  TWEENFALL_LANES static Which inside(const FrictionRow& row, const Number& most) {
    const Number first = row.first, second = row.second;
    return first * first + second * second < Number(0.999) * most * most;
  }

  /// What friction holds, and what slides on the edge of the cone.
  TWEENFALL_LANES static void note_grip(const PointRow* points, const FrictionRow* frictions, ContactBlock& block) {
    Number pressing(0.0);
    Which held = pressing > pressing;
    const Number coefficient = block.coefficient;
    for (int i = 0; i < block.points; ++i) {
      pressing = pressing + points[i].impulse;
      if (block.frictions == block.points) held = held | inside(frictions[i], coefficient * points[i].impulse);
    }
    if (block.central()) held = inside(frictions[0], coefficient * pressing);
    held.put(block.held);
    (pressing > Number(0.0)).put(block.pressed);
  }

  /// The impulse along the normal by which two bodies with this gap and closing speed get on.
  TWEENFALL_LANES static Number next_normal(const Number& gap, const Number& impulse, const Number& mass,
                                            const Mask& hard, const Number& speed, const PassRule& rule) {
    const Number zero(0.0), one(1.0);
    // A gap may close within the sub-step, but not further.
    const Which apart = gap > zero;
    const Number wanted = select(apart, -gap * rule.inverse_h, lesser(-gap * rule.rate, rule.speed));
    const Which stiff = apart | Which::in(hard);
    const Number keeping = select(stiff, one, rule.keeping);
    const Number firm = select(stiff, one, rule.firm);
    return greater(zero, keeping * impulse - firm * mass * (speed - wanted));
  }

  template <bool even, class Watch>
  TWEENFALL_LANES static void pass_over(const Rows& rows, ContactBlock& block, const PassRule& rule, Pair& pair,
                                        Watch& watch) {
    PointRow* points = rows.points + block.point;
    FrictionRow* frictions = rows.frictions + block.friction;
    const DriftRow* drifts = block.drifts ? rows.drifts + block.friction : nullptr;
    const InertiaRow* inertia = rows.inertias + block.inertia;
    const Number inverse_mass = Number(block.inverse_mass_a) + block.inverse_mass_b;
    if (block.central()) {
      Number pressing(0.0), twisting(0.0);
      for (int i = 0; i < block.points; ++i) {
        const Number impulse = points[i].impulse;
        pressing = pressing + impulse;
        twisting = twisting + impulse * points[i].lever;
      }
      const Number coefficient = block.coefficient;
      solve_twist<even>(pair, block, inertia, drifts, coefficient * twisting, watch);
      solve_friction<even>(pair, block, inertia, inverse_mass, frictions[0], drifts, coefficient * pressing, watch);
    } else {
      for (int i = 0; i < block.frictions; ++i)
        solve_friction<even>(pair, block, inertia, inverse_mass, frictions[i], drifts ? drifts + i : nullptr,
                             Number(block.coefficient) * points[i].impulse, watch);
    }
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = points[i];
      const Vector turn_a = point.turn_a, turn_b = point.turn_b;
      const Number impulse = point.impulse;
      const Number speed = pair.along + (dot(turn_b, pair.angular_b) - dot(turn_a, pair.angular_a));
      const Number next = watch.keep(next_normal(point.gap, impulse, point.mass, block.hard, speed, rule), impulse);
      const Number change = next - impulse;
      watch.note(change, point.mass);
      next.put(point.impulse);
      pair.pushed = pair.pushed + change;
      pair.along = pair.along + inverse_mass * change;
      turn<even>(pair, block, inertia, change * turn_a, change * turn_b);
    }
  }

  template <bool even>
  TWEENFALL_LANES static void solve_block(const Rows& rows, ContactBlock& block, const PassRule& rule) {
    Pair pair = pair_of(rows.velocities, block);
    if (rule.passes == 1) {
      Unwatched watch;
      pass_over<even>(rows, block, rule, pair, watch);
    } else {
      Number pressing(0.0);
      for (int i = 0; i < block.points; ++i)
        pressing = pressing + rows.points[block.point + static_cast<std::uint32_t>(i)].impulse;
      Watched watch(rule, (Number(block.inverse_mass_a) + block.inverse_mass_b) * pressing,
                    sum_of_sizes(pair.linear_a) + sum_of_sizes(pair.linear_b));
      for (int k = 0; k < rule.passes; ++k) {
        pass_over<even>(rows, block, rule, pair, watch);
        if (!watch.goes_on()) break;
      }
    }
    PointRow* points = rows.points + block.point;
    FrictionRow* frictions = rows.frictions + block.friction;
    put_back(pair, rows.velocities, block);
    if (rule.note) note_grip(points, frictions, block);
    if (!rule.sum_up) return;
    for (int i = 0; i < block.points; ++i) (Number(points[i].total) + points[i].impulse).put(points[i].total);
    for (int i = 0; i < block.frictions; ++i) {
      (Number(frictions[i].total_first) + frictions[i].first).put(frictions[i].total_first);
      (Number(frictions[i].total_second) + frictions[i].second).put(frictions[i].total_second);
    }
    (Number(block.total_twist) + block.twist).put(block.total_twist);
  }

  TWEENFALL_LANES static void warm_start_balls(const Rows& rows, BallBlock& block) {
    const Vector normal = block.normal, friction = block.friction;
    (block.base + dot(normal, linear(rows.displacements, block.b) - linear(rows.displacements, block.a)))
        .put(block.gap);
    const Vector impulse = Number(block.impulse) * normal + friction;
    const Vector turn = cross(normal, friction);
    put_linear(linear(rows.velocities, block.a) - Number(block.inverse_mass_a) * impulse, rows.velocities, block.to_a);
    put_angular(angular(rows.velocities, block.a) - Number(block.spin_a) * turn, rows.velocities, block.to_a);
    put_linear(linear(rows.velocities, block.b) + Number(block.inverse_mass_b) * impulse, rows.velocities, block.to_b);
    put_angular(angular(rows.velocities, block.b) - Number(block.spin_b) * turn, rows.velocities, block.to_b);
  }

  /// Two balls in each lane.
  struct Balls {
    Vector linear_a, angular_a, linear_b, angular_b, friction;
    Number impulse;
  };
  template <class Watch>
  TWEENFALL_LANES static void pass_over(const BallBlock& block, const PassRule& rule, Balls& balls, Watch& watch) {
    const Vector normal = block.normal, before = balls.friction;
    const Number impulse_before = balls.impulse;
    const Vector relative = balls.linear_b - balls.linear_a;
    const Number along = dot(normal, relative);
    const Vector slip = relative - along * normal -
                        cross(Number(block.arm_a) * balls.angular_a + Number(block.arm_b) * balls.angular_b, normal);
    // What would stop the slip points against it: brought back to the cone's edge it opposes the slip exactly.
    Vector friction = before - Number(block.slip_mass) * slip;
    const Number limit = Number(block.coefficient) * impulse_before;
    const Number square = dot(friction, friction), most = limit * limit;
    const Which outside = square > most;
    if (outside.any()) friction = select(outside, limit / root(square), Number(1.0)) * friction;
    friction = {watch.keep(friction.x, before.x), watch.keep(friction.y, before.y), watch.keep(friction.z, before.z)};
    const Number next =
        watch.keep(next_normal(block.gap, impulse_before, block.mass, block.hard, along, rule), impulse_before);
    const Vector dragged = friction - before;
    watch.note(next - impulse_before, block.mass);
    watch.note(dragged.x, block.slip_mass);
    watch.note(dragged.y, block.slip_mass);
    watch.note(dragged.z, block.slip_mass);
    const Vector impulse = (next - impulse_before) * normal + dragged;
    const Vector turn = cross(normal, dragged);
    balls.friction = friction;
    balls.impulse = next;
    balls.linear_a = balls.linear_a - Number(block.inverse_mass_a) * impulse;
    balls.angular_a = balls.angular_a - Number(block.spin_a) * turn;
    balls.linear_b = balls.linear_b + Number(block.inverse_mass_b) * impulse;
    balls.angular_b = balls.angular_b - Number(block.spin_b) * turn;
  }

  TWEENFALL_LANES static void solve_balls(const Rows& rows, BallBlock& block, const PassRule& rule) {
    Balls balls{linear(rows.velocities, block.a),
                angular(rows.velocities, block.a),
                linear(rows.velocities, block.b),
                angular(rows.velocities, block.b),
                block.friction,
                block.impulse};
    if (rule.passes == 1) {
      Unwatched watch;
      pass_over(block, rule, balls, watch);
    } else {
      Watched watch(rule, (Number(block.inverse_mass_a) + block.inverse_mass_b) * balls.impulse,
                    sum_of_sizes(balls.linear_a) + sum_of_sizes(balls.linear_b));
      for (int k = 0; k < rule.passes; ++k) {
        pass_over(block, rule, balls, watch);
        if (!watch.goes_on()) break;
      }
    }
    balls.friction.put(block.friction);
    balls.impulse.put(block.impulse);
    put_linear(balls.linear_a, rows.velocities, block.to_a);
    put_angular(balls.angular_a, rows.velocities, block.to_a);
    put_linear(balls.linear_b, rows.velocities, block.to_b);
    put_angular(balls.angular_b, rows.velocities, block.to_b);
    if (rule.note) (balls.impulse > Number(0.0)).put(block.pressed);
    if (!rule.sum_up) return;
    (balls.impulse + block.total).put(block.total);
    (balls.friction + block.total_friction).put(block.total_friction);
  }

  TWEENFALL_LANES static Which which_of(const std::int8_t* lanes) {
    Mask mask;
    for (int lane = 0; lane < lane_count; ++lane) mask[lane] = lanes[lane];
    return Which::in(mask);
  }

  /// Lags of bodies, less what a contact along the normal holds.
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

  /// Which points arrive within the sub-step, and fast enough.
  TWEENFALL_LANES static Which meeting(const MeetingRow& row, const Number& gap, const Number& closing,
                                       const Number& mass, double h) {
    const Number zero(0.0), pull = row.pull, tremble = row.tremble;
    const Number open = greater(gap, zero);
    const Number fall = Number(0.5 * h * h) * greater(pull, zero);
    const Which arrives = Number(h) * closing + fall >= Number(1 - 1e-9) * open;
    const Which fast = closing * closing + Number(2.0) * pull * open > tremble * tremble;
    return arrives & fast & (mass > zero) & (Number(row.restitution) > zero);
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
      if (!(Number(meetings.restitution) > Number(0.0)).any()) continue;
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
      const BallBlock& block = rows.balls[i];
      const Number along = dot(block.normal, linear(starts, block.a) - linear(starts, block.b));
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
};

/// Balls and blocks of two movable bodies, then those of one.
template <class Work>
TWEENFALL_LANES void do_all(const Rows& rows, const Work& work) {
  for (std::size_t i = 0; i < rows.ball_pairs; ++i) work(rows.balls[i]);
  for (std::size_t i = 0; i < rows.pairs; ++i) work(rows.blocks[i]);
  for (std::size_t i = rows.ball_pairs; i < rows.ball_count; ++i) work(rows.balls[i]);
  for (std::size_t i = rows.pairs; i < rows.count; ++i) work(rows.blocks[i]);
}

// The same source for each instruction set. None of them fuses a multiplication and an addition here, so the bits are
// the same.
#define TWEENFALL_KERNELS(name, Numbers, target)                     \
  target void warm_start_##name(const Rows& rows) {                  \
    do_all(rows, RowWork<Numbers>::WarmStart{rows});                 \
  }                                                                  \
  target void solve_##name(const Rows& rows, const PassRule& rule) { \
    do_all(rows, RowWork<Numbers>::Solve{rows, rule});               \
  }                                                                  \
  target void hold_##name(const Rows& rows) {                        \
    do_all(rows, RowWork<Numbers>::Hold{rows});                      \
  }
#define TWEENFALL_MEETINGS(name, Numbers, target)                                                                      \
  target std::size_t find_meetings_##name(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found) { \
    return RowWork<Numbers>::find_meetings(rows, starts, h, found);                                                    \
  }

TWEENFALL_KERNELS(plain, Halves<Halves<Two>>, )
TWEENFALL_MEETINGS(plain, Halves<Halves<Two>>, )
constexpr Kernels plain = {warm_start_plain, solve_plain, hold_plain, find_meetings_plain};
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_KERNELS(avx2, Halves<Four>, [[gnu::target("avx2")]])
TWEENFALL_MEETINGS(avx2, Halves<Four>, [[gnu::target("avx2")]])
constexpr Kernels avx2 = {warm_start_avx2, solve_avx2, hold_avx2, find_meetings_avx2};
// What comes of several comparisons g++ finds number by number where eight are compared at once, so not here.
TWEENFALL_KERNELS(avx512, Eight, [[gnu::target("avx512f,avx512vl,avx512dq")]])
constexpr Kernels avx512 = {warm_start_avx512, solve_avx512, hold_avx512, find_meetings_avx2};
#endif

}  // namespace

std::span<const Kernels* const> possible_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain, &avx2, &avx512};
#else
  static constexpr std::array all = {&plain};
#endif
  return std::span(all).first(possible_versions());
}

const Kernels& fastest_kernels() {
  static const Kernels& fastest = *possible_kernels().back();
  return fastest;
}

}  // namespace tweenfall::blocks
