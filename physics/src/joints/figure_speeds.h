#pragma once

/// The rows of figures: at which speeds their bodies move along them, and what impulses along them give.

#include "islands/blocks/kernels/registers.h"
#include "joints/figure_lanes.h"
#include "joints/joint_rows.h"

namespace tweenfall::joints {

using blocks::any_of;
using blocks::BodyLanes;
using blocks::Eight;
using blocks::EightMasks;
using blocks::Four;
using blocks::FourMasks;
using blocks::gather;
using blocks::Halves;
using blocks::lane_count;
using blocks::Lanes;
using blocks::Lanes3;
using blocks::LanesFrom;
using blocks::scatter;
using blocks::Two;
using blocks::TwoMasks;
using blocks::Wide;
using blocks::Wide3;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// Keeps g++ from combining several comparisons at once, which for eight numbers it does one by one.
template <class Register>
TWEENFALL_LANES void stay(Register&) {}
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_LANES void stay(Eight& numbers) {
  asm("" : "+m"(numbers));
}
#endif

/// Whether some bit is set.
template <class Register, class Bits>
TWEENFALL_LANES bool any_bit(const Register& numbers, Bits bits) {
  __builtin_memcpy(&bits, &numbers, sizeof bits);
  return any_of(bits);
}
TWEENFALL_LANES bool any_bit(const Two& numbers) {
  return any_bit(numbers, TwoMasks{});
}
TWEENFALL_LANES bool any_bit(const Four& numbers) {
  return any_bit(numbers, FourMasks{});
}
TWEENFALL_LANES bool any_bit(const Eight& numbers) {
  return any_bit(numbers, EightMasks{});
}
template <class Half>
TWEENFALL_LANES auto bits_of(const Halves<Half>& numbers);
TWEENFALL_LANES TwoMasks bits_of(const Two& numbers) {
  return TwoMasks(numbers);
}
TWEENFALL_LANES FourMasks bits_of(const Four& numbers) {
  return FourMasks(numbers);
}
template <class Half>
TWEENFALL_LANES auto bits_of(const Halves<Half>& numbers) {
  return bits_of(numbers.low) | bits_of(numbers.high);
}
template <class Half>
TWEENFALL_LANES bool any_bit(const Halves<Half>& numbers) {
  return any_of(bits_of(numbers));
}

template <class Register, int first>
TWEENFALL_LANES bool any_bit(const LanesFrom<Register, first>& numbers) {
  return any_bit(numbers.of);
}

/// The part of figures that registers hold.
template <class Register>
constexpr std::size_t part_of = 0;
template <class Register, int first>
constexpr std::size_t part_of<LanesFrom<Register, first>> = first* most_parts / lane_count;

constexpr std::uint32_t rows_of_joint = FigureJoint::most_rows;

/// For registers of one kind. Conditions are 1 or 0 in each lane: their products are computed faster than combinations
/// of comparisons.
template <class Register>
struct FigureSpeeds {
  using Number = Wide<Register>;
  using Vector = Wide3<Register>;
  using Which = typename Number::Which;
  static constexpr std::size_t part = part_of<Register>;

  struct Ends {
    Vector linear_a, angular_a, linear_b, angular_b;
  };
  /// Impulses of a joint's rows together.
  struct Sum {
    Vector push_a, twist_a, push_b, twist_b;
  };

  TWEENFALL_LANES static Number nothing() { return Number(0.0); }
  TWEENFALL_LANES static Vector no_vector() { return {nothing(), nothing(), nothing()}; }
  TWEENFALL_LANES static Number one_if(const Which& which) {
    Number ones = select(which, Number(1.0), nothing());
    stay(ones.of);
    return ones;
  }
  TWEENFALL_LANES static bool any(const Number& ones) { return any_bit(ones.of); }
  TWEENFALL_LANES static Number size_of(const Number& value) { return greater(value, -value); }
  TWEENFALL_LANES static FigureRow* rows_of(const Figures& figures, std::uint32_t place) {
    return figures.rows + rows_of_joint * place;
  }
  template <class Joint>
  TWEENFALL_LANES static auto& in_of(Joint& joint) {
    return joint.in[part];
  }
  TWEENFALL_LANES static bool is_point(const FigureJoint& joint, std::uint32_t row) { return joint.point && row < 3; }

