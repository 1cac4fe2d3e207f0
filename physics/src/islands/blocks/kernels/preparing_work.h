#pragma once

#include <array>
#include <cstddef>

#include "contacts/contact_constraint.h"
#include "islands/blocks/island_body.h"
#include "islands/blocks/kernels/lane_work.h"

namespace tweenfall::blocks {

/// Finds the rows of contacts with several points or friction, where their bodies are: directions of turning, masses,
/// and friction.
template <class Register>
struct PreparingWork : LaneWork<Register> {
  using Lanes = LaneWork<Register>;
  using Lanes::angular;
  using Lanes::put_angular;
  using typename Lanes::Number;
  using typename Lanes::Vector;
  using typename Lanes::Which;
  using Contact = contacts::ContactConstraint;

  // A point is read as a row of numbers: arm of a, arm of b, gap, skins.
  using Point = contacts::PointConstraint;
  static_assert(offsetof(Point, start_arm_b) == offsetof(Point, start_arm_a) + 3 * sizeof(double) &&
                offsetof(Point, start_gap) == offsetof(Point, start_arm_a) + 6 * sizeof(double) &&
                offsetof(Point, skin_a) == offsetof(Point, start_arm_a) + 7 * sizeof(double) &&
                offsetof(Point, skin_b) == offsetof(Point, start_arm_a) + 8 * sizeof(double));

  struct Pair {
    Vector a, b;
  };
  /// How bodies turn for a torque.
  struct Inertias {
    const ContactBlock& block;
    const InertiaRow* row;

    [[nodiscard]] TWEENFALL_LANES Pair spins(const Vector& turn_a, const Vector& turn_b) const {
      if (block.even) return {Number(block.inverse_moment_a) * turn_a, Number(block.inverse_moment_b) * turn_b};
      return {row->inverse_a * turn_a, row->inverse_b * turn_b};
    }
  };
  struct Turn {
    Vector axis;  ///< of its quaternion
    Number w;
    Vector angle;  ///< sum of the turns, rad
  };

  TWEENFALL_LANES static Number nothing() { return Number(0.0); }
  TWEENFALL_LANES static Vector no_vector() { return {nothing(), nothing(), nothing()}; }

  TWEENFALL_LANES static Turn turn_of(const IslandBody* bodies, const std::uint32_t* at) {
    const double* rows[lane_count];
    Turn turn;
    Number unused;
    for (int i = 0; i < lane_count; ++i) rows[i] = bodies[at[i]].turn.rotation;
    gather(rows, turn.axis.x.of, turn.axis.y.of, turn.axis.z.of, turn.w.of);
    for (int i = 0; i < lane_count; ++i) rows[i] = bodies[at[i]].turn.angle;
    gather(rows, turn.angle.x.of, turn.angle.y.of, turn.angle.z.of, unused.of);
    return turn;
  }
  /// See state::carried.
  TWEENFALL_LANES static Vector carried(const Turn& turn, const Vector& arm, const Vector& skin) {
    const Vector core = arm - skin;
    const Vector half = cross(turn.axis, core);
    const Vector whole = half + half;
    return (core + turn.w * whole + cross(turn.axis, whole)) + skin;
  }

  TWEENFALL_LANES static void put_in(const Which& which, const Number& value, blocks::Lanes& to) {
    select(which, value, Number(to)).put(to);
  }
  TWEENFALL_LANES static void put_in(const Which& which, const Vector& value, Lanes3& to) {
    put_in(which, value.x, to.x);
    put_in(which, value.y, to.y);
    put_in(which, value.z, to.z);
  }
  /// 1 / value, or 0 where it is not asked for
  TWEENFALL_LANES static Number inverse_in(const Which& which, const Number& value) {
    const Number one(1.0);
    return select(which, one / select(which, value, one), nothing());
  }

  TWEENFALL_LANES static void take_inertia(const Which& which, const IslandBody* bodies, const std::uint32_t* at,
                                           LanesSymmetric& to) {
    const double* columns[lane_count];
    Number xx, xy, xz, yy, yz, zz, unused;
    for (int i = 0; i < lane_count; ++i) columns[i] = bodies[at[i]].inverse_inertia.data();
    gather(columns, xx.of, unused.of, unused.of, unused.of);
    for (double const*& column : columns) column += 3;
    gather(columns, xy.of, yy.of, unused.of, unused.of);
    for (double const*& column : columns) column += 3;
    gather(columns, xz.of, yz.of, zz.of, unused.of);
    put_in(which, xx, to.xx);
    put_in(which, yy, to.yy);
    put_in(which, zz, to.zz);
    put_in(which, xy, to.xy);
    put_in(which, xz, to.xz);
    put_in(which, yz, to.yz);
  }

