#include <array>

#include "joints/figure_writing.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::joints {

namespace {

/// Rounds in which rows change places between `in` and beside, before those that bound stay where they are.
constexpr int most_rounds = 4;
/// A bound passed by less than this is not passed, m/s or rad/s.
constexpr double passable = 1e-10;
/// If a row at its bound presses on although it parts, or although it moves faster than it is driven, by more than
/// this, the rounds led astray, m/s or rad/s.
constexpr double astray = 0.02;
/// Passes in which such rows are then solved one after another.
constexpr int most_passes = 12;

/// How rows change places between `in` and beside, in registers of one kind.
template <class Register>
struct FigureWork : FigureWriting<Register> {
  using Factors = FigureFactors<Register>;
  using Number = typename Factors::Number;
  using Vector = typename Factors::Vector;
  using Ends = typename Factors::Ends;
  using Sum = typename Factors::Sum;
  using Which = typename Factors::Which;
  using Factors::add;
  using Factors::any;
  using Factors::apply;
  using Factors::ends_of;
  using Factors::factor;
  using Factors::give_to;
  using Factors::give_values;
  using Factors::in_of;
  using Factors::inverse_of;
  using Factors::lack_of;
  using Factors::no_vector;
  using Factors::nothing;
  using Factors::one_if;
  using Factors::part;
  using Factors::point_speed;
  using Factors::read;
  using Factors::rows_of;
  using Factors::size_of;
  using Factors::solve_values;
  using Factors::speed_of;
  using Factors::sum_of_point;
  using Factors::write;
  using FigureWriting<Register>::used_of;

  // Rounds

