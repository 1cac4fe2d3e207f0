#pragma once

/// Writes rows of joints in all lanes at once: those of points, and of limbs with hard bounds. The rows are those
/// that `write_rows` gives for one lane.

#include "joints/figure_factors.h"
#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// For registers of one kind.
template <class Register>
struct FigureWriting : FigureFactors<Register> {
  using Factors = FigureFactors<Register>;
  using Number = typename Factors::Number;
  using Vector = typename Factors::Vector;
  using Which = typename Number::Which;
  using Factors::any;
  using Factors::no_vector;
  using Factors::nothing;
  using Factors::one_if;
  using Factors::rows_of;
  using Factors::size_of;

  struct Rotation {
    Number w;
    Vector v;
  };
  /// b's frame relative to a's.
  struct Relative {
    Rotation axes_a;
    Vector x_a, x_b;  ///< of both frames, world axes
    Number w, x, y, z;
    Number far;
  };

  TWEENFALL_LANES static Number number(double value) { return Number(value); }
  TWEENFALL_LANES static Number used_of(const Figures& figures) {
    Lanes used;
    for (int lane = 0; lane < lane_count; ++lane) used[lane] = lane < figures.used ? 1 : 0;
    return used;
  }
  TWEENFALL_LANES static Rotation rotation_of(const LanesQuat& from) {
    return {from.w, Vector(from.x, from.y, from.z)};
  }
  TWEENFALL_LANES static Rotation product(const Rotation& a, const Rotation& b) {
    return {a.w * b.w - dot(a.v, b.v), (a.w * b.v + b.w * a.v) + cross(a.v, b.v)};
  }
  TWEENFALL_LANES static Vector turned(const Rotation& by, const Vector& vector) {
    const Vector twice = number(2) * cross(by.v, vector);
    return (vector + by.w * twice) + cross(by.v, twice);
  }
  TWEENFALL_LANES static Vector negative(const Vector& a) { return {-a.x, -a.y, -a.z}; }
  TWEENFALL_LANES static Number within(const Number& value, double most) {
    return lesser(greater(value, number(-most)), number(most));
  }
  /// Four times the angle whose tangent is given, -1 to 1. It is halved twice, and then comes the series, whose error
  /// is below 1e-17.
  TWEENFALL_LANES static Number four_angles(const Number& tangent) {
    const Number half = tangent / (number(1) + root(number(1) + tangent * tangent));
    const Number quarter = half / (number(1) + root(number(1) + half * half));
    const Number z = quarter * quarter;
    Number sum = number(1.0 / 21);
    for (int odd = 19; odd >= 1; odd -= 2) sum = number(1.0 / odd) - z * sum;
    return number(16) * (quarter * sum);
  }

  // Rows

  TWEENFALL_LANES static void write_row(FigureJoint& joint, FigureRow& row, const Number& has, const Number& bounded,
                                        const Number& wanted, const Number& drawn, const Number& left,
                                        const Number& impulse, const Number& in, std::uint8_t source) {
    joint.sources[joint.count] = source;
    (wanted + drawn).put(row.wanted);
    wanted.put(row.wanted_after);
    left.put(row.left);
    nothing().put(row.compliance);
    impulse.put(row.impulse);
    has.put(row.present);
    bounded.put(row.bounded);
    in.put(row.in);
    ++joint.count;
  }