  /// One row of friction at an arm from each body.
  /// @param there  lanes that have this row
  TWEENFALL_LANES static void prepare_friction(const ContactBlock& block, const Inertias& inertias,
                                               const Number& inverse_mass, const Vector& arm_a, const Vector& arm_b,
                                               const Which& which, const Which& there, FrictionRow& row) {
    const Vector a1 = cross(arm_a, Vector(block.tangent1)), b1 = cross(arm_b, Vector(block.tangent1));
    const Vector a2 = cross(arm_a, Vector(block.tangent2)), b2 = cross(arm_b, Vector(block.tangent2));
    put_in(which, a1, row.first_a);
    put_in(which, b1, row.first_b);
    put_in(which, a2, row.second_a);
    put_in(which, b2, row.second_b);
    const Pair spins1 = inertias.spins(a1, b1), spins2 = inertias.spins(a2, b2);
    const Number k11 = inverse_mass + (dot(a1, spins1.a) + dot(b1, spins1.b));
    const Number k22 = inverse_mass + (dot(a2, spins2.a) + dot(b2, spins2.b));
    const Number k12 = dot(a1, spins2.a) + dot(b1, spins2.b);
    const Number determinant = k11 * k22 - k12 * k12;
    const Which solvable = (determinant > nothing()) & there;
    const Number inverse = inverse_in(solvable, determinant);
    put_in(which, k22 * inverse, row.inverse11);
    put_in(which, -k12 * inverse, row.inverse12);
    put_in(which, k11 * inverse, row.inverse22);
    const Number between = k11 - k22;
    const Number stiffest = Number(0.5) * (k11 + k22) + root(Number(0.25) * between * between + k12 * k12);
    put_in(which, inverse_in(solvable, stiffest), row.firm);
  }

  /// The spins that the impulses of the sub-step give the bodies.
  TWEENFALL_LANES static Pair given_spins(const Rows& rows, const ContactBlock& block, const Inertias& inertias) {
    Vector turn_a = no_vector();
    if (block.central()) turn_a = Number(block.twist) * Vector(block.normal);
    Vector turn_b = turn_a;
    for (int i = 0; i < block.points; ++i) {
      const PointRow& point = rows.points[block.point + static_cast<std::uint32_t>(i)];
      const Number impulse = point.impulse;
      turn_a = turn_a + impulse * Vector(point.turn_a);
      turn_b = turn_b + impulse * Vector(point.turn_b);
    }
    for (int i = 0; i < block.frictions; ++i) {
      const FrictionRow& row = rows.frictions[block.friction + static_cast<std::uint32_t>(i)];
      const Number first = row.first, second = row.second;
      turn_a = turn_a + (first * Vector(row.first_a) + second * Vector(row.second_a));
      turn_b = turn_b + (first * Vector(row.first_b) + second * Vector(row.second_b));
    }
    return inertias.spins(turn_a, turn_b);
  }

