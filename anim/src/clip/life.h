#pragma once

// A play from one change to the next: its clock as a function of time, and the times as functions of the clock.

#include <tweenfall/anim/player.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall {

namespace clips {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// All rounds of a play, one after another: the phase is 0 at their start and `total` at their end.
struct Rounds {
  double from = 0;    ///< of the section, clip seconds
  double length = 0;  ///< of one round, s; may be infinite
  LoopMode mode = LoopMode::once;
  bool reverse = false;
  double left_out = 0;  ///< rounds before phase 0: an even number of very many, so that no digits are lost to them
  double counted = 0;   ///< rounds from phase 0 on, where they are counted
  double low = 0, total = 0;
  bool lands = false;  ///< its end is that of the clip, which there jumps onto its last keys

  [[nodiscard]] bool loops() const noexcept { return mode != LoopMode::once && length > 0 && std::isfinite(length); }
  [[nodiscard]] bool is_flipped(double round) const noexcept {
    return (loops() && mode == LoopMode::pingpong && std::fmod(round, 2.0) != 0) != reverse;
  }
  /// Phase at which a round comes to a time of its section, 0 to `length`; where two rounds meet, the same of both.
  [[nodiscard]] double phase_of(double round, double inside) const noexcept {
    const double way = is_flipped(round) ? length - inside : inside;
    if (!loops()) return way;
    return way == length ? (round + 1) * length : round * length + way;
  }
};

[[nodiscard]] Rounds rounds_of(const Play& play, const Clip& clip) noexcept;
/// Of a clip that is played whole. @param lands  as `lands_on_last_key` says
[[nodiscard]] Rounds rounds_of(double duration, const Loop& loop, bool backwards, bool lands) noexcept;
/// The clock of a play at one speed that starts at `at`: what `Course` gives, without finding when it ends.
[[nodiscard]] ClipClock steady_clock(const Rounds& rounds, double at, double speed, double time, Side side) noexcept;

/// A while in which the phase goes one way.
struct Stretch {
  double from = 0, to = 0;  ///< s
  double turn = 0;          ///< where the speed would have it end, s: the next turn, or infinity
  double phase_from = 0, phase_to = 0;
  int direction = 1;
  bool first = false;  ///< the clock begins to move here
};

/// The clock of a play: its phase as a function of time, and the times as functions of the phase.
class Course {
 public:
  Course(const Rounds& all, const PlaySpeed& pace, double start, double offset) noexcept;

  [[nodiscard]] double phase(double time) const noexcept {
    return speed.is_constant() ? origin_phase + (time - origin) * speed.at(0)
                               : origin_phase + (speed.way(time - speed_from) - way_at_origin);
  }
  /// Within the rounds, and as it is held after the end.
  [[nodiscard]] double held_phase(double time) const noexcept {
    return time >= end ? end_phase : std::clamp(phase(std::max(time, at)), rounds.low, rounds.total);
  }
  [[nodiscard]] ClipClock clock(double time, Side side) const noexcept;
  /// When a stretch comes to a phase within it.
  [[nodiscard]] double time_of(double wanted, const Stretch& stretch) const noexcept;
  /// Where it is in force: from `since`, or its start.
  [[nodiscard]] double begin() const noexcept { return std::max(at, since); }

  /// Its clock goes on from `time` as it does.
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
      if (direction != 0 && (start < finish || (start == first_move && start < natural))) {
        Stretch stretch{.from = start, .to = finish, .turn = natural, .direction = direction};
        stretch.phase_from = held_phase(start);
        stretch.phase_to = finish == infinity ? direction * infinity : held_phase(finish);
        stretch.first = !moved && start == first_move;
        if (!visit(stretch)) return;
      }
      if (natural >= ends || natural > to) return;
      start = natural;
    }
  }

  Rounds rounds;
  PlaySpeed speed;
  double since = -infinity;  ///< from here on it is in force
  double at = 0;             ///< it starts, s
  double origin = 0, origin_phase = 0;
  double speed_from = 0, way_at_origin = 0;  ///< of a speed that is a curve: where that begins
  double end = infinity, end_phase = 0;      ///< when its rounds are over, and where
  bool moved = false;                        ///< before `since`
  double first_move = infinity;              ///< when its clock first moves, where it has not
};

}  // namespace clips

struct Player::Life : clips::Course {
  Life(const Play& played, const Clip& clip, double start);
  Life(const Life&) = default;
  Life& operator=(const Life&) = delete;
  ~Life();

  [[nodiscard]] Sample<double> weight(double time, Side side) const noexcept;
  [[nodiscard]] bool is_gone(double time, Side side) const noexcept {
    return side == Side::out ? time >= stopped : time > stopped;
  }
  [[nodiscard]] double over() const noexcept { return std::min(end, stopped); }
  /// Whether the clock has moved by `time`.
  [[nodiscard]] bool has_moved(double time) const noexcept { return moved || first_move < time; }

  Play play;
  std::shared_ptr<const Play> given;  ///< before anything was asked of it
  double weight_from = 0;
  bool fades_in = true;
  std::optional<Curve<double>> rise{}, fall{};
  double stopped = clips::infinity;
  std::vector<FiredEvent> told{};  ///< at `since`
  std::shared_ptr<Life> before{};
  const Life* under = nullptr;  ///< one of those before: its clock runs on while this one fades in over it
  double under_from = 0, under_for = 0;

  /// How much of this one there is over the other.
  [[nodiscard]] Sample<double> over_under(double time) const noexcept;
};

namespace clips {

/// Of the events of a clip, those intervals in whose inside a phase is, each with its round.
struct OpenInterval {
  std::size_t event;
  double round;
  bool operator==(const OpenInterval&) const = default;
};
[[nodiscard]] std::vector<OpenInterval> open_intervals(const Rounds& rounds, const Clip& clip, double phase);

/// The moments that a clock passes from one phase to another at once; where it moves for the `first` time, those on
/// which it stands too.
[[nodiscard]] std::vector<FiredEvent> passed_moments(const Rounds& rounds, const Clip& clip, std::size_t index,
                                                     double from, double to, bool first, double time);

}  // namespace clips
}  // namespace tweenfall