  TWEENFALL_LANES static void write_point(Figures& figures, std::uint32_t place, const WriteRule& rule,
                                          const Number& used) {
    FigureJoint& joint = figures.joints[place];
    const FigureFrame& frame = figures.frames[place];
    const FigureBody &a = figures.bodies[joint.a], &b = figures.bodies[joint.b];
    const Vector arm_a = turned(rotation_of(a.rotation), frame.pivot_a);
    const Vector arm_b = turned(rotation_of(b.rotation), frame.pivot_b);
    const Vector spin_a = a.spin, spin_b = b.spin;
    arm_a.put(joint.arm_a);
    arm_b.put(joint.arm_b);
    const Vector gap = (Vector(b.center) - Vector(a.center)) + (arm_b - arm_a);
    const Vector bend = cross(spin_b, cross(spin_b, arm_b)) - cross(spin_a, cross(spin_a, arm_a));
    joint.point = true;
    joint.count = 0;
    joint.holds = 3;
    FigureRow* rows = rows_of(figures, place);
    const Number gaps[3] = {gap.x, gap.y, gap.z}, bends[3] = {bend.x, bend.y, bend.z};
    for (std::uint8_t i = 0; i < 3; ++i) {
      FigureRow& row = rows[i];
      write_row(joint, row, used, nothing(), used * (number(-0.5 * rule.h) * bends[i]),
                used * within(number(-rule.rate) * gaps[i], fastest_approach),
                used * within(-gaps[i], fastest_approach * rule.dt), frame.impulses[i], used, i);
      number(give).put(row.reserve);
      joint.turning[i] = false;
    }
  }

  /// Keeps b from turning about an axis beyond a bound. @param gap  to the bound @param near  lanes that need it
  TWEENFALL_LANES static void write_bound(Figures& figures, std::uint32_t place, const WriteRule& rule,
                                          const Vector& axis, const Number& gap, const Number& near,
                                          std::uint8_t source) {
    FigureJoint& joint = figures.joints[place];
    FigureFrame& frame = figures.frames[place];
    if (!any(near)) {
      nothing().put(frame.impulses[source]);
      return;
    }
    FigureRow& row = rows_of(figures, place)[joint.count];
    joint.turning[joint.count] = true;
    const Which has = near > nothing(), passed = gap < nothing();
    const auto if_has = [&](const Number& value) __attribute__((always_inline)) {
      return select(has, value, nothing());
    };
    const Vector turn(if_has(axis.x), if_has(axis.y), if_has(axis.z));
    turn.put(row.turn_a);
    turn.put(row.turn_b);
    const Number wanted = select(gap > nothing(), number(-1 / rule.h) * gap, nothing());
    const Number drawn = select(passed, within(number(-rule.rate) * gap, fastest_turn), nothing());
    const Number left = select(number(-far_beyond) >= gap, within(-gap, fastest_turn * rule.dt), nothing());
    const Number impulse = if_has(greater(frame.impulses[source], nothing()));
    write_row(joint, row, near, near, if_has(wanted), if_has(drawn), if_has(left), impulse,
              near * one_if(impulse > nothing()), source);
    nothing().put(row.low);
    number(std::numeric_limits<double>::infinity()).put(row.high);
    number(caution).put(row.reserve);
  }

  // Limbs

  /// A swing exp(swing) with swing.x = 0.
  struct Swing {
    Number y, z;             ///< rad
    Number angle;            ///< of both, rad
    Number w, sin_y, sin_z;  ///< its quaternion
    Number cotangent, rest;  ///< half of the angle times its cotangent, and the remainder of the series
  };
  TWEENFALL_LANES static Swing swing_of(const Relative& b) {
    const Number length = root(b.w * b.w + b.x * b.x);
    const Which twists = length > nothing();
    const Number cos = select(twists, b.w / length, number(1)), sin = select(twists, b.x / length, nothing());
    Swing swing;
    swing.w = length;
    swing.sin_y = b.y * cos - b.z * sin;
    swing.sin_z = b.z * cos + b.y * sin;
    const Number size = root(swing.sin_y * swing.sin_y + swing.sin_z * swing.sin_z);
    const Which swings = size > nothing();
    swing.angle = four_angles(size / (number(1) + length));
    const Number ratio = select(swings, swing.angle / size, number(2));
    swing.y = ratio * swing.sin_y;
    swing.z = ratio * swing.sin_z;
    swing.cotangent = select(swings, number(0.5) * swing.angle * length / size, number(1));
    swing.rest = select(swing.angle > number(1e-4), (number(1) - swing.cotangent) / (swing.angle * swing.angle),
                        number(1.0 / 12));
    return swing;
  }
  /// The axis in the world along which an angular velocity changes a quantity with this gradient: see swing_twist.cpp.
  TWEENFALL_LANES static Vector axis_of(const Relative& b, const Swing& swing, const Number& along_y,
                                        const Number& along_z) {
    const Number across = swing.y * along_z - swing.z * along_y;
    const Vector first(number(0.5) * across, along_y + swing.rest * (swing.z * across),
                       along_z - swing.rest * (swing.y * across));
    const Vector free(number(1) - swing.rest * (swing.angle * swing.angle), number(0.5) * swing.z,
                      number(-0.5) * swing.y);
    const Vector carried(number(1) - number(2) * (swing.sin_y * swing.sin_y + swing.sin_z * swing.sin_z),
                         number(2) * (swing.w * swing.sin_z), number(-2) * (swing.w * swing.sin_y));
    const Number carry = dot(free, carried);
    const Number share = select(size_of(carry) > number(1e-9), dot(first, carried) / carry, nothing());
    return turned(b.axes_a, first - share * free);
  }