  /// Gives redundant rows no impulse.
  TWEENFALL_LANES static void drop_silent(Figures& figures, const Number& live) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = 0; i < in_of(joint).count; ++i) {
        const Number its = figures.blocks[in_of(joint).diagonal + i * in_of(joint).count + i];
        FigureRow& row = rows[in_of(joint).slots[i]];
        const Number dropped = live * select(its > nothing(), nothing(), row.impulse);
        if (!any(one_if(size_of(dropped) > nothing()))) continue;
        apply(figures, joint, in_of(joint).slots[i], row, -dropped);
        (Number(row.impulse) - dropped).put(row.impulse);
      }
    }
  }

  TWEENFALL_LANES static Number wanted_of(const FigureRow& row, const Number& speed, bool moving) {
    return lack_of(row, speed, moving) - (Number(give) * row.inverse) * row.impulse;
  }

  /// In some lanes, solves all rows that are `in` for the speeds that they want. @return lanes in which one has bounds
  TWEENFALL_LANES static Number solve_in(Figures& figures, const Number& live, bool moving) {
    if (figures.parts[part].silent) drop_silent(figures, live);
    Number bounded = nothing();
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      const FigureRow* rows = rows_of(figures, place);
      Lanes* values = figures.values + in_of(joint).value;
      const Ends ends = ends_of(figures, joint);
      if (joint.point) {
        const Vector speed = point_speed(joint, ends);
        (live * wanted_of(rows[0], speed.x, moving)).put(values[0]);
        (live * wanted_of(rows[1], speed.y, moving)).put(values[1]);
        (live * wanted_of(rows[2], speed.z, moving)).put(values[2]);
      }
      for (std::uint32_t i = joint.point ? 3 : 0; i < in_of(joint).count; ++i) {
        const std::uint32_t slot = in_of(joint).slots[i];
        const FigureRow& row = rows[slot];
        const Number value = live * wanted_of(row, speed_of(row, joint.turning[slot], ends), moving);
        if (slot < joint.holds) {
          value.put(values[i]);
        } else {
          (value * row.in).put(values[i]);
          bounded = greater(bounded, row.in * Number(row.bounded));
        }
      }
    }
    solve_values(figures);
    give_values(figures);
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = 0; i < in_of(joint).count; ++i) {
        FigureRow& row = rows[in_of(joint).slots[i]];
        (Number(row.impulse) + figures.values[in_of(joint).value + i]).put(row.impulse);
      }
    }
    return bounded;
  }

  /// @param changed  lanes in which a row of the joint came in or left
  TWEENFALL_LANES static void note_change(Figures& figures, std::uint32_t place, const Number& changed) {
    if (!any(changed)) return;
    in_of(figures.joints[place]).changed = true;
    figures.parts[part].changed = true;
  }

  /// Lets in rows beside whose bounds would be passed. @return lanes in which any came in
  TWEENFALL_LANES static Number admit(Figures& figures, const Number& live, bool moving) {
    Number changed = nothing();
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      if (joint.holds == joint.count) continue;
      const Ends ends = ends_of(figures, joint);
      Number entered = nothing();
      for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
        FigureRow& row = rows[i];
        const Number rest = lack_of(row, speed_of(row, joint.turning[i], ends), moving);
        const Number up = one_if(rest > Number(passable)) * one_if(row.impulse < Number(row.high));
        const Number down = one_if(rest < Number(-passable)) * one_if(row.impulse > Number(row.low));
        const Number enters = live * (Number(row.present) - Number(row.in)) * (up + down);
        (Number(row.in) + enters).put(row.in);
        entered = greater(entered, enters);
      }
      note_change(figures, place, entered);
      changed = greater(changed, entered);
    }
    return changed;
  }

  /// Takes out rows that got beyond their bounds, or to them. @param everything  also all others with bounds
  TWEENFALL_LANES static Number dismiss(Figures& figures, const Number& live, bool everything) {
    Number changed = nothing();
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
        FigureRow& row = rows[i];
        const Number impulse = row.impulse;
        Number leaves = live * row.in * Number(row.bounded);
        if (!everything)
          leaves = leaves * (Number(1.0) - one_if(impulse >= row.low) * one_if(Number(row.high) >= impulse));
        if (!any(leaves)) continue;
        const Number within = lesser(greater(impulse, row.low), row.high);
        const Number change = select(leaves > nothing(), within - impulse, nothing());
        apply(figures, joint, i, row, change);
        select(leaves > nothing(), within, impulse).put(row.impulse);
        (Number(row.in) - leaves).put(row.in);
        note_change(figures, place, leaves);
        changed = greater(changed, leaves);
      }
    }
    return changed;
  }

  /// @return those of the given lanes in which something presses where it should pull
  TWEENFALL_LANES static Number led_astray(const Figures& figures, const Number& live, bool moving) {
    Number found = nothing();
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      const FigureRow* rows = rows_of(figures, place);
      const Ends ends = ends_of(figures, joint);
      for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
        const FigureRow& row = rows[i];
        const Number rest = lack_of(row, speed_of(row, joint.turning[i], ends), moving);
        const Number presses = one_if(row.impulse > nothing()) * one_if(rest < Number(-astray));
        const Number pulls = one_if(row.impulse < nothing()) * one_if(rest > Number(astray));
        found = greater(found, Number(row.present) * Number(row.bounded) * (presses + pulls));
      }
    }
    return live * found;
  }

  /// Starts over without the rows that bound or drive, and then solves them one by one, with all rows that hold solved
  /// in between: this converges far slower, but every row takes energy out, as it should. Source: Cottle, Pang and
  /// Stone, The Linear Complementarity Problem, 1992, 5.2 (projected Gauss-Seidel).
  TWEENFALL_LANES static void begin_anew(Figures& figures, const Number& live, bool moving) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
        FigureRow& row = rows[i];
        const Number its = live * Number(row.present) * Number(row.bounded);
        const Number dropped = select(its > nothing(), row.impulse, nothing());
        apply(figures, joint, i, row, -dropped);
        select(its > nothing(), nothing(), row.impulse).put(row.impulse);
        select(its > nothing(), nothing(), row.in).put(row.in);
      }
    }
    figures.parts[part].stale = true;
    factor(figures);
    static_cast<void>(solve_in(figures, live, moving));
    for (int pass = 0; pass < most_passes; ++pass) {
      for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
        const FigureJoint& joint = figures.joints[place];
        FigureRow* rows = rows_of(figures, place);
        for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
          FigureRow& row = rows[i];
          const Number its = live * Number(row.present) * Number(row.bounded);
          const Number inverse = inverse_of(figures, place, i) + Number(row.compliance);
          const Which moves = its * inverse > nothing();
          const Ends ends = ends_of(figures, joint);
          const Number rest = lack_of(row, speed_of(row, joint.turning[i], ends), moving);
          const Number wanted = Number(row.impulse) + rest / select(moves, inverse, Number(1.0));
          const Number within = lesser(greater(wanted, row.low), row.high);
          const Number change = select(moves, within - Number(row.impulse), nothing());
          apply(figures, joint, i, row, change);
          select(moves, within, row.impulse).put(row.impulse);
        }
      }
      static_cast<void>(solve_in(figures, live, moving));
    }
  }

  TWEENFALL_LANES static void solve(Figures& figures, bool moving) {
    read(figures);
    Number live = used_of(figures);
    Number again = live;
    // Afterwards the factors at hand are tried first.
    if (moving) admit(figures, live, moving);
    Number ending = nothing();  // lanes that are solved for the last time, each after as many rounds as it needs
    bool finished = false;
    for (int round = 0;; ++round) {
      factor(figures);
      const Number bounded = solve_in(figures, again, moving);
      if (any(ending))
        if (const Number lost = led_astray(figures, ending, moving); any(lost)) begin_anew(figures, lost, moving);
      if (finished) break;
      Number changed;
      if (round == most_rounds) {
        // Rows that hold have the last word.
        changed = again = ending = dismiss(figures, live, true);
        finished = true;
      } else {
        changed = dismiss(figures, live, false);
        changed = greater(changed, admit(figures, live, moving));
        again = moving ? changed : greater(changed, live * bounded);
        ending = again - again * changed;
        finished = !any(changed);
      }
      if (!any(again)) break;
      live = changed;
    }
    write(figures);
  }

  TWEENFALL_LANES static void warm_start(Figures& figures) {
    read(figures);
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      const FigureRow* rows = rows_of(figures, place);
      Sum sum{no_vector(), no_vector(), no_vector(), no_vector()};
      if (joint.point) sum = sum_of_point(joint, {rows[0].impulse, rows[1].impulse, rows[2].impulse});
      for (std::uint32_t i = joint.point ? 3 : 0; i < joint.count; ++i)
        add(rows[i], joint.turning[i], rows[i].impulse, sum);
      give_to(figures, joint, sum);
    }
    write(figures);
  }

  TWEENFALL_LANES static void moved(Figures& figures) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
        FigureRow& row = rows[i];
        const Number there = one_if(row.low >= nothing()) * one_if(row.impulse > nothing()) *
                             one_if(row.wanted < nothing()) * (Number(1.0) - one_if(row.compliance > nothing())) *
                             Number(row.bounded);
        select(there > nothing(), nothing(), row.wanted_after).put(row.wanted_after);
      }
    }
  }

  TWEENFALL_LANES static void close(Figures& figures, bool of_what_holds, const Lanes& live, Lanes& widest) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = joint.holds; i < joint.count; ++i) {
        FigureRow& row = rows[i];
        const Number its = of_what_holds ? nothing() : Number(row.present) * one_if(size_of(row.left) > nothing());
        select(row.bounded > nothing(), its, row.in).put(row.in);
        figures.parts[part].stale = true;
      }
    }
    factor(figures);
    Number most = nothing();
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      const FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = 0; i < in_of(joint).count; ++i) {
        const FigureRow& row = rows[in_of(joint).slots[i]];
        const Number left = row.left * Number(row.in);
        most = greater(most, size_of(left));
        (left * live).put(figures.values[in_of(joint).value + i]);
      }
    }
    most.put(widest);
    solve_values(figures);
    for (std::uint32_t i = 0; i < figures.body_count; ++i) {
      no_vector().put(figures.bodies[i].linear);
      no_vector().put(figures.bodies[i].angular);
    }
    give_values(figures);
  }

  TWEENFALL_LANES static void hold_only(Figures& figures) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      const FigureJoint& joint = figures.joints[place];
      FigureRow* rows = rows_of(figures, place);
      for (std::uint32_t i = 0; i < joint.count; ++i) {
        FigureRow& row = rows[i];
        nothing().put(row.impulse);
        if (i >= joint.holds) {
          const Number held = Number(1.0) - Number(row.bounded);
          figures.parts[part].stale = figures.parts[part].stale || any(row.in * Number(row.bounded));
          (row.in * held).put(row.in);
          (row.present * held).put(row.present);
        }
        nothing().put(row.wanted_after);
      }
    }
  }

  TWEENFALL_LANES static void add_up(Figures& figures) {
    for (std::uint32_t place = 0; place < figures.joint_count; ++place) {
      FigureJoint& joint = figures.joints[place];
      const FigureRow* rows = rows_of(figures, place);
      Vector push = no_vector(), turn = no_vector();
      for (std::uint32_t i = joint.point ? 3 : 0; i < joint.count; ++i) {
        const Number impulse = rows[i].impulse;
        if (!joint.turning[i]) push = push + impulse * rows[i].linear_b;
        turn = turn + impulse * rows[i].turn_b;
      }
      turn = turn - cross(Vector(joint.arm_b), push);
      // The rows of the point push there.
      if (joint.point) push = push + Vector(rows[0].impulse, rows[1].impulse, rows[2].impulse);
      (Vector(joint.push) + push).put(joint.push);
      (Vector(joint.turn) + turn).put(joint.turn);
    }
  }
};

