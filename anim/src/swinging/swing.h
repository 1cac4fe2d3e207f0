#pragma once

// The common part of operations with springs: their course from the start of the state to now, from instant to instant.

#include <tweenfall/curves/rotation.h>

#include "graph/swing_course.h"
#include "operations/changing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace tweenfall::graphs {

/// What the log shows on the clock of a state.
struct ClockSight {
  const Log& log;
  double began, start;  // s: of the clock, and of the state around the operation
  Side side = Side::out;

  [[nodiscard]] Moment at(double time, Side on) const noexcept { return {began + time, on, start}; }
};

/// Springs use a clock that begins at the last instant, and see the base as it would continue from there if nothing
/// more happened: so their movement until the next instant depends only on what happened before it. Where a clip makes
/// the base jump is an instant too, before which the base is seen as going on straight.
template <class State>
class Swing : public Changing {
 public:
  static constexpr double blur = 1e-3;         // s; over which jumps may be too many to count
  static constexpr std::size_t own_rooms = 5;  // the pose below at another time, two for scratch, and both sides

  /// @param step  the longest of its grids, s
  Swing(Changed changed, std::size_t number, double step)
      : Changing(std::move(changed)), number_(number), step_(step) {}

 protected:
  /// Resets a state to the base, at 0 s of a clock, with the size that all states have.
  virtual void rest(State& state) const noexcept = 0;
  virtual void show(State& state, double time, const ClockSight& sight, const PoseAt& pose_at,
                    const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) const noexcept = 0;
  virtual void begin_again(State& state, double time, const ClockSight& sight, const PoseAt& pose_at,
                           std::span<Motion> scratch, std::span<const Motion> before,
                           std::span<const Motion> after) const noexcept = 0;

  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch& scratch,
              std::span<Motion> pose) const noexcept final {
    const std::size_t nodes = pose.size();
    const auto room = [&](std::size_t i) { return std::span<Motion>(scratch.free + i * nodes, nodes); };
    const Script script{
        *this, log, moment.start, room(0), {scratch.below, scratch.free + own_rooms * nodes, scratch.ground}};
    const std::span<Motion> work(scratch.free + nodes, 2 * nodes), before = room(3), after = room(4);

    SwingMemory& memory = log.swings[number_];
    if (!memory.prepared) prepare(memory);
    SwingCourse& course = course_since(memory, moment.start);
    SwingMark& here = next_mark(course);
    const double sure = last_sure(log);
    take_up(script, course, moment, sure, here);
    State& state = std::get<State>(here.state);
    for (;;) {
      const double from = here.instant, jump = jump_of_base(script, course, moment, from);
      const Clock clock{&script, from, jump};
      const PoseAt pose_at = [&clock](double time, std::span<Motion> out) { clock.at(time, out); };
      const double next = std::min(jump, next_shown(log, from, sure));
      if (moment.side == Side::out ? next > moment.time : next >= moment.time) {
        const Blinkers blinkers(log, from);
        show(state, moment.time - from, {log, from, moment.start, moment.side}, pose_at, weight, work, pose);
        here.time = moment.time;
        break;
      }
      {
        const Blinkers blinkers(log, from);
        script.at(next == jump ? Clock::arrival(jump) : next, Side::in, before);
      }
      {
        const Blinkers blinkers(log, next);
        script.at(next, Side::out, after);
      }
      const Blinkers blinkers(log, from);
      begin_again(state, next - from, {log, from, moment.start}, pose_at, work, before, after);
      here.instant = here.time = next;
      if (next <= sure) keep(course, here);
    }
    if (here.time <= sure)
      keep(course, here);
    else
      here.instant = here.time = -1;  // where something hidden is missing, it does not count
  }

 private:
  /// The next instant that is not hidden.
  static double next_shown(const Log& log, double after, double sure) noexcept {
    const double next = next_instant(log, after);
    return next > sure ? std::numeric_limits<double>::infinity() : next;
  }

  /// The base at any time.
  struct Script {
    const Swing& swing;
    const Log& log;
    double start;
    std::span<Motion> below;
    Scratch free;

    void at(double time, Side side, std::span<Motion> out) const noexcept {
      const Moment moment{time, side, start};
      if (swing.base() && swing.base()->recall(log, moment, out)) return;
      free.ground->pose(time, side, below);
      swing.show_base(log, moment, {below, free.free, free.ground}, out);
    }
  };
  struct Clock {
    const Script* script;
    double began, jump;

    /// The last time before a jump: at its own, rounded, a clip may already be behind it.
    static double arrival(double jump) noexcept { return std::nextafter(jump, 0.0); }
    void at(double time, std::span<Motion> out) const noexcept {
      if (began + time < jump) return script->at(began + time, Side::out, out);
      script->at(arrival(jump), Side::in, out);
      const double beyond = began + time - jump;
      for (Motion& motion : out) {
        motion.pose.position += beyond * motion.twist.linear;
        motion.pose.rotation = exp_map(beyond * motion.twist.angular) * motion.pose.rotation;
        motion.pose.scale += beyond * motion.scale_rate;
      }
    }
  };

  /// The first time after a clock began at which the base may jump, because of a clip in it or of what lies below the
  /// graph, up to two steps beyond the clock or the moment: springs look ahead by no more than one; infinity for none.
  [[nodiscard]] double jump_of_base(const Script& script, SwingCourse& course, const Moment& moment,
                                    double from) const noexcept {
    const Log& log = script.log;
    // Beyond a hidden instant the base looks different than it will: that is not remembered.
    const double sure = last_sure(log);
    const double until = std::min(moment.time, next_shown(log, from, sure)) + 2 * step_;
    JumpMark& mark = jump_mark(course, from);
    const double known = std::max(from, std::min(mark.searched, sure));
    if (mark.jump <= known) return mark.jump <= until ? mark.jump : std::numeric_limits<double>::infinity();
    if (until <= known) return std::numeric_limits<double>::infinity();
    double found = first_jump_of_base(script, moment.start, {from, known, until});
    if (found < from + blur && is_dense(script, moment.start, from, found))
      found = until > from + blur ? first_jump_of_base(script, moment.start, {from, from + blur, until})
                                  : std::numeric_limits<double>::infinity();
    if (until > sure) return found;
    // A time that is rounded may be on either side of the end of a search, so the next one begins a little before.
    mark.searched = std::max(known, std::min(found, until - 1e-9 * (1 + until)));
    mark.jump = found;
    return found;
  }
  /// Whether so many jumps follow an instant that no spring could tell them apart, nor wait until each is answered: as
  /// those of a clip that lasts a microsecond. Then only one in each such time counts.
  [[nodiscard]] bool is_dense(const Script& script, double start, double from, double first) const noexcept {
    constexpr int most = 32;
    double jump = first;
    for (int i = 0; i < most && jump <= from + blur; ++i)
      jump = first_jump_of_base(script, start, {from, jump, from + blur});
    return jump <= from + blur;
  }
  [[nodiscard]] double first_jump_of_base(const Script& script, double start, const Search& search) const noexcept {
    double first = std::numeric_limits<double>::infinity();
    if (base()) first = base()->next_jump(script.log, start, search).value_or(first);
    const GraphGround& ground = *script.free.ground;
    // Every pose shows what is below, where its clips do not move a node.
    if (ground.next_jump)
      first = ground.next_jump(search.since, search.after, std::min(first, search.until)).value_or(first);
    return first;
  }

  void put_at_rest(SwingMark& mark) const noexcept {
    if (!std::holds_alternative<State>(mark.state)) mark.state.template emplace<State>();
    rest(std::get<State>(mark.state));
  }

  /// Allocates all memory at the first use.
  void prepare(SwingMemory& memory) const noexcept {
    for (SwingCourse& course : memory.courses) {
      for (SwingMark& mark : course.latest)
        if (mark.time < 0) put_at_rest(mark);
      for (SwingMark& mark : course.markers) put_at_rest(mark);
    }
    memory.prepared = true;
  }

  /// Sets `here` to the mark to continue from.
  void take_up(const Script& script, SwingCourse& course, const Moment& moment, double sure,
               SwingMark& here) const noexcept {
    here.instant = here.time = -1;  // so that `here` itself is not found
    // What arrives at an instant is not yet on the clock that begins there.
    double instant = std::min(sure, moment.side == Side::out ? moment.time : std::nextafter(moment.time, -1.0));
    double limit = std::min(sure, moment.time);
    while (const SwingMark* found = furthest_mark(course, instant, limit)) {
      // A mark on an earlier clock is valid up to the end of that clock.
      const double end = std::min({moment.time, next_shown(script.log, found->instant, sure),
                                   jump_of_base(script, course, moment, found->instant)});
      if (found->time <= end && std::holds_alternative<State>(found->state)) {
        here = *found;
        return;
      }
      instant = found->time > end ? found->instant : std::nextafter(found->instant, -1.0);
      limit = std::min(limit, end);
    }
    here.instant = here.time = course.start;
    put_at_rest(here);
  }

  std::size_t number_;
  double step_;
};

}  // namespace tweenfall::graphs