  TWEENFALL_LANES static void bound_swing(Figures& figures, std::uint32_t place, const WriteRule& rule,
                                          const Relative& b, const Number& used) {
    FigureFrame& frame = figures.frames[place];
    const Number most_y = frame.swing_y, most_z = frame.swing_z;
    const Number twist_part = b.w * b.w + b.x * b.x, swing_part = b.y * b.y + b.z * b.z;
    // Half an angle is at most its tangent: most limbs are seen to be well inside without computing the angle.
    const Number inside = lesser(most_y, most_z) - b.far;
    Number near =
        used * (number(1) - one_if(inside > nothing()) * one_if(inside * inside * twist_part > number(4) * swing_part));
    if (rule.errors_only) {
      const Number across_y = (b.y * b.w - b.z * b.x) / most_y, across_z = (b.z * b.w + b.y * b.x) / most_z;
      near = near *
             (number(1) - one_if(twist_part * twist_part > number(4) * (across_y * across_y + across_z * across_z)));
    }
    if (!any(near)) {
      for (const int row : {row_of_cone + 0, row_of_end + 0, row_of_end + 1})
        nothing().put(frame.impulses[static_cast<std::size_t>(row)]);
      return;
    }
    const Swing swing = swing_of(b);
    // The ellipse (s_y / y)^2 + (s_z / z)^2 = 1, and the distance to it to first order.
    const Number scaled_y = swing.y / most_y, scaled_z = swing.z / most_z;
    const Number share = root(scaled_y * scaled_y + scaled_z * scaled_z);
    const Number gradient_y = scaled_y / (share * most_y), gradient_z = scaled_z / (share * most_z);
    const Number steepness = root(gradient_y * gradient_y + gradient_z * gradient_z);
    const Number slopes = near * one_if(share > nothing());
    const Which sloping = slopes > nothing();
    const Number side_y = select(sloping, gradient_y / steepness, nothing());
    const Number side_z = select(sloping, gradient_z / steepness, nothing());
    const Number gap = select(sloping, (number(1) - share) / steepness, nothing());
    // The last impulse belongs to the side on which the limb was then.
    const Number same = side_y * frame.side_y + side_z * frame.side_z;
    (greater(same, nothing()) * frame.impulses[row_of_cone]).put(frame.impulses[row_of_cone]);
    select(sloping, side_y, frame.side_y).put(frame.side_y);
    select(sloping, side_z, frame.side_z).put(frame.side_z);
    const auto in_reach = [&](const Number& concerned, const Number& its_gap) __attribute__((always_inline)) {
      return concerned * one_if(b.far >= its_gap);
    };
    const Number cone = in_reach(slopes, gap);
    write_bound(figures, place, rule, negative(axis_of(b, swing, side_y, side_z)), gap, cone, row_of_cone);
    // At the ends of a narrow ellipse one row flips from side to side and the limb slips past: two more cut them off.
    const Number most = greater(most_y, most_z);
    const Number narrow = near * one_if(lesser(most_y, most_z) < number(narrow_ellipse) * most);
    const Number along_y = one_if(most_y > most_z), along_z = number(1) - along_y;
    const Number at = along_y * swing.y + along_z * swing.z;
    const Number to_low = at + most, to_high = most - at;
    const Number low = in_reach(narrow, to_low), high = in_reach(narrow, to_high);
    const Vector axis = any(low + high) ? axis_of(b, swing, along_y, along_z) : no_vector();
    write_bound(figures, place, rule, axis, to_low, low, row_of_end);
    write_bound(figures, place, rule, negative(axis), to_high, high, row_of_end + 1);
  }

