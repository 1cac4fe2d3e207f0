#pragma once

#include "islands/blocks/kernels/lane_work.h"

namespace tweenfall::blocks {

/// Passes over balls that touch at one point each.
template <class Register>
struct BallWork : LaneWork<Register> {
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

  TWEENFALL_LANES static void warm_start_balls(const Rows& rows, BallBlock& block) {
    const Vector normal = block.normal, friction = block.friction;
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
    // The impulse that would stop the slip points against it: scaled back onto the cone, it opposes the slip exactly.
    Vector friction = before - Number(block.slip_mass) * slip;
    const Number limit = Number(block.coefficient) * impulse_before;
    const Number square = dot(friction, friction), most = limit * limit;
    const Which outside = square > most;
    if (outside.any()) friction = select(outside, limit / root(square), Number(1.0)) * friction;
    friction = {watch.keep(friction.x, before.x), watch.keep(friction.y, before.y), watch.keep(friction.z, before.z)};
    const Number next = watch.keep(next_normal(block.gap, impulse_before, block.mass, block.hard, along, rule,
                                               rule.springs ? &block.back : nullptr),
                                   impulse_before);
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
    if (rule.measures) measure(rows, block);
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
};

}  // namespace tweenfall::blocks