  /// Where the velocity of a body in each lane is; `nobody` if there is none.
  TWEENFALL_LANES static void find(const Figures& figures, std::uint32_t body, BodyLanes& nobody, double** rows) {
    for (int lane = 0; lane < lane_count; ++lane)
      rows[lane] =
          lane < figures.used ? figures.velocities[figures.places[lane_count * body + lane]].linear : nobody.linear;
  }
  TWEENFALL_LANES static void read(Figures& figures) {
    BodyLanes nobody;
    for (std::uint32_t i = 0; i < figures.body_count; ++i) {
      double* rows[lane_count];
      find(figures, i, nobody, rows);
      Vector linear, angular;
      Number rest;
      gather(rows, linear.x.of, linear.y.of, linear.z.of, rest.of);
      for (double*& row : rows) row += 4;
      gather(rows, angular.x.of, angular.y.of, angular.z.of, rest.of);
      linear.put(figures.bodies[i].linear);
      angular.put(figures.bodies[i].angular);
    }
  }
  /// Adding 0 turns -0 into 0, so that other lanes do not show in the result.
  TWEENFALL_LANES static void write(const Figures& figures) {
    BodyLanes nobody;
    for (std::uint32_t i = 0; i < figures.body_count; ++i) {
      const FigureBody& body = figures.bodies[i];
      if (!body.moves) continue;
      double* rows[lane_count];
      find(figures, i, nobody, rows);
      const Vector linear = Vector(body.linear) + no_vector(), angular = Vector(body.angular) + no_vector();
      scatter(linear.x.of, linear.y.of, linear.z.of, nothing().of, rows);
      for (double*& row : rows) row += 4;
      scatter(angular.x.of, angular.y.of, angular.z.of, nothing().of, rows);
    }
  }

  TWEENFALL_LANES static Ends ends_of(const Figures& figures, const FigureJoint& joint) {
    const FigureBody &a = figures.bodies[joint.a], &b = figures.bodies[joint.b];
    return {a.linear, a.angular, b.linear, b.angular};
  }
  TWEENFALL_LANES static Vector point_speed(const FigureJoint& joint, const Ends& ends) {
    return (ends.linear_b + cross(ends.angular_b, Vector(joint.arm_b))) -
           (ends.linear_a + cross(ends.angular_a, Vector(joint.arm_a)));
  }
  TWEENFALL_LANES static Number speed_of(const FigureRow& row, bool turning, const Ends& ends) {
    const Number turn = dot(row.turn_b, ends.angular_b) - dot(row.turn_a, ends.angular_a);
    if (turning) return turn;
    return (dot(row.linear_b, ends.linear_b) - dot(row.linear_a, ends.linear_a)) + turn;
  }
  TWEENFALL_LANES static Number lack_of(const FigureRow& row, const Number& speed, bool moving) {
    return (Number(moving ? row.wanted : row.wanted_after) - Number(row.compliance) * row.impulse) - speed;
  }

  TWEENFALL_LANES static Sum sum_of_point(const FigureJoint& joint, const Vector& impulse) {
    return {impulse, cross(Vector(joint.arm_a), impulse), impulse, cross(Vector(joint.arm_b), impulse)};
  }
  TWEENFALL_LANES static void add(const FigureRow& row, bool turning, const Number& impulse, Sum& sum) {
    if (!turning) {
      sum.push_a = sum.push_a + impulse * row.linear_a;
      sum.push_b = sum.push_b + impulse * row.linear_b;
    }
    sum.twist_a = sum.twist_a + impulse * row.turn_a;
    sum.twist_b = sum.twist_b + impulse * row.turn_b;
  }
  TWEENFALL_LANES static void give_to(Figures& figures, const FigureJoint& joint, const Sum& sum) {
    FigureBody &a = figures.bodies[joint.a], &b = figures.bodies[joint.b];
    if (a.moves) {
      (Vector(a.linear) - Number(a.inverse_mass) * sum.push_a).put(a.linear);
      (Vector(a.angular) - a.inverse_inertia * sum.twist_a).put(a.angular);
    }
    if (b.moves) {
      (Vector(b.linear) + Number(b.inverse_mass) * sum.push_b).put(b.linear);
      (Vector(b.angular) + b.inverse_inertia * sum.twist_b).put(b.angular);
    }
  }
  /// For one row alone.
  TWEENFALL_LANES static void apply(Figures& figures, const FigureJoint& joint, std::uint32_t row, const FigureRow& its,
                                    const Number& impulse) {
    Sum sum{no_vector(), no_vector(), no_vector(), no_vector()};
    if (is_point(joint, row))
      sum = sum_of_point(
          joint, {row == 0 ? impulse : nothing(), row == 1 ? impulse : nothing(), row == 2 ? impulse : nothing()});
    else
      add(its, joint.turning[row], impulse, sum);
    give_to(figures, joint, sum);
  }
};

#pragma GCC diagnostic pop

}  // namespace tweenfall::joints
