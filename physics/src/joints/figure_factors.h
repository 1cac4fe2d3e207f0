#pragma once

/// The factors of all rows of figures that are `in`, by which they are solved together.

#include "joints/figure_speeds.h"

namespace tweenfall::joints {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// Calls the version made for this number of rows: of a point alone, or with some bounds; so the compiler knows it.
#define TWEENFALL_OF_ROWS(count, function, ...) \
  switch (count) {                              \
    case 3:                                     \
      function<3>(__VA_ARGS__);                 \
      break;                                    \
    case 4:                                     \
      function<4>(__VA_ARGS__);                 \
      break;                                    \
    case 5:                                     \
      function<5>(__VA_ARGS__);                 \
      break;                                    \
    case 6:                                     \
      function<6>(__VA_ARGS__);                 \
      break;                                    \
    default:                                    \
      function<0>(__VA_ARGS__);                 \
      break;                                    \
  }

/// For registers of one kind.
template <class Register>
struct FigureFactors : FigureSpeeds<Register> {
  using Speeds = FigureSpeeds<Register>;
  using Speeds::add;
  using Speeds::any;
  using Speeds::give_to;
  using Speeds::in_of;
  using Speeds::is_point;
  using Speeds::no_vector;
  using Speeds::nothing;
  using Speeds::one_if;
  using Speeds::part;
  using Speeds::rows_of;
  using Speeds::sum_of_point;
  using typename Speeds::Number;
  using typename Speeds::Sum;
  using typename Speeds::Vector;
  using typename Speeds::Which;

  /// How impulses along the three axes at a point turn a body: by arm x axis.
  TWEENFALL_LANES static void spins_of_point(const blocks::LanesSymmetric& m, const Vector& arm, Vector* spins) {
    const Number xx = m.xx, xy = m.xy, xz = m.xz, yy = m.yy, yz = m.yz, zz = m.zz;
    spins[0] = {xy * arm.z - xz * arm.y, yy * arm.z - yz * arm.y, yz * arm.z - zz * arm.y};
    spins[1] = {xz * arm.x - xx * arm.z, yz * arm.x - xy * arm.z, zz * arm.x - xz * arm.z};
    spins[2] = {xx * arm.y - xy * arm.x, xy * arm.y - yy * arm.x, xz * arm.y - yz * arm.x};
  }
  TWEENFALL_LANES static Vector turn_of_point(const Vector& arm, std::uint32_t axis) {
    if (axis == 0) return {nothing(), arm.z, -arm.y};
    if (axis == 1) return {-arm.z, nothing(), arm.x};
    return {arm.y, -arm.x, nothing()};
  }
  TWEENFALL_LANES static Vector turn_of(const FigureJoint& joint, const FigureRow* rows, std::uint32_t row, bool by_b) {
    if (is_point(joint, row)) return turn_of_point(by_b ? joint.arm_b : joint.arm_a, row);
    return by_b ? rows[row].turn_b : rows[row].turn_a;
  }
  TWEENFALL_LANES static const Lanes& part_of_vector(const Lanes3& vector, std::uint32_t axis) {
    return axis == 0 ? vector.x : axis == 1 ? vector.y : vector.z;
  }
  /// Adds the effect that the linear parts of two rows have on each other through a mass.
  TWEENFALL_LANES static Number with_push(const Number& sum, const Number& mass, const FigureJoint& joint1,
                                          const FigureRow* rows1, std::uint32_t row1, bool by_b1,
                                          const FigureJoint& joint2, const FigureRow* rows2, std::uint32_t row2,
                                          bool by_b2) {
    const bool point1 = is_point(joint1, row1), point2 = is_point(joint2, row2);
    if (point1 && point2) return row1 == row2 ? sum + mass : sum;
    if ((!point1 && joint1.turning[row1]) || (!point2 && joint2.turning[row2])) return sum;
    const Lanes3& linear1 = by_b1 ? rows1[row1].linear_b : rows1[row1].linear_a;
    const Lanes3& linear2 = by_b2 ? rows2[row2].linear_b : rows2[row2].linear_a;
    if (point1) return sum + mass * part_of_vector(linear2, row1);
    if (point2) return sum + mass * part_of_vector(linear1, row2);
    return sum + mass * dot(linear1, Vector(linear2));
  }

