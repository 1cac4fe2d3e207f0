#pragma once

// A play from one change to the next: its clock as a function of time, and the times as functions of the clock.

#include <tweenfall/anim/player.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall {

namespace clips {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// What happens this soon after a change comes before it, s: a stage has told of it by then.
inline constexpr double instant = 1e-9;

/// All rounds of a play, one after another: the phase is 0 at their start and `total` at their end.
struct Rounds {
  double from = 0;    ///< of the section, clip seconds
  double length = 0;  ///< of one round, s; may be infinite
  LoopMode mode = LoopMode::once;
  bool reverse = false;
  double left_out = 0;  ///< rounds before phase 0: even, and 0 unless there are very many, so that no digits are lost
  double counted = 0;   ///< rounds from phase 0 on, where they are counted
  double low = 0, total = 0;
  bool lands = false;  ///< its end is that of the clip, where the clip jumps to its last keys

  [[nodiscard]] bool loops() const noexcept { return mode != LoopMode::once && length > 0 && std::isfinite(length); }
  [[nodiscard]] bool is_flipped(double round) const noexcept {
    return (loops() && mode == LoopMode::pingpong && std::fmod(round, 2.0) != 0) != reverse;
  }
  /// Phase at which a round reaches a time of its section, 0 to `length`; where two rounds meet, the same for both.
  [[nodiscard]] double phase_of(double round, double inside) const noexcept {
    const double way = is_flipped(round) ? length - inside : inside;
    if (!loops()) return way;
    return way == length ? (round + 1) * length : round * length + way;
  }
};

[[nodiscard]] Rounds rounds_of(const Play& play, const Clip& clip) noexcept;
/// For a clip that is played whole. @param lands as from `lands_on_last_key`
[[nodiscard]] Rounds rounds_of(double duration, const Loop& loop, bool backwards, bool lands) noexcept;
/// The clock of a play at one speed that starts at `at`: what `Course` gives, without finding when it ends.
[[nodiscard]] ClipClock steady_clock(const Rounds& rounds, double at, double speed, double time, Side side) noexcept;

/// The first time after `after` at which such a clock meets a moment of a clip that is played whole; infinity for none.
[[nodiscard]] double next_moment(const Rounds& rounds, std::span<const ClipEvent> moments, double at, double speed,
                                 double after) noexcept;

/// A stretch of time in which the phase goes one way.
struct Stretch {
  double from = 0, to = 0;  ///< s
  double turn = 0;          ///< where the speed alone would end it, s: the next turn, or infinity
  double phase_from = 0, phase_to = 0;
  int direction = 1;
  bool first = false;   ///< the clock begins to move here
  bool sought = false;  ///< it was put there by a seek: what is there is not reached
  bool told = false;    ///< a change has told which intervals begin here
};

/// What a clock has done so far: by a seek it is put to another time, and has not reached what is there.
enum class Past { rested, sought, moved };

/// The clock of a play: its phase as a function of time, and the times as functions of the phase.
class Course {
 public:
  Course(const Rounds& all, const PlaySpeed& pace, double start, double offset) noexcept;

  [[nodiscard]] double phase(double time) const noexcept {
    return speed.is_constant() ? origin_phase + (time - origin) * speed.at(0)
                               : origin_phase + (speed.way(time - speed_from) - way_at_origin);
  }
  /// The phase limited to the rounds, and held after the end.
  [[nodiscard]] double held_phase(double time) const noexcept {
    return time >= end ? end_phase : std::clamp(phase(std::max(time, at)), rounds.low, rounds.total);
  }
  [[nodiscard]] ClipClock clock(double time, Side side) const noexcept;
  /// The way that it runs just after `time`; before its start, the way that it will run first.
  [[nodiscard]] int direction(double time) const noexcept {
    return time < at ? speed.first_direction() : speed.direction(time - speed_from);
  }
  /// The round that it shows just after `time`: where two meet, the one into which it runs.
  [[nodiscard]] double round_at(double time) const noexcept {
    if (!rounds.loops()) return 0;
    const double here = held_phase(time), round = std::floor(here / rounds.length);
    const bool from_above = here == rounds.total || (direction(time) < 0 && here != rounds.low);
    return from_above && here == round * rounds.length ? round - 1 : round;
  }
  /// The time at which a stretch reaches a phase within it. @param most  numbers by which it may be later, so that the
  /// clock is there as it rounds
  [[nodiscard]] double time_of(double wanted, const Stretch& stretch, int most = 16) const noexcept;
  /// The time from which it is in force: `since`, or its start.
  [[nodiscard]] double begin() const noexcept { return std::max(at, since); }

  [[nodiscard]] Past past() const noexcept { return moved ? Past::moved : sought ? Past::sought : Past::rested; }
  /// Makes `time`, with the phase there, the origin of its clock.
  void set_origin(double time, double at_phase) noexcept;
  void find_end() noexcept;