  TWEENFALL_LANES static void bound_twist(Figures& figures, std::uint32_t place, const WriteRule& rule,
                                          const Relative& b, const Number& used) {
    FigureFrame& frame = figures.frames[place];
    const Number inside = lesser(frame.twist_high, -Number(frame.twist_low)) - b.far;
    const Number near =
        used * (number(1) - one_if(inside > nothing()) * one_if(inside * size_of(b.w) > number(2) * size_of(b.x)));
    if (!any(near)) {
      for (const int row : {row_of_twist + 0, row_of_twist + 1})
        nothing().put(frame.impulses[static_cast<std::size_t>(row)]);
      return;
    }
    // Both signs of a quaternion are the same rotation: the one with w >= 0 gives the short angle.
    const Number length = root(b.w * b.w + b.x * b.x);
    const Number sine = select(b.w < nothing(), -b.x, b.x);
    const Number twist = select(length > nothing(), four_angles(sine / (length + size_of(b.w))), nothing());
    // The axis about which b twists: halfway between both x axes, as long as the twist is fast.
    const Number sum = number(1) + dot(b.x_a, b.x_b);
    const Which follows = sum > number(1e-9);
    const Number half = select(follows, number(1) / sum, number(1));
    const Vector axis = half * (b.x_a + Vector(select(follows, b.x_b.x, nothing()), select(follows, b.x_b.y, nothing()),
                                               select(follows, b.x_b.z, nothing())));
    const Number to_low = twist - frame.twist_low, to_high = Number(frame.twist_high) - twist;
    write_bound(figures, place, rule, axis, to_low, near * one_if(b.far >= to_low), row_of_twist);
    write_bound(figures, place, rule, negative(axis), to_high, near * one_if(b.far >= to_high), row_of_twist + 1);
  }

  TWEENFALL_LANES static void write_limb(Figures& figures, std::uint32_t place, const WriteRule& rule,
                                         const Number& used) {
    const FigureJoint& joint = figures.joints[place];
    const FigureFrame& frame = figures.frames[place];
    const FigureBody &body_a = figures.bodies[joint.a], &body_b = figures.bodies[joint.b];
    Relative b;
    b.axes_a = product(rotation_of(body_a.rotation), rotation_of(frame.axes_a));
    const Rotation axes_b = product(rotation_of(body_b.rotation), rotation_of(frame.axes_b));
    const Rotation relative = product({b.axes_a.w, negative(b.axes_a.v)}, axes_b);
    b.w = relative.w;
    b.x = relative.v.x;
    b.y = relative.v.y;
    b.z = relative.v.z;
    const Vector x(number(1), nothing(), nothing());
    b.x_a = turned(b.axes_a, x);
    b.x_b = turned(axes_b, x);
    const Vector turning = Vector(body_b.spin) - Vector(body_a.spin);
    b.far = rule.errors_only ? nothing() : number(reach_of_blow) + number(2 * rule.h) * root(dot(turning, turning));
    bound_swing(figures, place, rule, b, used);
    bound_twist(figures, place, rule, b, used);
  }

  TWEENFALL_LANES static void write_all(Figures& figures, const WriteRule& rule) {
    const Number used = used_of(figures);
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const Writing writing = figures.joints[place].writing;
      if (writing == Writing::by_kind) continue;
      write_point(figures, place, rule, used);
      if (writing == Writing::limb) write_limb(figures, place, rule, used);
    }
  }
};

#pragma GCC diagnostic pop

}  // namespace tweenfall::joints