/// The copy has pointers of its own, which no write to lanes can change.
#define TWEENFALL_FIGURE_KERNEL(name, Numbers, target, work, Given, given) \
  target void work##_##name Given {                                        \
    Figures own = figures;                                                 \
    FigureWork<Numbers>::work given;                                       \
  }
/// What solves: all lanes at once, or in two parts, of which the second is often empty.
#define TWEENFALL_FIGURE_SOLVER(name, First, Second, target, work, Given, given) \
  target void work##_##name Given {                                              \
    Figures own = figures;                                                       \
    FigureWork<First>::work given;                                               \
    if constexpr (part_of<Second> != 0)                                          \
      if (figures.used > lane_count / 2) FigureWork<Second>::work given;         \
    figures.parts = own.parts;                                                   \
  }
#define TWEENFALL_FIGURE_KERNELS(name, Numbers, First, Second, target)                                               \
  TWEENFALL_FIGURE_KERNEL(name, Numbers, target, write_all, (Figures & figures, const WriteRule& rule), (own, rule)) \
  TWEENFALL_FIGURE_KERNEL(name, Numbers, target, warm_start, (Figures & figures), (own))                             \
  TWEENFALL_FIGURE_SOLVER(name, First, Second, target, solve, (Figures & figures, bool moving), (own, moving))       \
  TWEENFALL_FIGURE_KERNEL(name, Numbers, target, moved, (Figures & figures), (own))                                  \
  TWEENFALL_FIGURE_SOLVER(name, First, Second, target, close,                                                        \
                          (Figures & figures, bool of_what_holds, const Lanes& live, Lanes& widest),                 \
                          (own, of_what_holds, live, widest))                                                        \
  TWEENFALL_FIGURE_SOLVER(name, First, Second, target, hold_only, (Figures & figures), (own))                        \
  TWEENFALL_FIGURE_KERNEL(name, Numbers, target, add_up, (Figures & figures), (own))                                 \
  constexpr FigureKernels name = {write_all_##name, warm_start_##name, solve_##name, moved_##name,                   \
                                  close_##name,     hold_only_##name,  add_up_##name};

constexpr int middle = lane_count / 2;
using LowTwos = LanesFrom<Halves<Two>, 0>;
using HighTwos = LanesFrom<Halves<Two>, middle>;
TWEENFALL_FIGURE_KERNELS(plain_figures, Halves<Halves<Two>>, LowTwos, HighTwos, )
#if defined(__x86_64__) || defined(__i386__)
using LowFour = LanesFrom<Four, 0>;
using HighFour = LanesFrom<Four, middle>;
TWEENFALL_FIGURE_KERNELS(avx2_figures, Halves<Four>, LowFour, HighFour, [[gnu::target("avx2")]])
TWEENFALL_FIGURE_KERNELS(avx512_figures, Eight, Eight, Eight, [[gnu::target("avx512f,avx512vl,avx512dq")]])
#endif

}  // namespace

std::span<const FigureKernels* const> possible_figure_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain_figures, &avx2_figures, &avx512_figures};
#else
  static constexpr std::array all = {&plain_figures};
#endif
  return std::span(all).first(blocks::possible_versions());
}

const FigureKernels& fastest_figure_kernels() {
  static const FigureKernels& fastest = *possible_figure_kernels().back();
  return fastest;
}

}  // namespace tweenfall::joints