  /// @param again  the bodies have turned since the start of the step
  template <bool again>
  TWEENFALL_LANES static void prepare(const Rows& rows, ContactBlock& block, const ContactOrigin& origin,
                                      const Which& which) {
    static constexpr double no_point[12] = {};
    double counts[lane_count], eased[lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      const Contact* contact = origin[static_cast<std::size_t>(lane)];
      counts[lane] = contact ? contact->count : 0;
      eased[lane] = contact ? contact->eased : 0;
    }
    Number count, ease;
    load(counts, count.of);
    load(eased, ease.of);
    if (!block.even) {
      InertiaRow& row = rows.inertias[block.inertia];
      take_inertia(which, rows.bodies, block.a, row.inverse_a);
      take_inertia(which, rows.bodies, block.b, row.inverse_b);
    }
    const Inertias inertias{block, rows.inertias + block.inertia};
    const Number inverse_mass = Number(block.inverse_mass_a) + block.inverse_mass_b, one(1.0);
    const Vector normal = block.normal;
    Turn turned_a{no_vector(), one, no_vector()}, turned_b = turned_a;
    if constexpr (again) {
      turned_a = turn_of(rows.bodies, block.a);
      turned_b = turn_of(rows.bodies, block.b);
    }
    const Number share = one / greater(count, one);
    Vector middle_a = no_vector(), middle_b = no_vector();
    Vector arms_b[4];
    const bool central = block.central();
    for (int i = 0; i < block.points; ++i) {
      const double* at[lane_count];
      for (int lane = 0; lane < lane_count; ++lane) {
        const Contact* contact = origin[static_cast<std::size_t>(lane)];
        const bool has = contact && i < contact->count;
        at[lane] = has ? contact->points[static_cast<std::size_t>(i)].start_arm_a.data() : no_point;
      }
      Vector arm_a, arm_b;
      Number gap, skin_a, skin_b, unused;
      gather(at, arm_a.x.of, arm_a.y.of, arm_a.z.of, arm_b.x.of);
      for (double const*& its : at) its += 4;
      gather(at, arm_b.y.of, arm_b.z.of, gap.of, skin_a.of);
      const Which there = count > Number(static_cast<double>(i));
      const Vector start_a = arm_a, start_b = arm_b;
      if constexpr (again) {
        for (double const*& its : at) its += 4;
        gather(at, skin_b.of, unused.of, unused.of, unused.of);
        arm_a = carried(turned_a, start_a, skin_a * normal);
        arm_b = carried(turned_b, start_b, -skin_b * normal);
      }
      PointRow& row = rows.points[block.point + static_cast<std::uint32_t>(i)];
      const Vector across_a = cross(arm_a, normal), across_b = cross(arm_b, normal);
      put_in(which, across_a, row.turn_a);
      put_in(which, across_b, row.turn_b);
      const Pair spins = inertias.spins(across_a, across_b);
      const Number inverse = inverse_mass + (dot(across_a, spins.a) + dot(across_b, spins.b));
      put_in(which, inverse_in((inverse > nothing()) & there, inverse), row.mass);
      if constexpr (again) {
        // The rows add the whole displacement of the step to it.
        const Number lifted = dot(normal, (arm_b - start_b) - (arm_a - start_a));
        put_in(which, gap + ease + (lifted - (dot(across_b, turned_b.angle) - dot(across_a, turned_a.angle))),
               row.base);
      }
      if (block.frictions == block.points)
        prepare_friction(block, inertias, inverse_mass, arm_a, arm_b, which, there,
                         rows.frictions[block.friction + static_cast<std::uint32_t>(i)]);
      if (!central) continue;
      arms_b[i] = arm_b;
      middle_a = middle_a + share * arm_a;
      middle_b = middle_b + share * arm_b;
    }
    if (!central) return;
    for (int i = 0; i < block.points; ++i) {
      const Vector lever = arms_b[i] - middle_b;
      const Which there = count > Number(static_cast<double>(i));
      put_in(which, select(there, root(dot(lever, lever)), nothing()),
             rows.points[block.point + static_cast<std::uint32_t>(i)].lever);
    }
    prepare_friction(block, inertias, inverse_mass, middle_a, middle_b, which, count > nothing(),
                     rows.frictions[block.friction]);
    const Pair spins = inertias.spins(normal, normal);
    const Number inverse = dot(normal, spins.a) + dot(normal, spins.b);
    put_in(which, inverse_in(inverse > nothing(), inverse), block.twist_mass);
  }

  TWEENFALL_LANES static void prepare_block(const Rows& rows, ContactBlock& block, const ContactOrigin& origin) {
    prepare<false>(rows, block, origin, nothing() >= nothing());
  }

  /// @param given  what its impulses gave in the sub-step before is in the velocities, and now acts elsewhere
  TWEENFALL_LANES static void prepare_again(const Rows& rows, ContactBlock& block, const ContactOrigin& origin,
                                            const Mask& stale, bool given) {
    const Which which = Which::in(stale);
    if (!which.any()) return;
    if (!given) return prepare<true>(rows, block, origin, which);
    const Inertias inertias{block, rows.inertias + block.inertia};
    const Pair before = given_spins(rows, block, inertias);
    prepare<true>(rows, block, origin, which);
    const Pair now = given_spins(rows, block, inertias);
    const Vector spin_a = angular(rows.velocities, block.a), spin_b = angular(rows.velocities, block.b);
    put_angular(either(which, spin_a - (now.a - before.a), spin_a), rows.velocities, block.to_a);
    put_angular(either(which, spin_b + (now.b - before.b), spin_b), rows.velocities, block.to_b);
  }
  TWEENFALL_LANES static Vector either(const Which& which, const Vector& yes, const Vector& no) {
    return {select(which, yes.x, no.x), select(which, yes.y, no.y), select(which, yes.z, no.z)};
  }
};

/// Lanes with a body that has turned too far.
TWEENFALL_LANES Mask stale_lanes(const Rows& rows, const ContactBlock& block, const ContactOrigin& origin) {
  Mask stale;
  for (int lane = 0; lane < lane_count; ++lane)
    stale[lane] =
        origin[static_cast<std::size_t>(lane)] && (rows.bodies[block.a[lane]].stale || rows.bodies[block.b[lane]].stale)
            ? -1
            : 0;
  return stale;
}

}  // namespace tweenfall::blocks
