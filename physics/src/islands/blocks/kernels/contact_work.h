#pragma once

#include "islands/blocks/kernels/lane_work.h"

namespace tweenfall::blocks {

/// Passes over contacts with several points and friction.
template <class Register>
struct ContactWork : LaneWork<Register> {
  using Lanes = LaneWork<Register>;
  using Lanes::angular;
  using Lanes::linear;
  using Lanes::measure;
  using Lanes::next_normal;
  using Lanes::put_angular;
  using Lanes::put_linear;
  using Lanes::sum_of_sizes;
  using typename Lanes::Number;
  using typename Lanes::Unwatched;
  using typename Lanes::Vector;
  using typename Lanes::Watched;
  using typename Lanes::Which;

  /// Two bodies in each lane. Their relative speed along the normal and the tangents is stored by itself, so that a row
  /// changes numbers rather than vectors; at the end their velocities get the sum of what the rows gave.
  struct Pair {
    Vector linear_a, angular_a, linear_b, angular_b;
    Number along, slip1, slip2;         ///< of the linear velocities, b relative to a
    Number pushed, dragged1, dragged2;  ///< N s
  };

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

  template <bool even>
  TWEENFALL_LANES static void warm_start_block(const Rows& rows, ContactBlock& block) {
    Vector turn_a{Number(0.0), Number(0.0), Number(0.0)}, turn_b = turn_a;
    Pair pair = pair_of(rows.velocities, block);
    for (int i = 0; i < block.points; ++i) {
      const PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(i)];
      const Number impulse = point.impulse;
      pair.pushed = pair.pushed + impulse;
      turn_a = turn_a + impulse * point.turn_a;
      turn_b = turn_b + impulse * point.turn_b;
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
      // A step along the slip, scaled back onto the cone: in the end friction opposes the slip exactly.
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

  /// Records what friction holds, and what slides on the edge of the cone.
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
    const bool springs = rule.springs && block.springs;
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = points[i];
      const Vector turn_a = point.turn_a, turn_b = point.turn_b;
      const Number impulse = point.impulse;
      const Number speed = pair.along + (dot(turn_b, pair.angular_b) - dot(turn_a, pair.angular_a));
      const Number next = watch.keep(
          next_normal(point.gap, impulse, point.mass, block.hard, speed, rule, springs ? &point.back : nullptr),
          impulse);
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
    if (rule.measures) measure(rows, block);
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
};

}  // namespace tweenfall::blocks