  /// Calls `visit` with the stretches that touch [from, to], cut off at `last`, in order, until it returns false.
  template <class Visit>
  void visit_stretches(double from, double to, double last, const Visit& visit) const {
    const double begins = begin(), ends = std::min(last, end);
    if (!(begins <= ends)) return;
    const std::span<const double> turns = speed.turns();
    auto next =
        static_cast<std::size_t>(std::ranges::lower_bound(turns, std::max(from, begins) - speed_from) - turns.begin());
    for (double start = next == 0 ? begins : std::max(begins, speed_from + turns[next - 1]);; ++next) {
      const double natural = next < turns.size() ? speed_from + turns[next] : infinity;
      const double finish = std::min(natural, ends);
      const int direction = speed.direction_after(next);
      // Also one that only begins, as the next change comes: what it meets there is told.
      const bool begins_here = start == first_move || (start == last && start < end);
      if (direction != 0 && (start < finish || (begins_here && start < natural))) {
        Stretch stretch{.from = start, .to = finish, .turn = natural, .direction = direction};
        stretch.phase_from = held_phase(start);
        stretch.phase_to = finish == infinity ? direction * infinity : held_phase(finish);
        stretch.first = !moved && start == first_move;
        stretch.sought = sought;
        stretch.told = start == begins && (moved || start == since);
        if (!visit(stretch)) return;
      }
      if (natural > ends || natural == end || natural > to) return;
      start = natural;
    }
  }

  Rounds rounds;
  PlaySpeed speed;
  double since = -infinity;  ///< it is in force from here on, s
  double met = -infinity;    ///< until when the one before tells what it meets, s: `since`, or just after
  double at = 0;             ///< its start, s
  double origin = 0, origin_phase = 0;
  double speed_from = 0, way_at_origin = 0;  ///< for a speed that is a curve: where that begins
  double end = infinity, end_phase = 0;      ///< when its rounds are over, and where
  bool moved = false;                        ///< whether it had moved before `since`
  bool sought = false;                       ///< whether a seek has put it where it stands, if it has not moved before
  double first_move = infinity;              ///< when its clock first moves, if it has not moved before
};

/// An event interval of a clip that contains a phase, with its round.
struct OpenInterval {
  std::size_t event;
  double round;
  bool operator==(const OpenInterval&) const = default;
};
/// The intervals in which a clock is that runs on from a phase: forwards, backwards, or, with 0, not at all.
[[nodiscard]] std::vector<OpenInterval> open_intervals(const Rounds& rounds, const Clip& clip, double phase,
                                                       int direction);

/// What a clock meets when it jumps from one phase to another, as if it ran there; if it has only rested, also what is
/// at its own phase.
/// @param open  the intervals that are open before the jump, and then those open just before it arrives
[[nodiscard]] std::vector<FiredEvent> passed_events(const Rounds& rounds, const Clip& clip, std::size_t index,
                                                    double from, double to, Past past, double time,
                                                    std::vector<OpenInterval>& open);

}  // namespace clips

struct Player::Life : clips::Course {
  Life(const Play& played, const Clip& clip, double start, const Life* previous = nullptr);
  Life(const Life&) = default;
  Life& operator=(const Life&) = delete;
  ~Life();

  [[nodiscard]] Sample<double> weight(double time, Side side) const noexcept;
  /// Whether it has come to a time.
  [[nodiscard]] static bool is_past(double instant, double time, Side side) noexcept {
    return side == Side::out ? time >= instant : time > instant;
  }
  [[nodiscard]] bool is_stopped(double time, Side side) const noexcept { return is_past(stopped, time, side); }
  [[nodiscard]] bool is_gone(double time, Side side) const noexcept {
    return is_stopped(time, side) || (!fills_after(play.fill) && is_past(end, time, side));
  }
  [[nodiscard]] bool shows(double time, Side side) const noexcept {
    const bool waits = play.fill == Fill::none || play.fill == Fill::forwards;
    return !is_gone(time, side) && (!waits || is_past(at, time, side));
  }
  [[nodiscard]] double over() const noexcept { return std::min(end, stopped); }
  /// Whether the clock has moved by `time`, or moves off just then.
  [[nodiscard]] bool has_moved(double time) const noexcept {
    return moved || (first_move <= time && first_move < stopped);
  }
  /// The intervals that are open just after `time`.
  [[nodiscard]] std::vector<clips::OpenInterval> open(const Clip& clip, double time) const {
    if (!has_moved(time) || time >= over()) return {};
    return clips::open_intervals(rounds, clip, held_phase(time), direction(time));
  }

  Play play;
  std::shared_ptr<const Play> given;  ///< before any change
  double weight_from = 0;
  bool fades_in = true;
  std::optional<Curve<double>> rise{}, fall{};
  double stopped = clips::infinity;
  std::vector<FiredEvent> told{};                              ///< events at `since`
  std::shared_ptr<const std::vector<PlaySection>> sections{};  ///< its own, and those of the lives before it
  std::size_t section = 0;                                     ///< its own
  std::shared_ptr<Life> before{};
  const Life* under = nullptr;  ///< an earlier one, whose clock runs on while this one fades in over it
  double under_from = 0, under_for = 0;

  /// The weight of this one over `under`.
  [[nodiscard]] Sample<double> over_under(double time) const noexcept;
};

/// Calls `visit` with each life whose clock runs in [from, to], and from when to when it does in all.
template <class Visit>
void Player::visit_clocks(double from, double to, const Visit& visit) const {
  double next = clips::infinity;  // when the next life took over
  for (const Life* life = latest_.get(); life; life = life->before.get()) {
    double begin = life->since, end = next;
    for (const Life* one = life; one && begin <= std::min(end, to) && end >= from; one = one->under) {
      visit(*one, begin, end);
      // The one below runs on until this one has wholly faded in over it.
      begin = std::max(begin, one->under_from);
      end = std::min(end, one->under_from + one->under_for);
    }
    if (life->since < from) break;
    next = life->since;
  }
}

}  // namespace tweenfall
