#pragma once

#include "islands/blocks/kernels/registers.h"

namespace tweenfall::blocks {

/// Rounding that adding to a speed and subtracting again may leave, relative.
constexpr double rounding_of_speed = 1e-15;

/// The basis of all work on blocks, in registers of one kind: the velocities of eight bodies at once, and when
/// passes over rows may end.
template <class Register>
struct LaneWork {
  using Number = Wide<Register>;
  using Vector = Wide3<Register>;
  using Which = typename Number::Which;

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

  TWEENFALL_LANES static Number sum_of_sizes(const Vector& v) {
    return greater(v.x, -v.x) + (greater(v.y, -v.y) + greater(v.z, -v.z));
  }

  /// Finds the gaps of the sub-step.
  TWEENFALL_LANES static void measure(const Rows& rows, const ContactBlock& block) {
    const Vector turned_a = angular(rows.displacements, block.a), turned_b = angular(rows.displacements, block.b);
    const Number drift = dot(block.normal, linear(rows.displacements, block.b) - linear(rows.displacements, block.a));
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(i)];
      (point.base + (drift + (dot(point.turn_b, turned_b) - dot(point.turn_a, turned_a)))).put(point.gap);
    }
  }
  TWEENFALL_LANES static void measure(const Rows& rows, BallBlock& block) {
    (block.base + dot(block.normal, linear(rows.displacements, block.b) - linear(rows.displacements, block.a)))
        .put(block.gap);
  }

  /// Watches rows during a single pass: there is nothing to decide.
  struct Unwatched {
    TWEENFALL_LANES Number keep(const Number& next, const Number&) const { return next; }
    TWEENFALL_LANES void note(const Number&, const Number&) const {}
  };
  /// With several passes, settled lanes stay as they are.
  struct Watched {
    Number enough;
    Which stirs, changed;

    /// @param given  the speed that the impulses at the start gave
    /// @param speed  an upper bound of all speeds
    TWEENFALL_LANES Watched(const PassRule& rule, const Number& given, const Number& speed)
        : enough(rule.enough * given + Number(rounding_of_speed) * speed) {
      const Number zero(0.0);
      stirs = zero >= zero;
      changed = zero > zero;
    }
    TWEENFALL_LANES Number keep(const Number& next, const Number& before) const { return select(stirs, next, before); }
    /// @param change  of an impulse
    /// @param mass  impulse per unit of speed
    TWEENFALL_LANES void note(const Number& change, const Number& mass) {
      changed = changed | (greater(change, -change) > enough * mass);
    }
    /// After a pass. @return whether anything is left to do
    TWEENFALL_LANES bool goes_on() {
      stirs = stirs & changed;
      changed = enough > enough;
      return stirs.any();
    }
  };

  /// The impulse along the normal that two bodies with this gap and closing speed need next.
  /// @param back  the speed with which a pressed point springs back; null if none does
  TWEENFALL_LANES static Number next_normal(const Number& gap, const Number& impulse, const Number& mass,
                                            const Mask& hard, const Number& speed, const PassRule& rule,
                                            const Lanes* back) {
    const Number zero(0.0), one(1.0);
    // A gap may close within the sub-step, but not further.
    const Which apart = gap > zero;
    Number wanted = select(apart, -gap * rule.inverse_h, lesser(-gap * rule.rate, rule.speed));
    if (back) wanted = select((impulse > zero) & (Number(*back) > zero), *back, wanted);
    const Which stiff = apart | Which::in(hard);
    const Number keeping = select(stiff, one, rule.keeping);
    const Number firm = select(stiff, one, rule.firm);
    return greater(zero, keeping * impulse - firm * mass * (speed - wanted));
  }

  TWEENFALL_LANES static Which which_of(const std::int8_t* lanes) {
    Mask mask;
    for (int lane = 0; lane < lane_count; ++lane) mask[lane] = lanes[lane];
    return Which::in(mask);
  }
};

}  // namespace tweenfall::blocks