  /// Speed that a row gains per unit of its own impulse.
  TWEENFALL_LANES static Number inverse_of(const Figures& figures, std::uint32_t place, std::uint32_t row) {
    const FigureJoint& joint = figures.joints[place];
    const FigureRow* rows = rows_of(figures, place);
    const FigureBody &a = figures.bodies[joint.a], &b = figures.bodies[joint.b];
    const Vector turn_a = turn_of(joint, rows, row, false), turn_b = turn_of(joint, rows, row, true);
    Number sum = dot(turn_a, a.inverse_inertia * turn_a) + dot(turn_b, b.inverse_inertia * turn_b);
    sum = with_push(sum, a.inverse_mass, joint, rows, row, false, joint, rows, row, false);
    return with_push(sum, b.inverse_mass, joint, rows, row, true, joint, rows, row, true);
  }

  /// Finds which rows of a joint are `in`.
  TWEENFALL_LANES static void choose_rows(Figures& figures, std::uint32_t place) {
    FigureJoint& joint = figures.joints[place];
    const FigureRow* rows = rows_of(figures, place);
    std::uint8_t count = joint.holds;
    for (std::uint8_t row = 0; row < count; ++row) in_of(joint).slots[row] = row;
    for (std::uint8_t row = joint.holds; row < joint.count; ++row)
      if (any(rows[row].in)) in_of(joint).slots[count++] = row;
    in_of(joint).count = count;
  }
  /// There is room for all rows, so that none has to move when others come in.
  TWEENFALL_LANES static void lay_out(Figures& figures) {
    std::uint32_t value = 0, block = 0;
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const std::uint32_t count = figures.joints[place].count;
      FigureRowsIn& in = in_of(figures.joints[place]);
      in.changed = true;
      in.value = value;
      in.diagonal = block;
      value += count;
      block += count * count;
      for (std::uint32_t n = figures.firsts[place]; n < figures.firsts[place + 1]; ++n) {
        figures.links[n].blocks[part] = block;
        block += figures.joints[figures.links[n].place].count * count;
      }
    }
  }
  /// What a change of some joints makes stale.
  TWEENFALL_LANES static void spread_changes(Figures& figures) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place)
      in_of(figures.joints[place]).stale = in_of(figures.joints[place]).changed;
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      if (!in_of(figures.joints[place]).stale) continue;
      for (std::uint32_t n = figures.firsts[place]; n < figures.firsts[place + 1]; ++n)
        in_of(figures.joints[figures.links[n].place]).stale = true;
    }
  }
  /// Whether a joint's effect on a later one has to be found anew.
  TWEENFALL_LANES static bool stale_between(const FigureJoint& joint, const FigureJoint& later) {
    return in_of(joint).stale || in_of(later).changed;
  }

  /// How an impulse along one row changes the speed of another, through a body that both act on.
  TWEENFALL_LANES static void share(const Figures& figures, std::uint32_t place, bool by_b, const Vector* spins,
                                    std::uint32_t later, bool later_by_b, Lanes* block, bool first) {
    const FigureJoint &own = figures.joints[place], &other = figures.joints[later];
    const FigureRow *rows = rows_of(figures, place), *others = rows_of(figures, later);
    const Number mass = figures.bodies[by_b ? own.b : own.a].inverse_mass;
    const bool opposite = by_b != later_by_b;
    const std::uint32_t count = in_of(own).count, points = own.point ? 3 : 0, later_points = other.point ? 3 : 0;
    const auto put = [&](std::uint32_t i, std::uint32_t k, Number sum) __attribute__((always_inline)) {
      if (opposite) sum = -sum;
      if (i >= other.holds) sum = sum * others[in_of(other).slots[i]].in;
      if (k >= own.holds) sum = sum * rows[in_of(own).slots[k]].in;
      if (!first) sum = Number(block[i * count + k]) + sum;
      sum.put(block[i * count + k]);
    };
    if (later_points != 0) {
      const Vector arm = later_by_b ? other.arm_b : other.arm_a;
      for (std::uint32_t k = 0; k < count; ++k) {
        Vector sums = cross(spins[k], arm);
        if (k < points) {
          if (k == 0) sums.x = sums.x + mass;
          if (k == 1) sums.y = sums.y + mass;
          if (k == 2) sums.z = sums.z + mass;
        } else if (const std::uint32_t slot = in_of(own).slots[k]; !own.turning[slot]) {
          sums = sums + mass * Vector(by_b ? rows[slot].linear_b : rows[slot].linear_a);
        }
        put(0, k, sums.x);
        put(1, k, sums.y);
        put(2, k, sums.z);
      }
    }
    for (std::uint32_t i = later_points; i < in_of(other).count; ++i) {
      const std::uint32_t row = in_of(other).slots[i];
      const Vector turn = later_by_b ? others[row].turn_b : others[row].turn_a;
      if (points != 0) {
        Number sums[3] = {dot(turn, spins[0]), dot(turn, spins[1]), dot(turn, spins[2])};
        if (!other.turning[row]) {
          const Vector push = mass * Vector(later_by_b ? others[row].linear_b : others[row].linear_a);
          sums[0] = sums[0] + push.x;
          sums[1] = sums[1] + push.y;
          sums[2] = sums[2] + push.z;
        }
        put(i, 0, sums[0]);
        put(i, 1, sums[1]);
        put(i, 2, sums[2]);
      }
      for (std::uint32_t k = points; k < count; ++k)
        put(i, k,
            with_push(dot(turn, spins[k]), mass, other, others, row, later_by_b, own, rows, in_of(own).slots[k], by_b));
    }
  }

  /// The rows of a joint that hold a point: their effect on each other.
  TWEENFALL_LANES static void fill_point(const FigureJoint& joint, FigureRow* rows, const Number& mass,
                                         const Vector* spins_a, const Vector* spins_b, Lanes* diagonal) {
    const Vector arm_a = joint.arm_a, arm_b = joint.arm_b;
    const std::uint32_t count = in_of(joint).count;
    const auto end = [&](std::uint32_t i, const Number& sum) __attribute__((always_inline)) {
      // Lanes without a figure have no row.
      FigureRow& row = rows[i];
      const Number out = Number(1.0) - Number(row.in);
      const Number inverse = row.in * (sum + mass) + out;
      inverse.put(row.inverse);
      (row.in * (inverse + Number(row.reserve) * inverse + row.compliance) + out).put(diagonal[i * count + i]);
    };
    const Vector first = cross(spins_a[0], arm_a) + cross(spins_b[0], arm_b);
    end(0, first.x);
    first.y.put(diagonal[count]);
    first.z.put(diagonal[2 * count]);
    const Vector second = cross(spins_a[1], arm_a) + cross(spins_b[1], arm_b);
    end(1, second.y);
    second.z.put(diagonal[2 * count + 1]);
    end(2, (cross(spins_a[2], arm_a) + cross(spins_b[2], arm_b)).z);
  }

  TWEENFALL_LANES static void fill(Figures& figures, std::uint32_t place) {
    FigureJoint& joint = figures.joints[place];
    bool fits = !in_of(joint).stale;
    for (std::uint32_t n = figures.firsts[place]; fits && n < figures.firsts[place + 1]; ++n)
      fits = !in_of(figures.joints[figures.links[n].place]).changed;
    if (fits) return;
    FigureRow* rows = rows_of(figures, place);
    const FigureBody &a = figures.bodies[joint.a], &b = figures.bodies[joint.b];
    const FigureRowsIn& in = in_of(joint);
    const std::uint32_t count = in.count, points = joint.point ? 3 : 0;
    Vector spins_a[rows_of_joint], spins_b[rows_of_joint];
    Lanes* diagonal = figures.blocks + in.diagonal;
    if (points != 0) {
      spins_of_point(a.inverse_inertia, joint.arm_a, spins_a);
      spins_of_point(b.inverse_inertia, joint.arm_b, spins_b);
      if (in.stale) fill_point(joint, rows, Number(a.inverse_mass) + b.inverse_mass, spins_a, spins_b, diagonal);
    }
    for (std::uint32_t i = points; i < count; ++i) {
      FigureRow& row = rows[in.slots[i]];
      const Vector turn_a = row.turn_a, turn_b = row.turn_b;
      spins_a[i] = a.inverse_inertia * turn_a;
      spins_b[i] = b.inverse_inertia * turn_b;
      if (!in.stale) continue;
      for (std::uint32_t k = 0; k <= i; ++k) {
        Number sum = dot(turn_a, spins_a[k]) + dot(turn_b, spins_b[k]);
        sum = with_push(sum, a.inverse_mass, joint, rows, in.slots[i], false, joint, rows, in.slots[k], false);
        sum = with_push(sum, b.inverse_mass, joint, rows, in.slots[i], true, joint, rows, in.slots[k], true);
        if (k < i) {
          if (i >= joint.holds) sum = sum * row.in;
          if (k >= joint.holds) sum = sum * rows[in.slots[k]].in;
          sum.put(diagonal[i * count + k]);
          continue;
        }
        // A row that is not `in` wants speed 0, and gets it.
        const Number out = Number(1.0) - Number(row.in);
        const Number inverse = row.in * sum + out;
        inverse.put(row.inverse);
        (row.in * (inverse + Number(row.reserve) * inverse + row.compliance) + out).put(diagonal[i * count + i]);
      }
    }
    for (std::uint32_t n = figures.firsts[place]; n < figures.firsts[place + 1]; ++n) {
      const FigureLink& link = figures.links[n];
      const FigureJoint& other = figures.joints[link.place];
      if (!stale_between(joint, other)) continue;
      Lanes* block = figures.blocks + link.blocks[part];
      bool first = true;
      for (const bool by_b : {false, true})
        for (const bool later_by_b : {false, true}) {
          const std::uint32_t body = by_b ? joint.b : joint.a;
          if (body != (later_by_b ? other.b : other.a) || !figures.bodies[body].moves) continue;
          share(figures, place, by_b, by_b ? spins_b : spins_a, link.place, later_by_b, block, first);
          first = false;
        }
      if (!first) continue;
      for (std::uint32_t i = 0; i < count * in_of(other).count; ++i) nothing().put(block[i]);
    }
  }

  template <std::uint32_t known>
  TWEENFALL_LANES static void factor_diagonal(Figures& figures, std::uint32_t place) {
    FigureJoint& joint = figures.joints[place];
    const FigureRow* rows = rows_of(figures, place);
    const std::uint32_t count = known != 0 ? known : in_of(joint).count;
    Lanes* block = figures.blocks + in_of(joint).diagonal;
    Number redundant = nothing();
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t k = 0; k <= i; ++k) {
        Number sum = block[i * count + k];
        for (std::uint32_t m = 0; m < k; ++m) sum = sum - Number(block[i * count + m]) * Number(block[k * count + m]);
        if (k < i) {
          (sum * block[k * count + k]).put(block[i * count + k]);
          continue;
        }
        const Which news = sum > Number(new_enough) * rows[in_of(joint).slots[i]].inverse;
        const Number root_of_sum = root(select(news, sum, Number(1.0)));
        const Number its = select(news, Number(1.0) / root_of_sum, nothing());
        its.put(block[i * count + i]);
        redundant = greater(redundant, Number(1.0) - one_if(its > nothing()));
      }
    in_of(joint).silent = any(redundant);
  }

  /// Eliminates a joint: subtracts its effect from the later ones. @param known  rows of the joint, or 0 for any
  /// number: the compiler then knows it, for the points of most joints
  template <std::uint32_t known>
  TWEENFALL_LANES static void eliminate(Figures& figures, std::uint32_t place) {
    const FigureJoint& joint = figures.joints[place];
    const std::uint32_t columns = known != 0 ? known : in_of(joint).count;
    if (columns == 0) return;
    const Lanes* diagonal = figures.blocks + in_of(joint).diagonal;
    const std::uint32_t begin = figures.firsts[place], end = figures.firsts[place + 1];
    for (std::uint32_t n = begin; n < end; ++n) {
      const FigureJoint& later = figures.joints[figures.links[n].place];
      if (!stale_between(joint, later)) continue;
      Lanes* block = figures.blocks + figures.links[n].blocks[part];
      for (std::uint32_t i = 0; i < in_of(later).count; ++i) solve_lower(diagonal, block + i * columns, columns);
    }
    for (std::uint32_t n = begin; n < end; ++n) {
      const std::uint32_t column = figures.links[n].place;
      const Lanes* right = figures.blocks + figures.links[n].blocks[part];
      const std::uint32_t others = in_of(figures.joints[column]).count;
      std::uint32_t target = figures.firsts[column];
      for (std::uint32_t p = n; p < end; ++p) {
        const Lanes* left = figures.blocks + figures.links[p].blocks[part];
        Lanes* into = figures.blocks + in_of(figures.joints[column]).diagonal;
        if (!(p == n ? in_of(figures.joints[column]).stale
                     : stale_between(figures.joints[column], figures.joints[figures.links[p].place])))
          continue;
        if (p > n) {
          while (figures.links[target].place != figures.links[p].place) ++target;
          into = figures.blocks + figures.links[target].blocks[part];
        }
        const std::uint32_t rows = in_of(figures.joints[figures.links[p].place]).count;
        for (std::uint32_t i = 0; i < rows; ++i, left += columns, into += others) {
          Number held[known != 0 ? known : rows_of_joint];
          for (std::uint32_t m = 0; m < columns; ++m) held[m] = left[m];
          const Lanes* factor = right;
          for (Lanes *to = into, *end_of_row = into + (p == n ? i + 1 : others); to != end_of_row; ++to) {
            Number sum = held[0] * Number(factor[0]);
            for (std::uint32_t m = 1; m < columns; ++m) sum = sum + held[m] * Number(factor[m]);
            (Number(*to) - sum).put(*to);
            factor += columns;
          }
        }
      }
    }
  }

  /// Finds the factors that are not known, with the same bits as if all were found.
  TWEENFALL_LANES static void factor(Figures& figures) {
    FigurePart& its = figures.parts[part];
    if (!its.stale && !its.changed) return;
    if (its.stale) lay_out(figures);
    its.stale = its.changed = its.silent = false;
    spread_changes(figures);
    for (std::uint32_t place = 0; place < figures.joint_count; ++place)
      if (in_of(figures.joints[place]).changed) choose_rows(figures, place);
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) fill(figures, place);
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const std::uint8_t count = in_of(figures.joints[place]).count;
      if (in_of(figures.joints[place]).stale) {
        TWEENFALL_OF_ROWS(count, factor_diagonal, figures, place)
      }
      TWEENFALL_OF_ROWS(count, eliminate, figures, place)
    }
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      in_of(figures.joints[place]).changed = false;
      its.silent = its.silent || in_of(figures.joints[place]).silent;
    }
  }

  /// lower x = values
  TWEENFALL_LANES static void solve_lower(const Lanes* lower, Lanes* values, std::uint32_t rows) {
    for (std::uint32_t i = 0; i < rows; ++i) {
      Number sum = values[i];
      for (std::uint32_t k = 0; k < i; ++k) sum = sum - Number(lower[i * rows + k]) * Number(values[k]);
      (sum * lower[i * rows + i]).put(values[i]);
    }
  }
  /// lower^T x = values
  TWEENFALL_LANES static void solve_upper(const Lanes* lower, Lanes* values, std::uint32_t rows) {
    for (std::uint32_t i = rows; i-- > 0;) {
      Number sum = values[i];
      for (std::uint32_t k = i + 1; k < rows; ++k) sum = sum - Number(lower[k * rows + i]) * Number(values[k]);
      (sum * lower[i * rows + i]).put(values[i]);
    }
  }
  template <std::uint32_t known>
  TWEENFALL_LANES static void solve_down(Figures& figures, std::uint32_t place) {
    const FigureJoint& joint = figures.joints[place];
    const std::uint32_t columns = known != 0 ? known : in_of(joint).count;
    Lanes* own = figures.values + in_of(joint).value;
    solve_lower(figures.blocks + in_of(joint).diagonal, own, columns);
    for (std::uint32_t n = figures.firsts[place]; n < figures.firsts[place + 1]; ++n) {
      const FigureJoint& other = figures.joints[figures.links[n].place];
      const Lanes* block = figures.blocks + figures.links[n].blocks[part];
      Lanes* its = figures.values + in_of(other).value;
      Number held[known != 0 ? known : rows_of_joint];
      for (std::uint32_t k = 0; k < columns; ++k) held[k] = own[k];
      for (const Lanes* end = its + in_of(other).count; its != end; ++its, block += columns) {
        Number sum = *its;
        for (std::uint32_t k = 0; k < columns; ++k) sum = sum - Number(block[k]) * held[k];
        sum.put(*its);
      }
    }
  }
  template <std::uint32_t known>
  TWEENFALL_LANES static void solve_up(Figures& figures, std::uint32_t place) {
    const FigureJoint& joint = figures.joints[place];
    const std::uint32_t columns = known != 0 ? known : in_of(joint).count;
    Lanes* own = figures.values + in_of(joint).value;
    for (std::uint32_t n = figures.firsts[place]; n < figures.firsts[place + 1]; ++n) {
      const FigureJoint& other = figures.joints[figures.links[n].place];
      const Lanes* block = figures.blocks + figures.links[n].blocks[part];
      const Lanes* its = figures.values + in_of(other).value;
      Number sums[known != 0 ? known : rows_of_joint];
      for (std::uint32_t k = 0; k < columns; ++k) sums[k] = own[k];
      for (const Lanes* end = its + in_of(other).count; its != end; ++its, block += columns)
        for (std::uint32_t k = 0; k < columns; ++k) sums[k] = sums[k] - Number(block[k]) * Number(*its);
      for (std::uint32_t k = 0; k < columns; ++k) sums[k].put(own[k]);
    }
    solve_upper(figures.blocks + in_of(joint).diagonal, own, columns);
  }
  TWEENFALL_LANES static void solve_values(Figures& figures) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      TWEENFALL_OF_ROWS(in_of(figures.joints[place]).count, solve_down, figures, place)
    }
    for (std::uint32_t place = figures.joint_count; place-- > 0;) {
      TWEENFALL_OF_ROWS(in_of(figures.joints[place]).count, solve_up, figures, place)
    }
  }
  /// Applies the resulting impulses to the bodies.
  TWEENFALL_LANES static void give_values(Figures& figures) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      const FigureRowsIn& in = in_of(joint);
      const FigureRow* rows = rows_of(figures, place);
      const Lanes* values = figures.values + in.value;
      Sum sum{no_vector(), no_vector(), no_vector(), no_vector()};
      if (joint.point) sum = sum_of_point(joint, {values[0], values[1], values[2]});
      for (std::uint32_t i = joint.point ? 3 : 0; i < in.count; ++i)
        add(rows[in.slots[i]], joint.turning[in.slots[i]], values[i], sum);
      give_to(figures, joint, sum);
    }
  }
};

#pragma GCC diagnostic pop

}  // namespace tweenfall::joints
