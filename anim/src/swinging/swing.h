#pragma once

// The common part of operations with springs: their course from the start of the state to now, from instant to instant.

#include "graph/swing_course.h"
#include "operations/changing.h"

#include <functional>

namespace tweenfall::graphs {

/// Springs use a clock that begins at the last instant, and see the base as it would continue from there if nothing
/// more happened: so their movement until the next instant depends only on what happened before it.
template <class State>
class Swing : public Changing {
 public:
  static constexpr std::size_t own_rooms = 5;  // the pose below at another time, two for scratch, and both sides

  Swing(Changed changed, std::size_t number) : Changing(std::move(changed)), number_(number) {}

 protected:
  /// Resets a state to the base, at 0 s of a clock, with the size that all states have.
  virtual void rest(State& state) const noexcept = 0;
  virtual void show(State& state, double time, const PoseAt& pose_at, const Sample<double>& weight,
                    std::span<Motion> scratch, std::span<Motion> pose) const noexcept = 0;
  virtual void begin_again(State& state, double time, const PoseAt& pose_at, std::span<Motion> scratch,
                           std::span<const Motion> before, std::span<const Motion> after) const noexcept = 0;

  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch& scratch,
              std::span<Motion> pose) const noexcept final {
    const std::size_t nodes = pose.size();
    const auto room = [&](std::size_t i) { return std::span<Motion>(scratch.free + i * nodes, nodes); };
    const Script script{
        *this, log, moment.start, room(0), {scratch.below, scratch.free + own_rooms * nodes, scratch.source}};
    const std::span<Motion> work(scratch.free + nodes, 2 * nodes), before = room(3), after = room(4);

    SwingMemory& memory = log.swings[number_];
    if (!memory.prepared) prepare(memory);
    SwingCourse& course = course_since(memory, moment.start);
    const double last = last_instant(log, moment.start, moment.time, moment.side);
    SwingMark& here = next_mark(course);
    take_up(log, course, last, moment.time, here);
    State& state = std::get<State>(here.state);
    for (;;) {
      const double from = here.instant;
      const Clock clock{&script, from};
      const PoseAt pose_at = [&clock](double time, std::span<Motion> out) { clock.at(time, out); };
      if (!(from < last)) {
        const Blinkers blinkers(log, from);
        show(state, moment.time - from, pose_at, weight, work, pose);
        here.time = moment.time;
        break;
      }
      const double next = next_instant(log, from);
      {
        const Blinkers blinkers(log, from);
        script.at(next, Side::in, before);
      }
      {
        const Blinkers blinkers(log, next);
        script.at(next, Side::out, after);
      }
      const Blinkers blinkers(log, from);
      begin_again(state, next - from, pose_at, work, before, after);
      here.instant = here.time = next;
      keep(course, here);
    }
    keep(course, here);
  }

 private:
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
      (*free.source)(time, side, below);
      swing.show_base(log, moment, {below, free.free, free.source}, out);
    }
  };
  struct Clock {
    const Script* script;
    double began;
    void at(double time, std::span<Motion> out) const noexcept { script->at(began + time, Side::out, out); }
  };

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
  void take_up(const Log& log, const SwingCourse& course, double last, double time, SwingMark& here) const noexcept {
    here.instant = here.time = -1;  // so that `here` itself is not found
    double instant = last, limit = time;
    while (const SwingMark* found = furthest_mark(course, instant, limit)) {
      // A mark on an earlier clock is valid up to the end of that clock.
      const double end = found->instant == last ? time : next_instant(log, found->instant);
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
};

}  // namespace tweenfall::graphs
